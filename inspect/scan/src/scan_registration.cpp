// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Thins, asks cusp-scan, and tries its proposals against the nominal.
#include <cusp/inspect/scan/scan_registration.hpp>

#include "scan_exchange.hpp"

#include <cusp/base/child_process.hpp>

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cusp::inspect {
namespace {

constexpr std::size_t scan_sample = 40'000;
constexpr std::size_t surface_sample = 4'000;

Vector3 middleOf(const std::vector<Vector3>& points) {
    Vector3 sum = Vector3::Zero();
    for (const Vector3& p : points) sum += (p - points.front()) / static_cast<double>(points.size());
    return points.front() + sum;
}

void shift(std::vector<Vector3>& points, const Vector3& by) {
    for (Vector3& p : points) p += by;
}

/// PCL's rotations are orthogonal to single precision only.
RigidTransform orthogonal(const RigidTransform& pose) {
    const Eigen::JacobiSVD<geometry::Matrix3> svd(pose.linear(), Eigen::ComputeFullU | Eigen::ComputeFullV);
    RigidTransform out = pose;
    out.linear() = svd.matrixU() * svd.matrixV().transpose();
    return out;
}

base::Result<ScanAnswer> ask(const ScanRequest& request, const ScanOptions& options) {
    const auto outcome = base::runProcess({options.program}, {.wall_s = options.wall_s}, encode(request));
    if (!outcome)
        return base::fail("scan.program",
                          "cusp-scan, which registers scans, cannot be started: " + outcome.error().front().message);
    if (!outcome->succeeded())
        return base::fail("scan.program", "the registration of the scan failed: " + base::outcomeText(*outcome));
    const auto answer = decodeAnswer(outcome->output);
    if (!answer) return base::fail("scan.answer", "cusp-scan gave an answer that is none; is it of another version?");
    return *answer;
}

}  // namespace

base::Result<ScanStart> findScanStart(std::span<const Vector3> points, const geometry::NominalShape& nominal,
                                      const ScanOptions& options) {
    if (points.empty()) return base::fail("align.too-few-points", "there are no points");
    ScanRequest request;
    request.size_mm = nominal.bounds().diagonal().norm();
    const std::size_t count = std::min(points.size(), scan_sample);
    for (std::size_t i = 0; i < count; ++i) request.scan.push_back(points[i * points.size() / count]);
    for (const geometry::Footpoint& foot : sampleNominal(nominal, surface_sample)) {
        request.surface.emplace_back(foot.position + options.offset_mm * foot.normal);
        request.normals.push_back(foot.normal);
    }
    ScanStart out;
    out.sampled = count;
    PoseSearchOptions search;
    search.offset_mm = options.offset_mm;
    if (!request.surface.empty()) {
        const Vector3 scan_middle = middleOf(request.scan);
        const Vector3 surface_middle = middleOf(request.surface);
        shift(request.scan, -scan_middle);
        shift(request.surface, -surface_middle);
        const auto answer = ask(request, options);
        if (!answer) return base::fail(answer.error());
        out.outliers = answer->outliers;
        for (const RigidTransform& pose : answer->surface_from_scan)
            search.candidates.push_back(Eigen::Translation3d(surface_middle) * orthogonal(pose) *
                                        Eigen::Translation3d(-scan_middle));
    }
    out.candidates = search.candidates.size();
    const FoundPose found = searchPose(points, nominal, search);
    out.nominal_from_measured = found.nominal_from_measured;
    out.rms_mm = found.rms_mm;
    out.from_features = found.from_candidate;
    return out;
}

}  // namespace cusp::inspect
