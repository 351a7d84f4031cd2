// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Reads CL files (APT text) as a stream of records: memory does not grow with the file.
#pragma once

#include <cusp/base/diagnostics.hpp>
#include <cusp/base/result.hpp>
#include <cusp/toolpath/cl_record.hpp>

#include <cstdint>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cusp::toolpath {

/// Who wrote the file. The dialect decides what plain APT leaves open.
/// `Apt` is plain APT without a system's own statements.
enum class Dialect : std::uint8_t { Nx, Catia, Apt, SolidWorksCam };

[[nodiscard]] const char* dialectName(Dialect dialect);

struct ClReaderOptions {
    /// Forces a dialect; detected from the first statements when absent.
    std::optional<Dialect> dialect;
    /// Unit of lengths when the file does not state it (no UNITS before the first motion). Without this, the first feed
    /// word (MMPM, MMPR, IPM, IPR) in the first megabyte decides, and if there is none the file is refused.
    std::optional<double> mm_per_unit;
    /// A statement the reader does not know is an error instead of a warning. A statement that moves the tool and is not
    /// understood is an error either way.
    bool strict = false;
    /// A longer line ends the read with `cl.line-too-long`: a binary file must not be taken for one huge statement.
    std::size_t max_statement_bytes = 64 * 1024;
    /// The stream is read in blocks of this size. The records do not depend on it.
    std::size_t block_bytes = 256 * 1024;
};

/// A pull reader: `next` until it answers false, then ask `report`.
class ClReader {
public:
    /// `file_name` is for messages; `in` must outlive the reader.
    ClReader(std::istream& in, std::string file_name, ClReaderOptions options = {});
    ~ClReader();
    ClReader(ClReader&&) noexcept;
    ClReader& operator=(ClReader&&) noexcept;

    /// The next record. False at the end of the file or after a problem that ends the read; errors that do not end it are
    /// reported and reading goes on, so that one run shows them all. Records handed out after an error are for checking
    /// only.
    [[nodiscard]] bool next(ClRecord& record);

    /// Problems so far. The read succeeded if `next` answered false and this has no errors.
    [[nodiscard]] const base::Diagnostics& report() const;

    /// Known once the first record was handed out.
    [[nodiscard]] Dialect dialect() const;
    [[nodiscard]] double mmPerUnit() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// A whole CL file in memory, for those who need to go back and forth.
struct ToolPath {
    std::string file_name;
    Dialect dialect = Dialect::Nx;
    double mm_per_unit = 1.0;
    std::vector<ClRecord> records;
};

/// Reads everything; warnings go to `warnings`.
[[nodiscard]] base::Result<ToolPath> readToolPath(std::istream& in, const std::string& file_name,
                                                  const ClReaderOptions& options, base::Diagnostics& warnings);
/// The same for a path, `-` for stdin.
[[nodiscard]] base::Result<ToolPath> readToolPathFile(const std::string& path, const ClReaderOptions& options,
                                                      base::Diagnostics& warnings);

}  // namespace cusp::toolpath
