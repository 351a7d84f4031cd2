// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Generates the benchmark path; the tool is placed exactly, without any iteration.
#include "benchmark_path.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <vector>

namespace cusp::test_support {
namespace {

using Vector = std::array<double, 3>;

Vector combined(double a, const Vector& v, double b, const Vector& w) {
    return {a * v[0] + b * w[0], a * v[1] + b * w[1], a * v[2] + b * w[2]};
}

Vector cross(const Vector& v, const Vector& w) {
    return {v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]};
}

Vector normalized(const Vector& v) {
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    return {v[0] / length, v[1] / length, v[2] / length};
}

/// Fountas 2017 eq. 14, u and v in [0,1], mm.
Vector surfacePoint(double u, double v) {
    return {-94.4 + 88.9 * v + 5.6 * v * v, -131.3 * u + 28.1 * u * u,
            5.9 * (u * u * v * v + u * u * v) - 3.9 * v * v * u + 76.2 * u * u + 6.7 * v * v - 27.3 * u * v - 50.8 * u +
                25.0 * v + 12.1};
}

Vector derivativeU(double u, double v) {
    return {0.0, -131.3 + 56.2 * u, 11.8 * (u * v * v + u * v) - 3.9 * v * v + 152.4 * u - 27.3 * v - 50.8};
}

Vector derivativeV(double u, double v) {
    return {88.9 + 11.2 * v, 0.0, 5.9 * (2.0 * u * u * v + u * u) - 7.8 * v * u + 13.4 * v - 27.3 * u + 25.0};
}

struct Pose {
    Vector tip;
    Vector axis;
};

/// The toroidal tool that touches the surface at (u, v) with the lead λ towards the feed f, where n is the unit normal
/// on the tool's side:
///   axis   a = cos λ · n + sin λ · f
/// The torus (tube radius r around a circle of radius e = D/2 − r, r above the tip T) has the outward normal −n where its
/// tube's centre C = CC + r·n lies in the direction d of the projection of −n across the axis:
///   −n + (n·a)·a = sin λ · (cos λ · f − sin λ · n)   hence   d = cos λ · f − sin λ · n
/// C = T + r·a + e·d, and so
///   T = CC + r·n − r·a − e·d
Pose poseAt(const BenchmarkPath& path, double u, double v, double feed_sign) {
    const Vector along = derivativeV(u, v);
    const Vector n = normalized(cross(along, derivativeU(u, v)));
    const Vector up = n[2] > 0.0 ? n : combined(-1.0, n, 0.0, n);
    const Vector f = combined(feed_sign, normalized(along), 0.0, along);
    const double r = path.corner_radius_mm;
    const double e = path.diameter_mm / 2.0 - r;
    const Vector a = combined(std::cos(path.lead_rad), up, std::sin(path.lead_rad), f);
    const Vector d = combined(std::cos(path.lead_rad), f, -std::sin(path.lead_rad), up);
    const Vector centre = combined(1.0, surfacePoint(u, v), r, up);
    return {combined(1.0, combined(1.0, centre, -r, a), -e, d), a};
}

/// u of the pass at height y: the root of 28.1 u² − 131.3 u − y = 0 in [0,1].
double uAtY(double y) { return (131.3 - std::sqrt(131.3 * 131.3 + 4.0 * 28.1 * y)) / (2.0 * 28.1); }

std::vector<Pose> passPoses(const BenchmarkPath& path, int pass) {
    const double y_end = surfacePoint(1.0, 0.0)[1];
    const double u = uAtY(y_end * (pass + 0.5) / path.passes);
    const bool forward = pass % 2 == 0;
    std::vector<Pose> poses;
    for (int i = 0; i < path.points_per_pass; ++i) {
        const double t = static_cast<double>(i) / (path.points_per_pass - 1);
        poses.push_back(poseAt(path, u, forward ? t : 1.0 - t, forward ? 1.0 : -1.0));
    }
    return poses;
}

class ClText {
public:
    template <class... Args>
    void line(fmt::format_string<Args...> format, Args&&... args) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
        text_ += '\n';
    }
    void go(const Vector& tip, const Vector& axis) {
        line("GOTO/{:.5f},{:.5f},{:.5f},{:.7f},{:.7f},{:.7f}", rounded(tip[0]), rounded(tip[1]), rounded(tip[2]),
             rounded(axis[0]), rounded(axis[1]), rounded(axis[2]));
    }
    void rapidTo(const Vector& tip, const Vector& axis) {
        line("RAPID");
        go(tip, axis);
    }
    [[nodiscard]] std::string take() { return std::move(text_); }

private:
    /// No "-0.00000".
    static double rounded(double value) { return std::abs(value) < 5e-8 ? 0.0 : value; }

    std::string text_;
};

}  // namespace

std::string benchmarkPathText(const BenchmarkPath& path) {
    ClText text;
    text.line("$$ Finishing path over the benchmark surface of Fountas et al. 2017 (eq. 14): passes along X, zig-zag.");
    text.line("UNITS/MM");
    text.line("TOOL PATH/SURFACE_FINISH,TOOL,TOROID_D{:g}_R{:g}", path.diameter_mm, path.corner_radius_mm);
    text.line("TLDATA/MILL,{:.4f},{:.4f},{:.4f},0.0000,0.0000", path.diameter_mm, path.corner_radius_mm, 50.0);
    text.line("MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000");
    text.line("LOAD/TOOL,1,ADJUST,1");
    text.line("SPINDL/RPM,{:g},CLW", path.spindle_rpm);
    text.line("COOLNT/FLOOD");
    Pose last{};
    for (int pass = 0; pass < path.passes; ++pass) {
        const std::vector<Pose> poses = passPoses(path, pass);
        const Pose& first = poses.front();
        const Vector above = combined(1.0, first.tip, path.retract_mm, first.axis);
        if (pass == 0) {
            text.rapidTo({above[0], above[1], path.clearance_z_mm}, first.axis);
        }
        text.rapidTo(above, first.axis);
        text.line("FEDRAT/MMPM,{:.4f}", path.plunge_mm_per_min);
        text.go(first.tip, first.axis);
        text.line("FEDRAT/MMPM,{:.4f}", path.feed_mm_per_min);
        for (std::size_t i = 1; i < poses.size(); ++i) {
            text.go(poses[i].tip, poses[i].axis);
        }
        last = poses.back();
        text.rapidTo(combined(1.0, last.tip, path.retract_mm, last.axis), last.axis);
    }
    const Vector above = combined(1.0, last.tip, path.retract_mm, last.axis);
    text.rapidTo({above[0], above[1], path.clearance_z_mm}, last.axis);
    text.line("COOLNT/OFF");
    text.line("SPINDL/OFF");
    text.line("END-OF-PATH");
    return text.take();
}

}  // namespace cusp::test_support
