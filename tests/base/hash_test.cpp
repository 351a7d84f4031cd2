// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Digests against their published vectors.
#include <cusp/base/hash.hpp>

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace {

using namespace cusp::base;

// NIST, "Example values: SHA-256" (FIPS 180-4); the million letters: FIPS 180-2 appendix B.3.
TEST(Hash, Sha256KnowsThePublishedVectors) {
    EXPECT_EQ(sha256Hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256Hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256Hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(sha256Hex(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Hash, Sha256InPiecesIsTheSame) {
    const std::string text(1000, 'x');
    for (const std::size_t cut : {0U, 1U, 63U, 64U, 65U, 999U, 1000U}) {
        Sha256 sha;
        sha.update(std::string_view(text).substr(0, cut));
        EXPECT_EQ(sha.hex(), sha256Hex(text.substr(0, cut)));  // looking does not end it
        Sha256 moved = std::move(sha);
        const std::vector<std::uint8_t> rest(text.begin() + static_cast<std::ptrdiff_t>(cut), text.end());
        moved.update(rest);
        EXPECT_EQ(moved.hex(), sha256Hex(text));
    }
}

// "123456789" → CBF43926: the check value of CRC-32/ISO-HDLC in Williams, "A painless guide to CRC error detection
// algorithms" (1993); the sentence's value is what zlib's crc32 gives.
TEST(Hash, Crc32KnowsThePublishedVectors) {
    EXPECT_EQ(crc32(""), 0U);
    EXPECT_EQ(crc32("123456789"), 0xCBF43926U);
    EXPECT_EQ(crc32("The quick brown fox jumps over the lazy dog"), 0x414FA339U);
    EXPECT_EQ(crc32("56789", crc32("1234")), 0xCBF43926U);
    const std::vector<std::uint8_t> bytes{0xFF, 0xFF, 0xFF, 0xFF};
    EXPECT_EQ(crc32(bytes), 0xFFFFFFFFU);
}

}  // namespace
