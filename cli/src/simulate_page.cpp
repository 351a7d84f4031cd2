// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Rounds and thins what the page draws.
#include "simulate_page.hpp"

#include "picture.hpp"

#include <cusp/pages/render.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>

namespace cusp::cli {
namespace {

using base::Json;
using geometry::TriangleMesh;
using geometry::Vector3;

constexpr double most_triangles = 90'000.0;
constexpr std::size_t most_path_points = 6'000;
constexpr std::size_t most_collisions = 300;
/// Farther off the nominal is no deviation but another part of the stock.
constexpr double colored_tolerances = 20.0;

double rounded(double value) { return std::round(value * 1e3) / 1e3; }

std::size_t strideFor(const simulation::Stock& stock) {
    const simulation::DexelLattice& lattice = stock.lattice();
    double triangles = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        triangles += 4.0 * static_cast<double>(lattice.count[(axis + 1) % 3]) *
                     static_cast<double>(lattice.count[(axis + 2) % 3]);
    return static_cast<std::size_t>(std::max(1.0, std::ceil(std::sqrt(triangles / most_triangles))));
}

/// Lists of numbers as base64 (RFC 4648) of their little-endian bytes: a mesh as decimal text would be ten times as long.
class Packed {
public:
    template <class Value>
    void add(Value value) {
        std::array<unsigned char, sizeof(Value)> bytes{};
        std::memcpy(bytes.data(), &value, sizeof(Value));
        for (const unsigned char byte : bytes) {
            group_ = group_ << 8U | byte;
            if (++count_ == 3) flush();
        }
    }
    [[nodiscard]] std::string text() {
        if (count_ > 0) flush();
        return std::move(text_);
    }

private:
    void flush() {
        static constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        group_ <<= 8U * (3 - count_);
        for (unsigned k = 0; k < 4; ++k) text_ += k <= count_ ? letters[group_ >> (18U - 6U * k) & 63U] : '=';
        group_ = 0;
        count_ = 0;
    }
    std::string text_;
    std::uint32_t group_ = 0;
    unsigned count_ = 0;
};

Json meshJson(const TriangleMesh& mesh) {
    Packed vertices;
    for (const Vector3& v : mesh.vertices)
        for (int k = 0; k < 3; ++k) vertices.add(static_cast<float>(v[k]));
    Packed triangles;
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t corner : t) triangles.add(corner);
    return {{"vertices_mm", vertices.text()}, {"triangles", triangles.text()}};
}

/// The outline of a turned body: radius and height, from the bottom's middle to the top's.
Json profileOf(const simulation::CutterBody& body) {
    constexpr int steps = 40;
    const double bottom = body.base();
    const double top = body.height();
    const auto radiusAt = [&](double z) {
        double low = 0.0;
        double high = body.largestRadius() + 1e-6;
        if (body.at(0.0, z).distance_mm > 0.0) return 0.0;
        for (int i = 0; i < 40; ++i) {
            const double middle = 0.5 * (low + high);
            (body.at(middle, z).distance_mm <= 0.0 ? low : high) = middle;
        }
        return low;
    };
    Json out = Json::array();
    out.push_back({0.0, rounded(bottom)});
    for (int i = 0; i <= steps; ++i) {
        // Close together near the bottom, where corners are.
        const double z = bottom + (top - bottom) * std::pow(static_cast<double>(i) / steps, 2);
        out.push_back({rounded(radiusAt(z)), rounded(z)});
    }
    out.push_back({0.0, rounded(top)});
    return out;
}

Json toolsJson(const SimulateInput& input) {
    Json out = Json::array();
    for (std::size_t i = 0; i < input.assemblies.size(); ++i) {
        Json bodies = Json::array();
        for (const simulation::AssemblyBody& body : input.assemblies[i].bodies)
            bodies.push_back({{"part", simulation::nameOf(body.part)}, {"profile_mm", profileOf(body.body)}});
        const toolpath::Tool* tool = input.path.tools[i];
        out.push_back({{"name", tool != nullptr ? tool->name : std::string()}, {"bodies", std::move(bodies)}});
    }
    return out;
}

Json pathJson(const SimulateInput& input, const SimulateResult& done) {
    const auto& moves = input.path.moves;
    const std::size_t step = moves.size() / most_path_points + 1;
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < moves.size(); i += step) shown.push_back(i);
    for (std::size_t i = 0; i < std::min(most_collisions, done.collisions.size()); ++i)
        shown.push_back(done.collisions[i].collision.move);
    std::sort(shown.begin(), shown.end());
    shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
    Json tip = Json::array();
    Json axis = Json::array();
    Json move = Json::array();
    Json tool = Json::array();
    Json rapid = Json::array();
    Json line = Json::array();
    for (const std::size_t i : shown) {
        for (int k = 0; k < 3; ++k) {
            tip.push_back(rounded(moves[i].to.tip_mm[k]));
            axis.push_back(std::round(moves[i].to.axis[k] * 1e5) / 1e5);
        }
        move.push_back(i);
        tool.push_back(moves[i].cutter);
        rapid.push_back(moves[i].kind == toolpath::MotionKind::Rapid ? 1 : 0);
        line.push_back(moves[i].line);
    }
    return {{"tip_mm", tip},  {"axis", axis}, {"move", move}, {"tool", tool},
            {"rapid", rapid}, {"line", line}, {"every", step}};
}

