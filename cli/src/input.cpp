// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Opens CL files.
#include "input.hpp"

#include <cusp/base/units.hpp>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>

namespace cusp::cli {

toolpath::ClReaderOptions clReaderOptions(const std::string& dialect, const std::string& units, bool strict) {
    toolpath::ClReaderOptions options;
    if (dialect == "nx") options.dialect = toolpath::Dialect::Nx;
    if (dialect == "catia") options.dialect = toolpath::Dialect::Catia;
    if (dialect == "solidworks") options.dialect = toolpath::Dialect::SolidWorksCam;
    if (dialect == "apt") options.dialect = toolpath::Dialect::Apt;
    if (units == "mm") options.mm_per_unit = 1.0;
    if (units == "inch") options.mm_per_unit = base::mm_per_inch;
    options.strict = strict;
    return options;
}

std::string fileNameOf(const std::string& path) {
    return path == "-" ? "standard input" : std::filesystem::path(path).filename().string();
}

std::string besideFile(const std::string& file, const std::string& named) {
    const std::filesystem::path path(named);
    return path.is_absolute() ? named : (std::filesystem::path(file).parent_path() / path).string();
}

base::Result<TextInput> TextInput::open(const std::string& path) {
    TextInput input;
    input.name_ = path == "-" ? "stdin" : path;
    if (path == "-") {
        input.stream_ = &std::cin;
        return input;
    }
    const base::Location where{path, 0, 0, {}};
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) return base::fail("io.open", "is a folder, not a file", where);
    errno = 0;
    input.file_ = std::make_unique<std::ifstream>(path, std::ios::binary);
    if (!*input.file_) return base::fail("io.open", std::string("cannot open: ") + std::strerror(errno), where);
    input.stream_ = input.file_.get();
    const auto bytes = std::filesystem::file_size(path, ignored);
    if (!ignored) input.size_ = bytes;
    return input;
}

std::uint64_t TextInput::position() {
    if (!file_) return 0;
    const auto at = file_->tellg();
    return at < 0 ? size_ : static_cast<std::uint64_t>(at);
}

base::Result<ClInput> ClInput::open(const std::string& path, const toolpath::ClReaderOptions& options) {
    auto text = TextInput::open(path);
    if (!text) return base::fail(std::move(text).error());
    ClInput input(*std::move(text));
    input.reader_ = std::make_unique<toolpath::ClReader>(input.text_.stream(), input.text_.name(), options);
    return input;
}

}  // namespace cusp::cli
