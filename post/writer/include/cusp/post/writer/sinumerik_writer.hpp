// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The leaf that spells NC steps as Sinumerik 840D text.
#pragma once

#include <cusp/post/control/control_definition.hpp>
#include <cusp/post/writer/nc_program.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::post {

/// What stands in the comments at the head of the program.
struct ProgramHead {
    std::string program_name;
    std::string work_offset;            ///< empty: the machine file's
    std::vector<std::string> comments;  ///< none: the program's name alone
};

/// Where the text goes, some kilobytes at a time.
using TextSink = std::function<void(std::string_view)>;

/// A block that was written: its number (0: none), its line in the program from 1, and the CL line it stands for (0: none).
struct WrittenBlock {
    std::int64_t number = 0;
    std::size_t program_line = 0;
    std::uint32_t cl_line = 0;
};
using BlockListener = std::function<void(const WrittenBlock&)>;

class SinumerikWriter : public NcSink {
public:
    /// `file` must outlive the writer.
    SinumerikWriter(TextSink out, const MachineFile& file, const ProgramHead& head, BlockListener listener = {});
    ~SinumerikWriter() override;

    void step(const NcStep& step) override;
    /// Flushes; answers the number of blocks (lines that are not only a comment).
    std::size_t finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace cusp::post
