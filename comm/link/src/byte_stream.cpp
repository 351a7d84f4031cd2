// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Bare bytes over a descriptor that never blocks.
#include <cusp/comm/link/byte_stream.hpp>

#include "file_descriptor.hpp"

#include <cerrno>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>
#include <utility>

namespace cusp::comm {

struct ByteStream::Line {
    FileDescriptor descriptor;
    std::string name;
};

ByteStream::ByteStream(std::unique_ptr<Line> line) : line_(std::move(line)) {}
ByteStream::ByteStream(ByteStream&&) noexcept = default;
ByteStream& ByteStream::operator=(ByteStream&&) noexcept = default;
ByteStream::~ByteStream() = default;

base::Result<ByteStream> ByteStream::open(const LinkUrl& url) {
    if (url.kind != LinkKind::Serial && url.kind != LinkKind::Tcp)
        return base::fail("link.url", "carries no bare bytes: serial:// and tcp:// do", {url.text, 0, 0, {}});
    auto descriptor = url.kind == LinkKind::Serial ? openSerial(url) : connectTcp(url);
    if (!descriptor) return base::fail(std::move(descriptor).error());
    auto line = std::make_unique<Line>();
    line->descriptor = *std::move(descriptor);
    line->name = url.text;
    return ByteStream(std::move(line));
}

base::Result<std::size_t> ByteStream::write(ByteView bytes) {
    Bytes pending(bytes.begin(), bytes.end());
    if (!writeSome(line_->descriptor.get(), pending))
        return base::fail("io.link-lost", "the other end has closed", {line_->name, 0, 0, {}});
    return bytes.size() - pending.size();
}

base::Result<Bytes> ByteStream::read(double timeout_s) {
    if (timeout_s > 0.0) waitFor(line_->descriptor.get(), false, timeout_s);
    auto bytes = readSome(line_->descriptor.get());
    if (!bytes) return base::fail("io.link-lost", "the other end has closed", {line_->name, 0, 0, {}});
    return *std::move(bytes);
}

std::size_t ByteStream::queuedBytes() const {
    int queued = 0;
    if (::ioctl(line_->descriptor.get(), TIOCOUTQ, &queued) != 0 || queued < 0) return 0;
    return static_cast<std::size_t>(queued);
}

void ByteStream::wait(double timeout_s) const { waitFor(line_->descriptor.get(), true, timeout_s); }

}  // namespace cusp::comm
