// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Digests: SHA-256 to tell files apart, CRC-32 to notice a bad line.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace cusp::base {

/// SHA-256 (FIPS 180-4) of bytes that come in pieces.
class Sha256 {
public:
    Sha256();
    Sha256(Sha256&&) noexcept;
    Sha256& operator=(Sha256&&) noexcept;
    ~Sha256();

    void update(std::string_view bytes);
    void update(std::span<const std::uint8_t> bytes);
    /// The digest of everything so far, as 64 lower-case hexadecimal digits; more may follow.
    [[nodiscard]] std::string hex() const;

private:
    struct Context;
    std::unique_ptr<Context> context_;
};

[[nodiscard]] std::string sha256Hex(std::string_view bytes);

/// CRC-32 of IEEE 802.3 (reflected polynomial 0xEDB88320, as in zip and Ethernet). For bytes in pieces, hand the result of
/// the piece before as `previous`.
[[nodiscard]] std::uint32_t crc32(std::string_view bytes, std::uint32_t previous = 0);
[[nodiscard]] std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t previous = 0);

}  // namespace cusp::base
