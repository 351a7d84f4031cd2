// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// SHA-256 by OpenSSL's EVP interface, CRC-32 by table.
#include <cusp/base/hash.hpp>

#include <array>
#include <new>
#include <openssl/evp.h>

namespace cusp::base {
namespace {

struct FreeContext {
    void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
};
using ContextPointer = std::unique_ptr<EVP_MD_CTX, FreeContext>;

/// These calls only fail when memory runs out (or the build of OpenSSL lacks SHA-256 altogether).
void demand(bool done) {
    if (!done) throw std::bad_alloc();
}

constexpr std::array<std::uint32_t, 256> makeCrcTable() {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
        std::uint32_t value = i;
        for (int bit = 0; bit < 8; ++bit) value = (value >> 1U) ^ ((value & 1U) != 0 ? 0xEDB88320U : 0U);
        table[i] = value;
    }
    return table;
}

constexpr std::array<std::uint32_t, 256> crc_table = makeCrcTable();

template <class Bytes>
std::uint32_t crcOf(const Bytes& bytes, std::uint32_t previous) {
    std::uint32_t value = ~previous;
    for (const auto byte : bytes) value = crc_table[(value ^ static_cast<std::uint8_t>(byte)) & 0xFFU] ^ (value >> 8U);
    return ~value;
}

}  // namespace

struct Sha256::Context {
    ContextPointer evp{EVP_MD_CTX_new()};
};

Sha256::Sha256() : context_(std::make_unique<Context>()) {
    demand(context_->evp != nullptr && EVP_DigestInit_ex(context_->evp.get(), EVP_sha256(), nullptr) == 1);
}

Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;
Sha256::~Sha256() = default;

void Sha256::update(std::string_view bytes) {
    demand(EVP_DigestUpdate(context_->evp.get(), bytes.data(), bytes.size()) == 1);
}

void Sha256::update(std::span<const std::uint8_t> bytes) {
    demand(EVP_DigestUpdate(context_->evp.get(), bytes.data(), bytes.size()) == 1);
}

std::string Sha256::hex() const {
    // Finishing ends a context, so a copy is finished.
    const ContextPointer copy(EVP_MD_CTX_new());
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    demand(copy != nullptr && EVP_MD_CTX_copy_ex(copy.get(), context_->evp.get()) == 1 &&
           EVP_DigestFinal_ex(copy.get(), digest.data(), &size) == 1);
    constexpr std::string_view digits = "0123456789abcdef";
    std::string out;
    for (unsigned int i = 0; i < size; ++i) {
        out += digits[digest[i] >> 4U];
        out += digits[digest[i] & 0xFU];
    }
    return out;
}

std::string sha256Hex(std::string_view bytes) {
    Sha256 sha;
    sha.update(bytes);
    return sha.hex();
}

std::uint32_t crc32(std::string_view bytes, std::uint32_t previous) { return crcOf(bytes, previous); }
std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t previous) { return crcOf(bytes, previous); }

}  // namespace cusp::base
