// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Runs the reader, translates how it ended, and makes a shape of its stream.
#include "cad_stream.hpp"
#include "file_ending.hpp"

#include <cusp/base/child_process.hpp>
#include <cusp/geometry/cad/cad_file.hpp>

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

namespace cusp::geometry {
namespace {

constexpr const char* reader_name = "cusp-cad";

base::Location in(const std::string& path) {
    base::Location where;
    where.file = path;
    return where;
}

std::string findReader(const CadOptions& options) {
    if (!options.reader.empty()) return options.reader;
    if (const char* chosen = std::getenv("CUSP_CAD_READER"); chosen != nullptr && *chosen != '\0') return chosen;
    std::error_code error;
    const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
    for (const auto& place : {here / reader_name, here / ".." / "libexec" / "cusp" / reader_name}) {
        if (!error && std::filesystem::exists(place, error)) return place.string();
    }
    return reader_name;
}

/// "code: message" lines; the last one is the error of a reader that ended with one.
std::pair<std::string, std::string> codeAndMessage(const std::string& line) {
    const std::size_t colon = line.find(": ");
    if (!line.starts_with("cad.") || colon == std::string::npos) return {};
    return {line.substr(0, colon), line.substr(colon + 2)};
}

base::Result<std::string> runReader(const std::string& path, base::Diagnostics& report, const CadOptions& options) {
    if (errno = 0; !std::ifstream(path).good() || std::filesystem::is_directory(path)) {
        return base::fail("io.open", fmt::format("cannot be read: {}", std::strerror(errno != 0 ? errno : EISDIR)),
                          in(path));
    }
    const std::string ending = detail::endingOf(path);
    const bool iges = ending == ".igs" || ending == ".iges";
    base::ProcessLimits limits;
    limits.wall_s = options.time_limit_s;
    limits.cpu_s = options.time_limit_s;
#ifndef __SANITIZE_ADDRESS__  // its shadow alone is terabytes of address space
    limits.address_space_bytes = options.memory_limit_bytes;
#endif
    limits.output_bytes = std::size_t{2} << 30U;
    const std::string program = findReader(options);
    // A name that starts with a dash is still a name.
    const std::string argument = path.starts_with("-") ? "./" + path : path;
    auto outcome = base::runProcess({program, iges ? "iges" : "step", argument}, limits);
    if (!outcome) {
        return base::fail("cad.reader", fmt::format("the CAD reader '{}' cannot be run", program), in(path));
    }
    std::istringstream lines(outcome->errors);
    std::pair<std::string, std::string> last;
    for (std::string line; std::getline(lines, line);) {
        auto [code, message] = codeAndMessage(line);
        if (code.empty()) continue;
        if (code == "cad.partial") report.warning(code, message, in(path));
        last = {std::move(code), std::move(message)};
    }
    if (outcome->succeeded()) return std::move(outcome->output);
    if (outcome->limit != base::LimitHit::None) {
        return base::fail("cad.limit", fmt::format("reading was ended: {}", base::outcomeText(*outcome)), in(path));
    }
    if (outcome->signal == 0 && !last.first.empty() && last.first != "cad.partial") {
        return base::fail(last.first, last.second, in(path));
    }
    return base::fail(
        "cad.crashed",
        fmt::format("OCCT, which reads the file, failed on it ({}): the file is damaged, or holds something "
                    "OCCT cannot cope with",
                    base::outcomeText(*outcome)),
        in(path));
}

base::Result<ParametricSurface> shapeOf(const cad::CadModel& model, const std::string& path) {
    std::vector<SurfaceFace> faces;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        auto face = toFace(model.faces[f].surface, model.faces[f].reversed ? Outward::DvCrossDu : Outward::DuCrossDv);
        if (!face) {
            return base::fail("cad.face", fmt::format("face {}: {}", f + 1, face.error().front().message), in(path));
        }
        faces.push_back(*std::move(face));
    }
    std::vector<TrimEdge> edges;
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        TrimEdge edge;
        const auto bad = [&] { return base::fail("cad.face", fmt::format("edge {} is no curve", e + 1), in(path)); };
        if (!model.edges[e].is_point) {
            auto curve = toPieces(model.edges[e].curve);
            if (!curve) return bad();
            edge.curve = *std::move(curve);
        }
        for (const cad::StreamedUse& use : model.edges[e].uses) {
            auto parameters = toPieces(use.parameters);
            if (!parameters || use.face >= faces.size()) return bad();
            edge.uses.push_back({use.face, *std::move(parameters)});
        }
        edges.push_back(std::move(edge));
    }
    return ParametricSurface(std::move(faces), std::move(edges));
}

}  // namespace

base::Result<ParametricSurface> readCadFile(const std::string& path, base::Diagnostics& report,
                                            const CadOptions& options) {
    const auto bytes = runReader(path, report, options);
    if (!bytes) return base::fail(bytes.error());
    const auto model = cad::fromStream(*bytes, path);
    if (!model) return base::fail(model.error());
    return shapeOf(*model, path);
}

}  // namespace cusp::geometry
