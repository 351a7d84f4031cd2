// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// An open file, socket or device that is closed with its owner, and what is done with one.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/comm/link/bytes.hpp>
#include <cusp/comm/link/link_url.hpp>
#include <cusp/comm/link/transports.hpp>

#include <optional>
#include <string>
#include <utility>

namespace cusp::comm {

class FileDescriptor {
public:
    FileDescriptor() = default;
    explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
    FileDescriptor(FileDescriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    FileDescriptor& operator=(FileDescriptor&& other) noexcept {
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }
    FileDescriptor(const FileDescriptor&) = delete;
    FileDescriptor& operator=(const FileDescriptor&) = delete;
    ~FileDescriptor();

    [[nodiscard]] int get() const { return descriptor_; }
    [[nodiscard]] bool open() const { return descriptor_ >= 0; }

private:
    int descriptor_ = -1;
};

/// `io.link-open` with the system's words for errno.
[[nodiscard]] tl::unexpected<base::Diagnostics> failOpen(const std::string& what, int error_number);

/// A connected stream, not blocking, without Nagle's delay.
[[nodiscard]] base::Result<FileDescriptor> connectTcp(const LinkUrl& url);

struct Listening {
    FileDescriptor socket;
    std::string host;  ///< numeric
    std::uint16_t port = 0;
};
[[nodiscard]] base::Result<Listening> listenTcp(const LinkUrl& url, const ListenOptions& options);
/// The next client that is allowed in; others are closed at once. Nothing when none waits.
[[nodiscard]] std::optional<FileDescriptor> acceptAllowed(const Listening& listening, const ListenOptions& options);
/// Entries `ListenOptions::allowed` that are no addresses. Error `link.allow`.
[[nodiscard]] base::Result<void> checkAllowed(const ListenOptions& options);

/// A serial device in raw mode, not blocking.
[[nodiscard]] base::Result<FileDescriptor> openSerial(const LinkUrl& url);

/// Monotonic time.
[[nodiscard]] double steadySeconds();

/// Waits until the descriptor is readable (or writable, when `writable`), at most `timeout_s`.
void waitFor(int descriptor, bool writable, double timeout_s);

/// What is there to be read, up to 64 kB; nothing when the other end has closed or failed and all it said was read.
[[nodiscard]] std::optional<Bytes> readSome(int descriptor);
/// Writes what goes without waiting and removes it from `pending`; false when the other end has closed or failed.
[[nodiscard]] bool writeSome(int descriptor, Bytes& pending);

}  // namespace cusp::comm
