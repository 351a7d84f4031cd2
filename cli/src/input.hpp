// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// CL files and programs, or standard input, opened for reading; paths that a file names.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <cstdint>
#include <fstream>
#include <istream>
#include <memory>
#include <string>
#include <utility>

namespace cusp::cli {

/// `dialect`: "", "nx", "catia", "solidworks", "apt"; `units`: "", "mm", "inch" (checked by the command line).
[[nodiscard]] toolpath::ClReaderOptions clReaderOptions(const std::string& dialect, const std::string& units,
                                                        bool strict);

/// The file name without its folder; "-" as "standard input".
[[nodiscard]] std::string fileNameOf(const std::string& path);

/// A path named in a file: as it is where it is absolute, else from the folder of that file.
[[nodiscard]] std::string besideFile(const std::string& file, const std::string& named);

/// A text file or standard input.
class TextInput {
public:
    /// Error `io.open` with the system's reason.
    [[nodiscard]] static base::Result<TextInput> open(const std::string& path);
    [[nodiscard]] std::istream& stream() { return *stream_; }
    /// Bytes in the file, 0 when that is not known; and how many of them were read.
    [[nodiscard]] std::uint64_t size() const { return size_; }
    [[nodiscard]] std::uint64_t position();
    /// For messages.
    [[nodiscard]] const std::string& name() const { return name_; }

private:
    TextInput() = default;
    std::unique_ptr<std::ifstream> file_;
    std::istream* stream_ = nullptr;
    std::string name_;
    std::uint64_t size_ = 0;
};

class ClInput {
public:
    /// Errors as `TextInput::open`.
    [[nodiscard]] static base::Result<ClInput> open(const std::string& path, const toolpath::ClReaderOptions& options);
    [[nodiscard]] toolpath::ClReader& reader() { return *reader_; }
    [[nodiscard]] TextInput& text() { return text_; }

private:
    explicit ClInput(TextInput text) : text_(std::move(text)) {}
    TextInput text_;
    std::unique_ptr<toolpath::ClReader> reader_;
};

}  // namespace cusp::cli
