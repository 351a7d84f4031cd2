// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From a point of the envelope back to the axes that made it.
#include "contact_trace.hpp"

#include <cusp/simulation/cutter_body.hpp>
#include <cusp/simulation/surface_envelope.hpp>

#include <algorithm>
#include <cmath>

namespace cusp::loop {
namespace {

constexpr double band_mm = 1.0;
constexpr simulation::EnvelopeOptions within_band{.band_mm = band_mm};

double distanceTo(const simulation::ToolMove& move, const simulation::CutterBody& body, const Vector3& point,
                  double share) {
    const Vector3 axis = (move.from.axis + share * (move.to.axis - move.from.axis)).normalized();
    const Vector3 way = point - (move.from.tip_mm + share * (move.to.tip_mm - move.from.tip_mm));
    const double height = way.dot(axis);
    return body.at((way - height * axis).norm(), height).distance_mm;
}

/// The share of the move at which the cutter is nearest to the point: convex enough near its end for a golden section.
double nearestShare(const simulation::ToolMove& move, const simulation::CutterBody& body, const Vector3& point) {
    constexpr int looks = 16;
    constexpr int halvings = 40;
    constexpr double golden = 0.6180339887498949;
    int best = 0;
    double least = distanceTo(move, body, point, 0.0);
    for (int i = 1; i <= looks; ++i)
        if (const double d = distanceTo(move, body, point, static_cast<double>(i) / looks); d < least) {
            least = d;
            best = i;
        }
    double low = std::max(0.0, (best - 1.0) / looks);
    double high = std::min(1.0, (best + 1.0) / looks);
    for (int i = 0; i < halvings; ++i) {
        const double one = high - golden * (high - low);
        const double two = low + golden * (high - low);
        if (distanceTo(move, body, point, one) < distanceTo(move, body, point, two))
            high = two;
        else
            low = one;
    }
    return 0.5 * (low + high);
}

/// Share of the way of a move at which a sample stands.
double shareOf(const toolpath::CutterLocation& at, const toolpath::CutterLocation& from,
               const toolpath::CutterLocation& to) {
    const Vector3 way = to.tip_mm - from.tip_mm;
    if (way.squaredNorm() > 1e-12) return (at.tip_mm - from.tip_mm).dot(way) / way.squaredNorm();
    const Vector3 turn = to.axis - from.axis;
    return turn.squaredNorm() > 1e-18 ? (at.axis - from.axis).dot(turn) / turn.squaredNorm() : 0.0;
}

/// Axes and their rates where the tool of `exact` is at `share` of the samples' way.
void axesAt(const AxisTrack& track, const SampleSpan& span, const RealMachine& exact, double share, ContactTrace& out) {
    const auto from = exact.place(track.axes[span.first]);
    const auto to = exact.place(track.axes[span.last]);
    std::size_t k = span.first;
    while (k + 2 <= span.last && shareOf(exact.place(track.axes[k + 1]), from, to) < share) ++k;
    const double before = shareOf(exact.place(track.axes[k]), from, to);
    const double after = shareOf(exact.place(track.axes[k + 1]), from, to);
    const double part = after > before ? std::clamp((share - before) / (after - before), 0.0, 1.0) : 0.0;
    const double step_s = track.time_s[k + 1] - track.time_s[k];
    for (std::size_t a = 0; a < dynamics::max_axes; ++a) {
        const double way = track.axes[k + 1].at(a) - track.axes[k].at(a);
        out.axes.at(a) = track.axes[k].at(a) + part * way;
        out.rates_per_s.at(a) = step_s > 0.0 ? way / step_s : 0.0;
    }
}

/// A ball's tip stays, so that its centre rises while it grows; any other cutter's corner moves outward.
double radiusShare(const geometry::Cutter& cutter, const Vector3& axis, const Vector3& normal) {
    const bool ball = cutter.corner_radius_mm >= 0.5 * cutter.diameter_mm - 1e-9;
    if (ball) return -(1.0 - axis.dot(normal));
    return -(normal - normal.dot(axis) * axis).norm();
}

}  // namespace

base::Result<std::vector<std::optional<ContactTrace>>>
traceContacts(const AxisTrack& track, const CutJob& job, const RealMachine& exact, std::span<const CmmTarget> targets) {
    std::vector<SampleSpan> spans;
    const auto path = realPath(track, exact, job.cutter(), job.part_from_wcs, 1e-4, &spans);
    const auto body = simulation::CutterBody::make(path.cutters.front());
    if (!body) return base::fail(body.error());
    std::vector<simulation::GridPoint> points(targets.size());
    for (std::size_t i = 0; i < targets.size(); ++i) {
        points[i].position = targets[i].position;
        points[i].normal = targets[i].normal;
    }
    const auto envelope = simulation::surfaceEnvelope(path, simulation::gridOfPoints(std::move(points)), within_band);
    if (!envelope) return base::fail(envelope.error());
    const geometry::RigidTransform wcs_from_part = job.part_from_wcs.inverse();
    std::vector<std::optional<ContactTrace>> out(targets.size());
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const auto& found = envelope->points[i];
        if (!found.reached()) continue;
        const Vector3 point = targets[i].position + found.deviation_mm * targets[i].normal;
        const double share = nearestShare(path.moves[found.move], *body, point);
        ContactTrace trace;
        axesAt(track, spans[found.move], exact, share, trace);
        trace.in_tool_mm = exact.wcsFromTool(trace.axes).inverse() * (wcs_from_part * point);
        trace.normal_wcs = wcs_from_part.linear() * targets[i].normal;
        trace.radius_share = radiusShare(job.cutter(), exact.place(trace.axes).axis, trace.normal_wcs);
        out[i] = trace;
    }
    return out;
}

double contactShift(const ContactTrace& contact, const RealMachine& real, const RealMachine& exact) {
    dynamics::AxisVector late = contact.axes;
    for (std::size_t a = 0; a < dynamics::max_axes; ++a) late.at(a) -= real.lag_s.at(a) * contact.rates_per_s.at(a);
    const Vector3 shift =
        real.wcsFromTool(late) * contact.in_tool_mm - exact.wcsFromTool(contact.axes) * contact.in_tool_mm;
    return contact.normal_wcs.dot(shift) + contact.radius_share * real.tool_radius_error_mm;
}

}  // namespace cusp::loop
