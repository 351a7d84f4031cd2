// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// PCD and PLY clouds: text, binary of both byte orders, compressed; damaged ones end in an error.
#include "points_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace cusp::inspect::test {
namespace {

template <class T>
std::string bytesOf(T value, bool big_endian = false) {
    std::string out(sizeof(T), '\0');
    std::memcpy(out.data(), &value, sizeof(T));
    if (big_endian != (std::endian::native == std::endian::big)) std::reverse(out.begin(), out.end());
    return out;
}

std::string pcdHeader(const std::string& points, const std::string& data) {
    return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z intensity\nSIZE 8 8 8 4\nTYPE F F F U\n"
           "COUNT 1 1 1 1\nWIDTH " +
           points + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points + "\nDATA " + data + "\n";
}

TEST(Pcd, Ascii) {
    const PointsRead out = readText(pcdHeader("3", "ascii") + "1.5 2 3 7\nnan nan nan 0\n4 5 6 8\n");
    ASSERT_EQ(out.errors, "");
    EXPECT_EQ(out.points.positions, (std::vector<Vector3>{{1.5, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(out.remarks,
              "13: warning: 1 points of the cloud have no coordinates (NaN) and are passed over [points.missing]\n");
    EXPECT_EQ(out.points.format, "pcd");
}

TEST(Pcd, Binary) {
    std::string data;
    for (const double x : {1.25, 4.0})
        data += bytesOf(x) + bytesOf(2.0 * x) + bytesOf(1e6 + x) + bytesOf(std::uint32_t{9});
    const PointsRead out = readText(pcdHeader("2", "binary") + data);
    ASSERT_EQ(out.errors, "");
    EXPECT_EQ(out.points.positions, (std::vector<Vector3>{{1.25, 2.5, 1000001.25}, {4, 8, 1000004}}));
    EXPECT_EQ(readText(pcdHeader("2", "binary") + data.substr(1)).errors,
              "error: the file ends before the 2 points its header promises [points.truncated]\n");
}

/// LZF with literals and, for the run of equal bytes at the end, one reference.
TEST(Pcd, Compressed) {
    std::string raw = bytesOf(1.0) + bytesOf(2.0) + bytesOf(3.0) + bytesOf(4.0) + bytesOf(5.0) + bytesOf(6.0);
    std::string packed;
    for (std::size_t at = 0; at < raw.size(); at += 32) {
        const std::string run = raw.substr(at, 32);
        packed += static_cast<char>(run.size() - 1) + run;
    }
    raw += std::string(8, '\0');
    packed += std::string("\x00\x00", 2);  // a literal NUL …
    packed += std::string("\xa0\x00", 2);  // … seven times more, from one byte back
    const auto sizes = [&raw](const std::string& p) {
        return bytesOf(static_cast<std::uint32_t>(p.size())) + bytesOf(static_cast<std::uint32_t>(raw.size()));
    };
    const PointsRead out = readText(pcdHeader("2", "binary_compressed") + sizes(packed) + packed);
    ASSERT_EQ(out.errors, "");
    EXPECT_EQ(out.points.positions, (std::vector<Vector3>{{1, 3, 5}, {2, 4, 6}}));
    std::string damaged = packed;
    damaged.back() = '\x7f';
    EXPECT_EQ(readText(pcdHeader("2", "binary_compressed") + sizes(damaged) + damaged).errors,
              "error: the packed data of the cloud are damaged [points.format]\n");
    EXPECT_EQ(readText(pcdHeader("2", "binary_compressed") + sizes(packed) + packed.substr(2)).errors,
              "error: the file ends in its packed data [points.truncated]\n");
}

TEST(PointFiles, PackedOrForeignOnesSayWhatToDo) {
    EXPECT_EQ(readText(std::string("\x1f\x8b\x08\x00\x00\x00", 6)).errors,
              "error: the file is compressed (gzip); unpack it first [points.format]\n");
    EXPECT_EQ(readText(std::string("PK\x03\x04\x14\x00", 6)).errors,
              "error: the file is compressed (zip); unpack it first [points.format]\n");
    EXPECT_EQ(readText(std::string("\xff\xfe"
                                   "1\x00",
                                   4))
                  .errors,
              "error: the file is UTF-16 text; save it as UTF-8 or plain text [points.format]\n");
    EXPECT_EQ(readText(std::string("\x7f"
                                   "ELF\x00",
                                   5))
                  .errors,
              "error: the file is neither text nor a PLY or PCD cloud [points.format]\n");
}

std::string plyHeader(const std::string& format) {
    return "ply\nformat " + format +
           " 1.0\ncomment c\nelement vertex 2\nproperty float x\nproperty double y\nproperty float z\nproperty uchar red\n"
           "property float nx\nproperty float ny\nproperty float nz\nelement face 1\nproperty list uchar int vertex_indices\n"
           "end_header\n";
}

TEST(Ply, AllEncodings) {
    const std::vector<Vector3> expected{{1.5, 2.25, 3}, {-4, 5, 6}};
    const PointsRead ascii = readText(plyHeader("ascii") + "1.5 2.25 3 255 0 0 1\n-4 5 6 0 0 1 0\n3 0 1 1\n");
    ASSERT_EQ(ascii.errors, "");
    EXPECT_EQ(ascii.points.positions, expected);
    EXPECT_EQ(ascii.points.directions, (std::vector<Vector3>{{0, 0, 1}, {0, 1, 0}}));
    for (const bool big : {false, true}) {
        std::string data;
        for (const Vector3& p : expected)
            data += bytesOf(static_cast<float>(p.x()), big) + bytesOf(p.y(), big) +
                    bytesOf(static_cast<float>(p.z()), big) + "\x01" + bytesOf(0.0F, big) + bytesOf(0.6F, big) +
                    bytesOf(0.8F, big);
        const PointsRead out = readText(plyHeader(big ? "binary_big_endian" : "binary_little_endian") + data);
        ASSERT_EQ(out.errors, "");
        EXPECT_EQ(out.points.positions, expected);
        EXPECT_EQ(out.points.directions.size(), 2U);
        EXPECT_EQ(readText(plyHeader(big ? "binary_big_endian" : "binary_little_endian") + data.substr(1)).errors,
                  "error: the file ends after 1 of 2 vertices [points.truncated]\n");
    }
}

TEST(Ply, NormalsThatAreNoneAreNotUsed) {
    const PointsRead out = readText(plyHeader("ascii") + "1 2 3 0 0 0 0\n4 5 6 0 0 0 1\n");
    EXPECT_EQ(out.points.size(), 2U);
    EXPECT_TRUE(out.points.directions.empty());
    EXPECT_EQ(out.remarks,
              "15: warning: 1 of 2 directions i, j, k are no unit vectors (the first: length 0); none is used "
              "[points.directions]\n");
}

}  // namespace
}  // namespace cusp::inspect::test
