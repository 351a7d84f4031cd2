// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Writes records as CL text (APT) that the reader takes back unchanged.
#pragma once

#include <cusp/base/diagnostics.hpp>
#include <cusp/base/result.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <memory>
#include <ostream>
#include <string>

namespace cusp::toolpath {

struct ClWriterOptions {
    /// `Nx`: TOOL PATH, TLDATA, MSYS, CIRCLE with NX's sign. Any other: plain APT; what it has no word for (frames,
    /// planes, operation names) goes into comments of cusp's own, which other systems pass over.
    Dialect dialect = Dialect::Apt;
};

/// Writes record after record in mm with the shortest numbers that read back to the same value. What a `ClReader` handed
/// out is read back as the same records; reading and writing again gives the same text.
///
/// Errors, `cl.not-writable`, with the record's line: a text that would end or split the statement; a number that is not
/// finite; in plain APT a tool without a number; in NX tool number 0, which NX writes for "none". The record is left out.
class ClWriter {
public:
    /// Writes the header, with the version of cusp. `out` must outlive the writer, and is written to in large pieces.
    ClWriter(std::ostream& out, const ClWriterOptions& options);
    ~ClWriter();
    ClWriter(ClWriter&&) noexcept;
    ClWriter& operator=(ClWriter&&) noexcept;

    void write(const ClRecord& record);
    /// Hands what is still held to the stream. To be called once, after the last record. The stream's state says whether
    /// it could take everything.
    void finish();

    [[nodiscard]] const base::Diagnostics& report() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// A whole tool path as text; in NX's dialect if it came from NX, else in plain APT.
[[nodiscard]] base::Result<std::string> clText(const ToolPath& path);

}  // namespace cusp::toolpath
