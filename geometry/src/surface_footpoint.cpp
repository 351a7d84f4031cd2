// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From the nearest place to a footpoint: normal, sign, and whether the shape ends there.
#include "surface_index.hpp"

#include <algorithm>
#include <cmath>

namespace cusp::geometry {

using detail::PatchFoot;

namespace {

/// Feet of one place on several faces differ by rounding, and by the gaps between faces as CAD systems leave them.
constexpr double same_place_mm = 1e-5;
/// How far off its normal a query may stand and still count as standing on it: this, and as much per millimetre of distance.
constexpr double along_normal_mm = 1e-9;

/// At a pole the search cannot tell points apart whose distances differ by less than its tolerance.
double slackOf(const PatchFoot& foot) {
    const double distance_mm = std::sqrt(foot.squared_mm2);
    const double at_pole = crossNormal(foot.point).isZero() ? std::sqrt(detail::search_tolerance_mm) : 0.0;
    return along_normal_mm * (1.0 + distance_mm) + 4.0 * at_pole * std::sqrt(1.0 + distance_mm);
}

/// Whether the offset has a part that no combination of the normals explains: then the shape ends at the foot.
bool leavesSpan(const Vector3& offset, const std::vector<Vector3>& normals, double slack_mm) {
    // Faces that meet smoothly have one normal; beyond this angle two normals span a plane.
    constexpr double sharp_rad = 1e-3;
    std::vector<Vector3> basis;
    for (const Vector3& normal : normals) {
        Vector3 rest = normal;
        for (const Vector3& axis : basis) rest -= rest.dot(axis) * axis;
        if (rest.norm() > sharp_rad) basis.emplace_back(rest.normalized());
    }
    Vector3 rest = offset;
    for (const Vector3& axis : basis) rest -= rest.dot(axis) * axis;
    return rest.norm() > slack_mm;
}

}  // namespace

void ParametricSurface::Index::locate(std::size_t patch, double u, double v, Footpoint& out) const {
    const auto parameters = faceParameters(patch, u, v);
    out.face = static_cast<std::int32_t>(places_[patch].face);
    out.u = parameters[0];
    out.v = parameters[1];
}

Footpoint ParametricSurface::Index::footpointOf(const detail::QuickFoot& quick, const Vector3& local) const {
    Footpoint out;
    locate(quick.patch, quick.u, quick.v, out);
    out.position = origin_ + quick.position;
    out.normal = faceOfPatch(quick.patch).outwardSign() * quick.ds.cross(quick.dt).normalized();
    const Vector3 offset = local - quick.position;
    out.distance_mm = std::copysign(offset.norm(), offset.dot(out.normal));
    return out;
}

Footpoint ParametricSurface::Index::footpointOf(const Nearest& best, const Vector3& local) const {
    const PatchFoot& foot = best.foot;
    const SurfaceFace& face = faceOfPatch(best.patch);
    Footpoint out;
    locate(best.patch, foot.u, foot.v, out);
    out.position = origin_ + foot.point.position;
    out.normal = face.outwardSign() * crossNormal(foot.point);
    if (out.normal.isZero()) out.normal = face.normal(out.u, out.v);
    const bool at_border = foot.u <= 0.0 || foot.u >= 1.0 || foot.v <= 0.0 || foot.v >= 1.0;
    finish({foot.point.position, local - foot.point.position, slackOf(foot)}, at_border, local, out);
    return out;
}

Footpoint ParametricSurface::Index::edgeFootpointOf(const Nearest& best, const Vector3& local) const {
    const EdgeUse& use = edges_[*best.edge].uses.front();
    const SurfaceFace& face = faces_[use.face];
    const Vector3 parameters = use.parameters.evaluate(best.t);
    Footpoint out;
    out.face = static_cast<std::int32_t>(use.face);
    out.u = std::clamp(parameters.x(), face.breaksU().front(), face.breaksU().back());
    out.v = std::clamp(parameters.y(), face.breaksV().front(), face.breaksV().back());
    out.position = origin_ + best.foot.point.position;
    out.normal = face.normal(out.u, out.v);
    const Vector3 offset = local - best.foot.point.position;
    // The normal is taken where the file's parameters say, which is off by the file's tolerance.
    finish({best.foot.point.position, offset, along_normal_mm + 1e-6 * offset.norm()}, true, local, out);
    return out;
}

void ParametricSurface::Index::finish(const Place& place, bool at_border, const Vector3& local, Footpoint& out) const {
    const double along = place.offset.dot(out.normal);
    out.distance_mm = std::copysign(place.offset.norm(), along);
    if (!at_border || (place.offset - along * out.normal).norm() <= place.slack_mm) return;
    // The query does not stand on the normal: the faces that meet here decide together.
    std::vector<Vector3> normals = normalsAt(place, local);
    normals.insert(normals.begin(), out.normal);
    for (const Vector3& normal : normals) {
        if (std::abs(place.offset.dot(normal)) > std::abs(place.offset.dot(out.normal))) out.normal = normal;
    }
    out.distance_mm = std::copysign(place.offset.norm(), place.offset.dot(out.normal));
    out.on_boundary = leavesSpan(place.offset, normals, place.slack_mm);
}

std::vector<Vector3> ParametricSurface::Index::normalsAt(const Place& place, const Vector3& local) const {
    std::vector<Vector3> normals;
    const double reach = place.offset.norm() + same_place_mm;
    const auto isHere = [&](const Vector3& p) { return (p - place.position).norm() <= same_place_mm; };
    const auto limit = [&] { return reach * reach; };
    tree_.visitNear(local, limit, [&](std::size_t i) {
        const std::size_t item = items_[i];
        if (item >= cells_.size()) {
            const EdgePiece& piece = edge_pieces_[item - cells_.size()];
            detail::CurveFoot foot{0.0, reach * reach, Vector3::Zero()};
            if (!detail::searchCurve(piece.curve, local, foot) || !isHere(foot.position)) return;
            const double t = piece.low_t + foot.t * (piece.high_t - piece.low_t);
            for (const EdgeUse& use : edges_[piece.edge].uses) {
                const Vector3 at = use.parameters.evaluate(t);
                normals.push_back(faces_[use.face].normal(at.x(), at.y()));
            }
            return;
        }
        PatchFoot near;
        near.squared_mm2 = reach * reach;
        bool found = false;
        searchCell(cells_[item], local, reach * reach, [&](const PatchFoot& foot) {
            near = foot;
            found = true;
            return foot.squared_mm2;
        });
        if (!found || !isHere(near.point.position)) return;
        const Vector3 normal = crossNormal(near.point);
        if (!normal.isZero()) normals.push_back(faceOfPatch(cells_[item].patch).outwardSign() * normal);
    });
    return normals;
}

}  // namespace cusp::geometry
