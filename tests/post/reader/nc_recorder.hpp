// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Runs a program text through the reader and keeps everything it says.
#pragma once

#include <cusp/post/reader/program_reader.hpp>

#include <string>
#include <utility>
#include <vector>

namespace cusp::post::reader::test {

struct RecordedMotion {
    ExecutedMotion motion;  ///< its `state` points nowhere; the copy is beside it
    ModalSnapshot state;
};

struct Recording {
    std::vector<RecordedMotion> motions;
    std::vector<std::pair<BlockPlace, ExecutedEvent>> events;
    base::Diagnostics report;
    std::string problems;  ///< one text per line, without file name
    ReadSummary summary;
};

/// A machine that ships with cusp, by its file name without ending.
[[nodiscard]] MachineFile shippedMachine(const std::string& name);

[[nodiscard]] Recording run(const std::string& program, const MachineFile& machine, const ReaderOptions& options = {});
/// On the C/A head, with M30 added.
[[nodiscard]] Recording runLines(const std::string& lines);

[[nodiscard]] std::string fileText(const std::string& path);

}  // namespace cusp::post::reader::test
