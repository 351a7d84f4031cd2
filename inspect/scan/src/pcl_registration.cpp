// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The adapter to PCL: the only file that includes it.
#include "pcl_registration.hpp"

#include <Eigen/Eigenvalues>

#include <cstdlib>
#include <pcl/features/fpfh.h>
#include <pcl/features/normal_3d.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/sample_consensus_prerejective.h>

namespace cusp::inspect {
namespace {

using geometry::Vector3;
using Cloud = pcl::PointCloud<pcl::PointNormal>;
using Features = pcl::PointCloud<pcl::FPFHSignature33>;

Cloud::Ptr cloudOf(const std::vector<Vector3>& points) {
    auto cloud = pcl::make_shared<Cloud>();
    for (const Vector3& p : points) {
        pcl::PointNormal point;
        point.getVector3fMap() = p.cast<float>();
        cloud->push_back(point);
    }
    return cloud;
}

Cloud::Ptr withoutOutliers(const Cloud::Ptr& cloud) {
    pcl::StatisticalOutlierRemoval<pcl::PointNormal> filter;
    constexpr int neighbours = 12;
    constexpr double deviations = 3.0;
    filter.setInputCloud(cloud);
    filter.setMeanK(neighbours);
    filter.setStddevMulThresh(deviations);
    auto out = pcl::make_shared<Cloud>();
    filter.filter(*out);
    return out;
}

Cloud::Ptr thinned(const Cloud::Ptr& cloud, float leaf) {
    pcl::VoxelGrid<pcl::PointNormal> grid;
    grid.setInputCloud(cloud);
    grid.setLeafSize(leaf, leaf, leaf);
    auto out = pcl::make_shared<Cloud>();
    grid.filter(*out);
    return out;
}

/// The direction in which the cloud is thinnest.
Eigen::Vector3f thinDirection(const Cloud& cloud) {
    Eigen::Matrix3f moments = Eigen::Matrix3f::Zero();
    for (const auto& p : cloud) moments += p.getVector3fMap() * p.getVector3fMap().transpose();
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f>(moments).eigenvectors().col(0);
}

/// Normals towards a viewpoint far off.
void estimateNormals(const Cloud::Ptr& cloud, float radius, const Eigen::Vector3f& viewpoint) {
    pcl::NormalEstimation<pcl::PointNormal, pcl::PointNormal> estimation;
    estimation.setInputCloud(cloud);
    estimation.setRadiusSearch(static_cast<double>(radius));
    estimation.setViewPoint(viewpoint.x(), viewpoint.y(), viewpoint.z());
    estimation.compute(*cloud);
    Cloud sound;
    for (const auto& p : *cloud)
        if (p.getNormalVector3fMap().allFinite()) sound.push_back(p);
    *cloud = sound;
}

Features::Ptr featuresOf(const Cloud::Ptr& cloud, float radius) {
    pcl::FPFHEstimation<pcl::PointNormal, pcl::PointNormal, pcl::FPFHSignature33> estimation;
    estimation.setInputCloud(cloud);
    estimation.setInputNormals(cloud);
    estimation.setRadiusSearch(static_cast<double>(radius));
    auto out = pcl::make_shared<Features>();
    estimation.compute(*out);
    return out;
}

struct Described {
    Cloud::Ptr cloud;
    Features::Ptr features;
};

std::optional<Eigen::Matrix4f> consensus(const Described& scan, const Described& surface, float leaf) {
    pcl::SampleConsensusPrerejective<pcl::PointNormal, pcl::PointNormal, pcl::FPFHSignature33> align;
    align.setInputSource(scan.cloud);
    align.setSourceFeatures(scan.features);
    align.setInputTarget(surface.cloud);
    align.setTargetFeatures(surface.features);
    align.setMaximumIterations(4000);
    align.setNumberOfSamples(3);
    align.setCorrespondenceRandomness(8);
    align.setSimilarityThreshold(0.85F);
    align.setMaxCorrespondenceDistance(static_cast<double>(2.0F * leaf));
    align.setInlierFraction(0.2F);
    Cloud moved;
    align.align(moved);
    if (!align.hasConverged()) return std::nullopt;
    return align.getFinalTransformation();
}

Eigen::Matrix4f refined(const Described& scan, const Described& surface, float leaf, const Eigen::Matrix4f& start) {
    pcl::IterativeClosestPoint<pcl::PointNormal, pcl::PointNormal> icp;
    icp.setInputSource(scan.cloud);
    icp.setInputTarget(surface.cloud);
    icp.setMaximumIterations(30);
    icp.setMaxCorrespondenceDistance(static_cast<double>(4.0F * leaf));
    Cloud moved;
    icp.align(moved, start);
    return icp.hasConverged() ? icp.getFinalTransformation() : start;
}

}  // namespace

ScanAnswer registerByFeatures(const ScanRequest& request) {
    // PCL draws its samples from std::rand.
    std::srand(1);
    ScanAnswer answer;
    const auto leaf = static_cast<float>(request.size_mm / 40.0);
    const Cloud::Ptr raw = cloudOf(request.scan);
    const Cloud::Ptr kept = withoutOutliers(raw);
    answer.outliers = raw->size() - kept->size();
    Described surface{cloudOf(request.surface), nullptr};
    for (std::size_t i = 0; i < request.normals.size(); ++i)
        (*surface.cloud)[i].getNormalVector3fMap() = request.normals[i].cast<float>();
    surface.cloud = thinned(surface.cloud, leaf);
    for (auto& p : *surface.cloud) p.getNormalVector3fMap().normalize();
    surface.features = featuresOf(surface.cloud, 6.0F * leaf);
    const Cloud::Ptr thin = thinned(kept, leaf);
    const Eigen::Vector3f away = 100.0F * static_cast<float>(request.size_mm) * thinDirection(*thin);
    for (const float side : {1.0F, -1.0F}) {
        Described scan{pcl::make_shared<Cloud>(*thin), nullptr};
        estimateNormals(scan.cloud, 3.0F * leaf, side * away);
        constexpr std::size_t fewest = 10;
        if (scan.cloud->size() < fewest || surface.cloud->size() < fewest) continue;
        scan.features = featuresOf(scan.cloud, 6.0F * leaf);
        const auto start = consensus(scan, surface, leaf);
        if (!start) continue;
        geometry::RigidTransform pose;
        pose.matrix() = refined(scan, surface, leaf, *start).cast<double>();
        answer.surface_from_scan.push_back(pose);
    }
    return answer;
}

}  // namespace cusp::inspect
