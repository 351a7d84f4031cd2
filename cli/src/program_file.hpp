// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The files a posting writes: all of them at its end, or none.
#pragma once

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/diagnostics.hpp>
#include <cusp/post/writer/sinumerik_writer.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace cusp::cli {

/// Keeps the first failure of a write until the end: the writer's steps have no way to answer.
class ProgramFile {
public:
    explicit ProgramFile(base::OutputTarget target) : target_(std::move(target)) {}
    void write(std::string_view text) {
        if (!failure_.hasErrors())
            if (const auto done = target_.write(text); !done) failure_ = done.error();
    }
    base::Result<void> commit() {
        if (failure_.hasErrors()) return base::fail(failure_);
        return target_.commit();
    }

private:
    base::OutputTarget target_;
    base::Diagnostics failure_;
};

/// What is written beside the program, when asked for.
struct Companions {
    std::optional<ProgramFile> map;
    std::optional<ProgramFile> sheet;

    /// Files to write; empty: none.
    static base::Result<Companions> open(const std::string& map_file, const std::string& sheet_file) {
        Companions out;
        for (auto [path, file] : {std::pair{&map_file, &out.map}, std::pair{&sheet_file, &out.sheet}}) {
            if (path->empty()) continue;
            auto target = base::OutputTarget::open(*path);
            if (!target) return base::fail(std::move(target).error());
            file->emplace(*std::move(target));
        }
        if (out.map) out.map->write("block,program_line,cl_line\n");
        return out;
    }
    base::Result<void> commit() {
        for (auto* file : {&map, &sheet})
            if (*file)
                if (auto done = (*file)->commit(); !done) return done;
        return {};
    }
};

/// A line of the map: block number, line of the program, line of the CL file; empty where there is none.
inline std::string mapLine(const post::WrittenBlock& block) {
    const auto number = [](auto value) { return value == 0 ? std::string() : std::to_string(value); };
    return number(block.number) + ',' + std::to_string(block.program_line) + ',' + number(block.cl_line) + '\n';
}

}  // namespace cusp::cli
