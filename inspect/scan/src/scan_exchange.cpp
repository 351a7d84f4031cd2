// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Counts and doubles one after the other, behind a word that says what they are.
#include "scan_exchange.hpp"

#include <array>
#include <cstring>

namespace cusp::inspect {
namespace {

using geometry::RigidTransform;
using geometry::Vector3;

constexpr std::string_view request_word = "cuspscan";
constexpr std::string_view answer_word = "scanpose";
constexpr std::uint64_t most_items = 10'000'000;

template <class T>
void put(std::string& out, T value) {
    std::array<char, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), &value, sizeof(T));
    out.append(bytes.data(), bytes.size());
}

void put(std::string& out, const std::vector<Vector3>& points) {
    put(out, static_cast<std::uint64_t>(points.size()));
    for (const Vector3& p : points)
        for (const double value : p) put(out, value);
}

class Taker {
public:
    explicit Taker(std::string_view bytes) : bytes_(bytes) {}

    bool word(std::string_view expected) {
        const bool same = bytes_.starts_with(expected);
        if (same) bytes_.remove_prefix(expected.size());
        return same;
    }
    template <class T>
    bool number(T& value) {
        if (bytes_.size() < sizeof(T)) return false;
        std::memcpy(&value, bytes_.data(), sizeof(T));
        bytes_.remove_prefix(sizeof(T));
        return true;
    }
    bool count(std::uint64_t& value, std::size_t item_bytes) {
        return number(value) && value <= most_items && value * item_bytes <= bytes_.size();
    }
    bool points(std::vector<Vector3>& out) {
        std::uint64_t n = 0;
        if (!count(n, 3 * sizeof(double))) return false;
        out.resize(n);
        for (Vector3& p : out)
            for (double& value : p)
                if (!number(value)) return false;
        return true;
    }
    [[nodiscard]] bool atEnd() const { return bytes_.empty(); }

private:
    std::string_view bytes_;
};

}  // namespace

std::string encode(const ScanRequest& request) {
    std::string out(request_word);
    put(out, request.scan);
    put(out, request.surface);
    put(out, request.normals);
    put(out, request.size_mm);
    return out;
}

std::string encode(const ScanAnswer& answer) {
    std::string out(answer_word);
    put(out, static_cast<std::uint64_t>(answer.surface_from_scan.size()));
    for (const RigidTransform& pose : answer.surface_from_scan)
        for (const double value : pose.matrix().reshaped()) put(out, value);
    put(out, answer.outliers);
    return out;
}

std::optional<ScanRequest> decodeRequest(std::string_view bytes) {
    Taker take(bytes);
    ScanRequest out;
    const bool sound = take.word(request_word) && take.points(out.scan) && take.points(out.surface) &&
                       take.points(out.normals) && take.number(out.size_mm) && take.atEnd() &&
                       out.normals.size() == out.surface.size();
    return sound ? std::optional(std::move(out)) : std::nullopt;
}

std::optional<ScanAnswer> decodeAnswer(std::string_view bytes) {
    Taker take(bytes);
    ScanAnswer out;
    std::uint64_t n = 0;
    if (!take.word(answer_word) || !take.count(n, 16 * sizeof(double))) return std::nullopt;
    for (std::uint64_t i = 0; i < n; ++i) {
        RigidTransform pose;
        for (double& value : pose.matrix().reshaped())
            if (!take.number(value)) return std::nullopt;
        out.surface_from_scan.push_back(pose);
    }
    if (!take.number(out.outliers) || !take.atEnd()) return std::nullopt;
    return out;
}

}  // namespace cusp::inspect
