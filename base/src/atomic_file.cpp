// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// POSIX file input and output behind atomic_file.hpp.
#include <cusp/base/atomic_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <optional>
#include <poll.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace cusp::base {
namespace {

constexpr std::size_t buffer_bytes = std::size_t{64} << 10U;
constexpr int most_links_followed = 40;
constexpr int most_names_tried = 100;

std::string reason(int error_number) { return std::generic_category().message(error_number); }

tl::unexpected<Diagnostics> ioFailure(std::string_view code, std::string_view doing, int error_number,
                                      const std::string& path) {
    return fail(code, fmt::format("{}: {}", doing, reason(error_number)),
                {.file = path, .line = 0, .column = 0, .key = {}});
}

/// The file a chain of symbolic links ends at, whether it exists or not.
std::string followLinks(const std::string& path) {
    std::filesystem::path current = path;
    for (int i = 0; i < most_links_followed; ++i) {
        std::error_code no_link;
        const std::filesystem::path next = std::filesystem::read_symlink(current, no_link);
        if (no_link) break;
        current = next.is_absolute() ? next : current.parent_path() / next;
    }
    return current.string();
}

std::string folderOf(const std::string& path) {
    const std::string folder = std::filesystem::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

void closeQuietly(int descriptor) {
    if (descriptor >= 0) static_cast<void>(::close(descriptor));
}

/// Returns 0 or the error number.
int writeAll(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written >= 0) {
            bytes.remove_prefix(static_cast<std::size_t>(written));
        } else if (errno == EAGAIN) {
            pollfd waiting{.fd = descriptor, .events = POLLOUT, .revents = 0};
            static_cast<void>(::poll(&waiting, 1, -1));
        } else if (errno != EINTR) {
            return errno;
        }
    }
    return 0;
}

/// Devices and pipes have no disk to sync to and say so.
int syncToDisk(int descriptor) {
    if (::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS || errno == ENOTSUP) return 0;
    return errno;
}

struct Temporary {
    int descriptor = -1;
    std::string path;
};

/// A new file of its own name; the process's umask applies. On failure the descriptor is -1 and errno is set.
Temporary createTemporary(const std::string& folder) {
    static std::atomic<unsigned> counter{0};
    Temporary out;
    for (int i = 0; i < most_names_tried; ++i) {
        out.path = fmt::format("{}/.cusp-{}-{}.tmp", folder, ::getpid(), counter.fetch_add(1));
        out.descriptor = ::open(out.path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (out.descriptor >= 0 || errno != EEXIST) break;
    }
    return out;
}

}  // namespace

Result<std::string> readWholeFile(const std::string& path, std::size_t max_bytes) {
    const bool is_input = path == "-";
    const std::string name = is_input ? "standard input" : path;
    const int descriptor = is_input ? ::dup(STDIN_FILENO) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return ioFailure("io.open", "cannot open this file", errno, name);
    std::string out;
    struct stat status{};
    if (::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0)
        out.reserve(std::min(max_bytes, static_cast<std::size_t>(status.st_size)) + 1);
    std::string block(buffer_bytes, '\0');
    while (out.size() <= max_bytes) {
        const ssize_t got = ::read(descriptor, block.data(), block.size());
        if (got == 0) break;
        if (got > 0) {
            out.append(block, 0, static_cast<std::size_t>(got));
        } else if (errno == EAGAIN) {
            pollfd waiting{.fd = descriptor, .events = POLLIN, .revents = 0};
            static_cast<void>(::poll(&waiting, 1, -1));
        } else if (errno != EINTR) {
            const int error_number = errno;
            closeQuietly(descriptor);
            return ioFailure("io.read", "cannot read this file", error_number, name);
        }
    }
    closeQuietly(descriptor);
    if (out.size() > max_bytes)
        return fail("io.too-large", fmt::format("this file is larger than {} bytes", max_bytes),
                    {.file = name, .line = 0, .column = 0, .key = {}});
    return out;
}

