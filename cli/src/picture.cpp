// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A depth buffer and a small encoder.
#include "picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cusp::cli {
namespace {

using geometry::Vector3;

void append32(std::string& out, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> static_cast<unsigned>(shift) & 255U);
}

std::uint32_t crcOf(const std::string& bytes) {
    std::uint32_t crc = 0xFFFFFFFFU;
    for (const char c : bytes) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? crc >> 1U ^ 0xEDB88320U : crc >> 1U;
    }
    return ~crc;
}

void appendChunk(std::string& out, const std::string& type, const std::string& data) {
    append32(out, static_cast<std::uint32_t>(data.size()));
    out += type + data;
    append32(out, crcOf(type + data));
}

/// Deflate with the fixed codes; repetitions of the last byte are the only matches.
class Deflate {
public:
    [[nodiscard]] std::string run(const std::string& bytes) {
        out_ = "\x78\x01";
        put(3, 3);  // last block, fixed codes
        for (std::size_t i = 0; i < bytes.size();) {
            std::size_t run = 0;
            while (i > 0 && i + run < bytes.size() && bytes[i + run] == bytes[i - 1] && run < longest) ++run;
            if (run >= 3) {
                const std::size_t taken = run == longest ? longest : std::min<std::size_t>(run, 10);
                symbol(taken == longest ? 285 : 254 + static_cast<std::uint32_t>(taken));
                put(0, 5);  // distance 1
                i += taken;
            } else {
                symbol(static_cast<unsigned char>(bytes[i++]));
            }
        }
        symbol(256);
        if (filled_ > 0) out_ += static_cast<char>(bits_);
        append32(out_, adlerOf(bytes));
        return std::move(out_);
    }

private:
    static constexpr std::size_t longest = 258;

    static std::uint32_t adlerOf(const std::string& bytes) {
        constexpr std::uint32_t modulus = 65521;
        std::uint32_t a = 1;
        std::uint32_t b = 0;
        for (const char c : bytes) {
            a = (a + static_cast<unsigned char>(c)) % modulus;
            b = (b + a) % modulus;
        }
        return b << 16U | a;
    }
    /// Lowest bit first.
    void put(std::uint32_t value, unsigned count) {
        for (unsigned i = 0; i < count; ++i) {
            bits_ |= (value >> i & 1U) << filled_;
            if (++filled_ < 8) continue;
            out_ += static_cast<char>(bits_);
            bits_ = 0;
            filled_ = 0;
        }
    }
    /// Huffman codes go highest bit first.
    void code(std::uint32_t value, unsigned count) {
        for (unsigned i = count; i-- > 0;) put(value >> i & 1U, 1);
    }
    void symbol(std::uint32_t s) {
        if (s < 144)
            code(0x30 + s, 8);
        else if (s < 256)
            code(0x190 + s - 144, 9);
        else if (s < 280)
            code(s - 256, 7);
        else
            code(0xC0 + s - 280, 8);
    }

    std::string out_;
    std::uint32_t bits_ = 0;
    unsigned filled_ = 0;
};

}  // namespace

std::string pngOf(std::span<const Rgb> pixels, std::size_t width, std::size_t height) {
    std::string rows;
    rows.reserve(height * (3 * width + 1));
    for (std::size_t y = 0; y < height; ++y) {
        rows += '\1';  // each byte less that of the pixel to the left: even areas become zeros
        for (std::size_t x = 0; x < width; ++x)
            for (std::size_t k = 0; k < 3; ++k) {
                const unsigned here = pixels[y * width + x][k];
                const unsigned left = x > 0 ? pixels[y * width + x - 1][k] : 0U;
                rows += static_cast<char>((here - left) & 255U);
            }
    }
    std::string head;
    append32(head, static_cast<std::uint32_t>(width));
    append32(head, static_cast<std::uint32_t>(height));
    head += std::string("\x08\x02\x00\x00\x00", 5);
    std::string out = "\x89PNG\r\n\x1a\n";
    appendChunk(out, "IHDR", head);
    appendChunk(out, "IDAT", Deflate().run(rows));
    appendChunk(out, "IEND", {});
    return out;
}

Picture::Picture(std::size_t width, std::size_t height, Rgb ground)
    : width_(width),
      height_(height),
      pixels_(width * height, ground),
      depth_(width * height, -std::numeric_limits<double>::infinity()) {}

