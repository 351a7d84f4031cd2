// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Descriptors: waiting, reading, writing.
#include "file_descriptor.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace cusp::comm {

FileDescriptor::~FileDescriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

tl::unexpected<base::Diagnostics> failOpen(const std::string& what, int error_number) {
    return base::fail("io.link-open", "cannot open: " + std::string(std::strerror(error_number)), {what, 0, 0, {}});
}

double steadySeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void waitFor(int descriptor, bool writable, double timeout_s) {
    pollfd waiting{descriptor, static_cast<short>(writable ? POLLIN | POLLOUT : POLLIN), 0};
    const double ms = std::ceil(std::clamp(timeout_s, 0.0, 3600.0) * 1000.0);
    // Interrupted by a signal: the caller looks at the time anyway.
    static_cast<void>(::poll(&waiting, 1, static_cast<int>(ms)));
}

std::optional<Bytes> readSome(int descriptor) {
    Bytes out(std::size_t{64} * 1024);
    const ssize_t count = ::read(descriptor, out.data(), out.size());
    if (count > 0) {
        out.resize(static_cast<std::size_t>(count));
        return out;
    }
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return Bytes();
    return std::nullopt;
}

bool writeSome(int descriptor, Bytes& pending) {
    while (!pending.empty()) {
        ssize_t count = ::send(descriptor, pending.data(), pending.size(), MSG_NOSIGNAL);
        if (count < 0 && errno == ENOTSOCK) count = ::write(descriptor, pending.data(), pending.size());
        if (count < 0) return errno == EAGAIN || errno == EINTR || errno == ENOBUFS;
        pending.erase(pending.begin(), pending.begin() + count);
    }
    return true;
}

}  // namespace cusp::comm