Result<AtomicFile> AtomicFile::create(const std::string& path) {
    constexpr std::string_view doing = "cannot create this file";
    AtomicFile file;
    file.path_ = path;
    if (path.empty()) return ioFailure("io.open", doing, ENOENT, path);
    struct stat status{};
    const bool exists = ::stat(path.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) return ioFailure("io.open", doing, EISDIR, path);
    if (exists && !S_ISREG(status.st_mode)) {
        file.descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
        if (file.descriptor_ < 0) return ioFailure("io.open", doing, errno, path);
        return file;
    }
    // A rename asks the folder for permission, not the file: a write-protected target must be honoured here.
    if (exists && ::access(path.c_str(), W_OK) != 0) return ioFailure("io.open", doing, errno, path);
    file.target_ = followLinks(path);
    Temporary temporary = createTemporary(folderOf(file.target_));
    if (temporary.descriptor < 0) return ioFailure("io.open", doing, errno, path);
    file.descriptor_ = temporary.descriptor;
    file.temporary_ = std::move(temporary.path);
    if (exists) {
        // Only the superuser may give files away; for everybody else the owner is the writer, as with any editor.
        static_cast<void>(::fchown(file.descriptor_, status.st_uid, status.st_gid));
        if (::fchmod(file.descriptor_, status.st_mode & 07777U) != 0) return file.abandon("io.open", doing, errno);
    }
    return file;
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::swap(AtomicFile& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(target_, other.target_);
    std::swap(temporary_, other.temporary_);
    std::swap(buffer_, other.buffer_);
    std::swap(descriptor_, other.descriptor_);
    std::swap(failure_, other.failure_);
}

void AtomicFile::discard() noexcept {
    closeQuietly(descriptor_);
    descriptor_ = -1;
    if (!temporary_.empty()) static_cast<void>(::unlink(temporary_.c_str()));
    temporary_.clear();
}

tl::unexpected<Diagnostics> AtomicFile::abandon(std::string_view code, std::string_view doing, int error_number) {
    discard();
    auto failure = ioFailure(code, doing, error_number, path_);
    failure_ = failure.value();
    return failure;
}

Result<void> AtomicFile::flush() {
    if (descriptor_ < 0) {
        if (failure_.hasErrors()) return fail(failure_);
        return abandon("io.write", "this file is already closed", EBADF);
    }
    const int error_number = writeAll(descriptor_, buffer_);
    buffer_.clear();
    if (error_number != 0) return abandon("io.write", "cannot write this file", error_number);
    return {};
}

Result<void> AtomicFile::write(std::string_view bytes) {
    buffer_ += bytes;
    if (buffer_.size() < buffer_bytes && descriptor_ >= 0) return {};
    return flush();
}

Result<void> AtomicFile::commit() {
    if (Result<void> flushed = flush(); !flushed) return flushed;
    constexpr std::string_view doing = "cannot finish this file";
    if (const int error_number = syncToDisk(descriptor_); error_number != 0)
        return abandon("io.commit", doing, error_number);
    const int closed = ::close(std::exchange(descriptor_, -1));
    if (closed != 0) return abandon("io.commit", doing, errno);
    if (temporary_.empty()) return {};
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) return abandon("io.commit", doing, errno);
    temporary_.clear();
    // The name lives in the folder: without this a power cut could bring the old file back.
    const int folder = ::open(folderOf(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) static_cast<void>(::fsync(folder));
    closeQuietly(folder);
    return {};
}

Result<OutputTarget> OutputTarget::open(const std::string& path) {
    if (path != "-") {
        Result<AtomicFile> file = AtomicFile::create(path);
        if (!file) return fail(std::move(file.error()));
        return OutputTarget(std::move(*file), false);
    }
    AtomicFile output;
    output.path_ = "standard output";
    output.descriptor_ = ::dup(STDOUT_FILENO);
    if (output.descriptor_ < 0) return ioFailure("io.open", "cannot write", errno, output.path_);
    return OutputTarget(std::move(output), true);
}

Result<void> OutputTarget::write(std::string_view bytes) { return file_.write(bytes); }
Result<void> OutputTarget::commit() { return file_.commit(); }

Result<void> writeWholeFile(const std::string& path, std::string_view bytes) {
    Result<OutputTarget> target = OutputTarget::open(path);
    if (!target) return fail(std::move(target.error()));
    if (Result<void> written = target->write(bytes); !written) return written;
    return target->commit();
}

}  // namespace cusp::base