void Picture::lookAt(const Eigen::AlignedBox3d& box) {
    const Vector3 eye = Vector3(0.75, -1.1, 0.8).normalized();
    const Vector3 right = Vector3::UnitZ().cross(eye).normalized();
    view_.row(0) = right;
    view_.row(1) = right.cross(eye);
    view_.row(2) = eye;
    center_ = box.center();
    double across = 0.0;
    double down = 0.0;
    for (const auto corner : {box.BottomLeftFloor, box.BottomRightFloor, box.TopLeftFloor, box.TopRightFloor,
                              box.BottomLeftCeil, box.BottomRightCeil, box.TopLeftCeil, box.TopRightCeil}) {
        const Vector3 at = view_ * (box.corner(corner) - center_);
        across = std::max(across, std::abs(at[0]));
        down = std::max(down, std::abs(at[1]));
    }
    constexpr double margin = 0.46;
    scale_ = margin * std::min(static_cast<double>(width_) / across, static_cast<double>(height_) / down);
}

Vector3 Picture::onPicture(const Vector3& point) const {
    const Vector3 at = scale_ * (view_ * (point - center_));
    return {at[0] + 0.5 * static_cast<double>(width_), at[1] + 0.5 * static_cast<double>(height_), at[2]};
}

void Picture::draw(const geometry::TriangleMesh& mesh, std::span<const Rgb> colors) {
    const Vector3 light = (view_.transpose() * Vector3(-0.4, -0.6, 0.7)).normalized();
    std::vector<Vector3> normals(mesh.vertices.size(), Vector3::Zero());
    for (const auto& t : mesh.triangles) {
        const Vector3 n = (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
        for (const std::uint32_t corner : t) normals[corner] += n;
    }
    for (const auto& t : mesh.triangles) {
        std::array<Vector3, 3> corners;
        std::array<Vector3, 3> shades;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = onPicture(mesh.vertices[t[k]]);
            const double size = normals[t[k]].norm();
            const double lit = size > 0.0 ? std::max(0.0, normals[t[k]].dot(light) / size) : 0.0;
            const Rgb& c = colors[t[k]];
            shades[k] = (0.45 + 0.55 * lit) * Vector3(c[0], c[1], c[2]);
        }
        fill(corners, shades);
    }
}

void Picture::fill(const std::array<Vector3, 3>& corners, const std::array<Vector3, 3>& colors) {
    const auto side = [](const Vector3& a, const Vector3& b, double x, double y) {
        return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
    };
    const double area = side(corners[0], corners[1], corners[2][0], corners[2][1]);
    if (area == 0.0) return;
    const auto bounded = [](double value, std::size_t end) {
        return static_cast<std::size_t>(std::clamp(value, 0.0, static_cast<double>(end)));
    };
    const auto [left, right] = std::minmax({corners[0][0], corners[1][0], corners[2][0]});
    const auto [top, bottom] = std::minmax({corners[0][1], corners[1][1], corners[2][1]});
    for (std::size_t y = bounded(std::floor(top), height_); y < bounded(std::ceil(bottom) + 1.0, height_); ++y)
        for (std::size_t x = bounded(std::floor(left), width_); x < bounded(std::ceil(right) + 1.0, width_); ++x) {
            const double px = static_cast<double>(x) + 0.5;
            const double py = static_cast<double>(y) + 0.5;
            const double a = side(corners[1], corners[2], px, py) / area;
            const double b = side(corners[2], corners[0], px, py) / area;
            const double c = 1.0 - a - b;
            if (a < 0.0 || b < 0.0 || c < 0.0) continue;
            const double depth = a * corners[0][2] + b * corners[1][2] + c * corners[2][2];
            double& before = depth_[y * width_ + x];
            if (depth <= before) continue;
            before = depth;
            const Vector3 color = a * colors[0] + b * colors[1] + c * colors[2];
            for (int k = 0; k < 3; ++k)
                pixels_[y * width_ + x][static_cast<std::size_t>(k)] =
                    static_cast<std::uint8_t>(std::clamp(color[k], 0.0, 255.0));
        }
}

void Picture::mark(const Vector3& at, Rgb color) {
    const Vector3 place = onPicture(at);
    constexpr double radius = 9.0;
    constexpr double width = 3.0;
    for (std::size_t y = 0; y < height_; ++y) {
        if (std::abs(static_cast<double>(y) - place[1]) > radius + width) continue;
        for (std::size_t x = 0; x < width_; ++x) {
            const double away = std::hypot(static_cast<double>(x) - place[0], static_cast<double>(y) - place[1]);
            if (std::abs(away - radius) < 0.5 * width) pixels_[y * width_ + x] = color;
        }
    }
}

std::string Picture::png() const { return pngOf(pixels_, width_, height_); }

}  // namespace cusp::cli
