// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Whole files in, whole files out: nobody ever sees a half-written one.
#pragma once

#include <cusp/base/result.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace cusp::base {

/// The content of a file; `-` is standard input. Devices and pipes are read to their end.
/// Errors: `io.open`, `io.read` (with the system's reason), `io.too-large` when there are more than `max_bytes`.
[[nodiscard]] Result<std::string> readWholeFile(const std::string& path, std::size_t max_bytes);

/// A file that appears under its name complete or not at all. It is written to a temporary in the same folder, brought
/// to the disk (fsync), then renamed over the target; a target that existed keeps its permission bits, and a symbolic
/// link stays a link (the file it leads to is replaced). Without `commit` nothing happens but the temporary's removal.
///
/// Devices and pipes cannot be replaced by a rename; they are written directly.
/// Errors: `io.open`, `io.write`, `io.commit`, each with the path and the system's reason. After an error in `write`
/// every later call fails with the same one.
class AtomicFile {
public:
    [[nodiscard]] static Result<AtomicFile> create(const std::string& path);

    AtomicFile(AtomicFile&& other) noexcept { swap(other); }
    AtomicFile& operator=(AtomicFile&& other) noexcept {
        swap(other);
        return *this;
    }
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile();

    [[nodiscard]] Result<void> write(std::string_view bytes);
    /// Flushes, syncs and renames. At most once; nothing can be written afterwards.
    [[nodiscard]] Result<void> commit();

    /// As the user gave it.
    [[nodiscard]] const std::string& path() const { return path_; }

private:
    friend class OutputTarget;
    AtomicFile() = default;
    void swap(AtomicFile& other) noexcept;
    void discard() noexcept;
    [[nodiscard]] Result<void> flush();
    [[nodiscard]] tl::unexpected<Diagnostics> abandon(std::string_view code, std::string_view doing, int error_number);

    std::string path_;
    std::string target_;     ///< `path_` with symbolic links followed
    std::string temporary_;  ///< empty when written directly, committed or discarded
    std::string buffer_;
    int descriptor_ = -1;
    Diagnostics failure_;
};

/// Where a command writes: a file (atomic) or, for `-`, standard output (which cannot be taken back).
class OutputTarget {
public:
    [[nodiscard]] static Result<OutputTarget> open(const std::string& path);

    [[nodiscard]] Result<void> write(std::string_view bytes);
    /// Makes a file appear under its name; for standard output, reports whether every byte was taken.
    [[nodiscard]] Result<void> commit();
    [[nodiscard]] bool isStandardOutput() const { return is_standard_output_; }

private:
    OutputTarget(AtomicFile file, bool is_standard_output)
        : file_(std::move(file)), is_standard_output_(is_standard_output) {}

    AtomicFile file_;
    bool is_standard_output_;
};

/// `OutputTarget` opened, written and committed in one go.
[[nodiscard]] Result<void> writeWholeFile(const std::string& path, std::string_view bytes);

}  // namespace cusp::base
