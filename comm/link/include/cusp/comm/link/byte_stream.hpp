// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A line that carries bare bytes, for controls that speak no protocol: a serial device, or a terminal server behind TCP.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/comm/link/bytes.hpp>
#include <cusp/comm/link/link_url.hpp>

#include <memory>

namespace cusp::comm {

class ByteStream {
public:
    /// serial:// and tcp:// only. Errors as `openLink`.
    [[nodiscard]] static base::Result<ByteStream> open(const LinkUrl& url);
    ByteStream(ByteStream&&) noexcept;
    ByteStream& operator=(ByteStream&&) noexcept;
    ~ByteStream();

    /// How many bytes were taken, 0 when the line is held. Error `io.link-lost`.
    [[nodiscard]] base::Result<std::size_t> write(ByteView bytes);
    /// What has come, waiting at most `timeout_s` for it. Error `io.link-lost`.
    [[nodiscard]] base::Result<Bytes> read(double timeout_s);
    /// Written, and still in this machine.
    [[nodiscard]] std::size_t queuedBytes() const;
    /// Until something comes or can be written.
    void wait(double timeout_s) const;

private:
    struct Line;
    explicit ByteStream(std::unique_ptr<Line> line);
    std::unique_ptr<Line> line_;
};

}  // namespace cusp::comm