Rgb mix(Rgb a, Rgb b, double share) {
    Rgb out{};
    for (std::size_t k = 0; k < 3; ++k)
        out[k] = static_cast<std::uint8_t>(std::lround(a[k] + share * (static_cast<double>(b[k]) - a[k])));
    return out;
}

// The tokens of the pages, for paper.
constexpr Rgb ground{0xfb, 0xfb, 0xf9};
constexpr Rgb metal{0x9f, 0xae, 0xbb};
constexpr Rgb low{0x17, 0x47, 0x9e};
constexpr Rgb zero{0xcf, 0xcf, 0xc6};
constexpr Rgb high{0xb3, 0x4d, 0x00};
constexpr Rgb alarm{0xa3, 0x30, 0x1a};

}  // namespace

SimulateMeshes meshesOf(const SimulateInput& input, const SimulateResult& done) {
    SimulateMeshes out;
    out.stride = strideFor(done.after);
    out.before = simulation::surfaceMesh(done.before, out.stride);
    out.after = simulation::surfaceMesh(done.after, out.stride);
    out.deviation_mm.assign(out.after.vertices.size(), std::numeric_limits<double>::quiet_NaN());
    if (!input.nominal) return out;
    std::vector<geometry::Footpoint> feet(out.after.vertices.size());
    input.nominal->closest(out.after.vertices, feet, false);
    // The stock's own faces beside the nominal are not what was cut.
    const Eigen::AlignedBox3d& box = done.before.lattice().box;
    for (std::size_t i = 0; i < feet.size(); ++i) {
        const Vector3& at = out.after.vertices[i];
        const double inside = std::min((at - box.min()).minCoeff(), (box.max() - at).minCoeff());
        if (!feet[i].on_boundary && inside > 1e-9) out.deviation_mm[i] = feet[i].distance_mm;
    }
    return out;
}

base::Result<std::string> simulatePage(const SimulateFlags& flags, const SimulateInput& input,
                                       const SimulateResult& done, const SimulateMeshes& meshes) {
    Json document = simulateSummary(flags, input, done);
    document["program"] = input.is_program;
    document["collision_count"] = done.collisions.size();
    Json& collisions = document["collisions"];
    if (collisions.size() > most_collisions)
        collisions.erase(collisions.begin() + static_cast<std::ptrdiff_t>(most_collisions), collisions.end());
    document["mesh_mm"] = static_cast<double>(meshes.stride) * flags.resolution_mm;
    document["before"] = meshJson(meshes.before);
    document["after"] = meshJson(meshes.after);
    if (input.nominal) {
        Packed deviation;
        for (const double value : meshes.deviation_mm)
            deviation.add(std::abs(value) <= colored_tolerances * flags.tolerance_mm
                              ? static_cast<float>(value)
                              : std::numeric_limits<float>::quiet_NaN());
        document["deviation_mm"] = deviation.text();
    }
    document["path"] = pathJson(input, done);
    document["tool_shapes"] = toolsJson(input);
    return base::jsonText(document).and_then(
        [](const std::string& json) { return pages::renderPage("simulation", json); });
}

std::string simulatePng(const SimulateFlags& flags, const SimulateResult& done, const SimulateMeshes& meshes,
                        SimulatePicture what) {
    constexpr std::size_t width = 1200;
    constexpr std::size_t height = 860;
    Picture picture(width, height, ground);
    picture.lookAt(done.before.lattice().box);
    const TriangleMesh& mesh = what == SimulatePicture::Before ? meshes.before : meshes.after;
    std::vector<Rgb> colors(mesh.vertices.size(), metal);
    if (what == SimulatePicture::Deviation)
        for (std::size_t i = 0; i < colors.size(); ++i) {
            const double value = meshes.deviation_mm[i] / flags.tolerance_mm;
            if (std::abs(value) <= colored_tolerances)
                colors[i] = mix(zero, value < 0.0 ? low : high, std::min(1.0, std::abs(value)));
        }
    picture.draw(mesh, colors);
    if (what != SimulatePicture::Before)
        for (std::size_t i = 0; i < std::min(most_collisions, done.collisions.size()); ++i)
            picture.mark(done.collisions[i].collision.position_mm, alarm);
    return picture.png();
}

}  // namespace cusp::cli
