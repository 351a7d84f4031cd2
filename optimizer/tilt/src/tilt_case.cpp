// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Makes a job ready and judges tilted paths: coarse first, fine where it matters.
#include <cusp/optimizer/tilt/tilt_case.hpp>

#include "clearance_probe.hpp"

#include <cusp/geometry/mesh_file.hpp>
#include <cusp/geometry/mesh_shape.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

namespace cusp::tilt {

using geometry::Vector3;
using simulation::CollisionField;
using simulation::ToolMove;
using toolpath::CutterLocation;

namespace {

std::string inFolder(const std::string& folder, const std::string& file) {
    const std::filesystem::path path(file);
    return path.is_absolute() || folder.empty() ? file : (std::filesystem::path(folder) / path).string();
}

bool isMeshFile(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending == ".stl" || ending == ".ply";
}

base::Result<std::unique_ptr<geometry::NominalShape>> shapeOf(const PartShape& part, const std::string& folder,
                                                              const ShapeLoader& loader, base::Diagnostics& report) {
    if (!part.file) return std::make_unique<geometry::MeshShape>(partMesh(part));
    const std::string path = inFolder(folder, *part.file);
    if (!isMeshFile(path)) {
        if (loader) return loader(path, report);
        return base::fail("tilt.part-format", "the part must be a mesh (STL or PLY)", {path, 0, 0, {}});
    }
    auto mesh = geometry::readMeshFile(path, report);
    if (!mesh) return base::fail(mesh.error());
    if (!geometry::checkEdges(*mesh).isClosed())
        return base::fail("tilt.open-mesh", "the mesh of the part does not close a volume: what is inside is not known",
                          {path, 0, 0, {}});
    return std::make_unique<geometry::MeshShape>(*std::move(mesh));
}

base::Result<StartPath> startOf(const TiltJob& job, const geometry::NominalShape& shape, const std::string& folder,
                                base::Diagnostics& report) {
    const StartOptions options{.cutter = job.tool.cutter(), .longest_cut_mm = job.longest_cut_mm};
    if (job.cl_file) {
        const std::string path = inFolder(folder, *job.cl_file);
        const auto file = toolpath::readToolPathFile(path, {}, report);
        if (!file) return base::fail(file.error());
        return startPath(file->records, path, options);
    }
    const auto plan = [&](const DropShape& drop) -> base::Result<StartPath> {
        const auto planned = planThreeAxis(drop, *job.path);
        if (!planned) return base::fail(planned.error());
        const toolpath::ToolCall tool{job.tool.number, job.tool.name, job.tool.cutter()};
        return startPath(clRecords(*planned, *job.path, job.name, tool), job.name, options);
    };
    if (const auto* mesh = dynamic_cast<const geometry::MeshShape*>(&shape)) {
        const auto drop = MeshDrop::make(mesh->mesh(), job.tool.cutter());
        if (!drop) return base::fail(drop.error());
        return plan(*drop);
    }
    const auto drop = BallDrop::make(shape, job.tool.cutter());
    if (!drop) return base::fail(drop.error());
    return plan(*drop);
}

std::vector<ToolMove> movesOf(const StartPath& path, const std::vector<CutterLocation>& poses) {
    std::vector<ToolMove> moves;
    moves.reserve(poses.size());
    for (std::size_t i = 1; i < poses.size(); ++i)
        moves.push_back({poses[i - 1], poses[i], path.locations[i].kind, path.locations[i].line, 0});
    return moves;
}

}  // namespace

TiltCase::TiltCase(TiltJob job, const kinematics::Machine& machine)
    : job_(std::move(job)), place_{&machine, job_.tool.lengthMm(), geometry::toVector(job_.origin_mm)} {}
TiltCase::~TiltCase() = default;

base::Result<std::unique_ptr<TiltCase>> TiltCase::make(const TiltJob& job, const kinematics::Machine& machine,
                                                       const std::string& folder, base::Diagnostics& report,
                                                       const ShapeLoader& loader) {
    std::unique_ptr<TiltCase> out(new TiltCase(job, machine));
    if (const auto sound = job.tool.assembly(job.tool.stickOutMm()); !sound) return base::fail(sound.error());
    auto shape = shapeOf(job.part, folder, loader, report);
    if (!shape) return base::fail(shape.error());
    out->shape_ = *std::move(shape);
    auto path = startOf(job, *out->shape_, folder, report);
    if (!path) return base::fail(path.error());
    out->path_ = *std::move(path);
    out->coarse_path_ = out->path_.coarse(2.0 * job.search.coarse_mm);
    out->sparse_path_ = out->path_.coarse(8.0 * job.search.coarse_mm);
    out->probe_ = std::make_unique<const detail::ClearanceProbe>(*out->shape_, job.tool, job.tool.stickOutMm(),
                                                                 job.search.coarse_mm);
    return out;
}

base::Result<CollisionField> TiltCase::fieldOf(double resolution_mm) const {
    simulation::StockOptions options;
    options.resolution_mm = resolution_mm;
    const auto* mesh = dynamic_cast<const geometry::MeshShape*>(shape_.get());
    auto stock = mesh ? simulation::Stock::mesh(mesh->mesh(), options)
                      : simulation::Stock::shape(*shape_, shape_->bounds(), options);
    if (!stock) return base::fail(stock.error());
    return CollisionField(*std::move(stock));
}

TiltFitness TiltCase::judge(const TiltPlan& plan) const {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    using Look = detail::ClearanceProbe::Look;
    std::vector<CutterLocation> poses = tilted(sparse_path_, plan);
    TiltFitness fitness{rotaryExcess(*place_.machine, poses), infinite, infinite};
    if (fitness.range_excess > 0.0) return fitness;
    fitness.collision_volume_mm3 = probe_->overlap(poses, Look::Sure);
    if (fitness.collision_volume_mm3 > 0.0) return fitness;
    poses = tilted(coarse_path_, plan);
    const AxisMotion motion = axisMotion(place_, coarse_path_, poses);
    fitness = {motion.range_excess, infinite, motion.harmony_s};
    if (fitness.range_excess > 0.0) return fitness;
    fitness.collision_volume_mm3 = probe_->overlap(poses, Look::Exact);
    // Of a long path the second look is all a search can afford; what it leaves open, the proof of the winner answers.
    constexpr std::size_t long_path = 20'000;
    const std::size_t locations = path_.locations.size();
    if (fitness.collision_volume_mm3 > 0.0 || coarse_path_.locations.size() == locations || locations > long_path)
        return fitness;
    poses = tilted(path_, plan);
    fitness.collision_volume_mm3 = probe_->overlap(poses, Look::Exact);
    if (fitness.collision_volume_mm3 > 0.0) return fitness;
    // Between the few locations of the second look an axis may have gone beyond its end. Harmony stays that of the second
    // look, so that all candidates are compared by the same measure.
    fitness.range_excess = axisMotion(place_, path_, poses).range_excess;
    return fitness;
}

base::Result<simulation::CollisionVolume> TiltCase::collisions(const std::vector<CutterLocation>& poses,
                                                               double resolution_mm, double stick_out_mm) const {
    return collisions(movesOf(path_, poses), resolution_mm, stick_out_mm);
}

base::Result<simulation::CollisionVolume> TiltCase::collisions(std::span<const ToolMove> moves, double resolution_mm,
                                                               double stick_out_mm) const {
    const auto field = fieldOf(resolution_mm);
    if (!field) return base::fail(field.error());
    const auto assembly = job_.tool.assembly(stick_out_mm);
    if (!assembly) return base::fail(assembly.error());
    return field->measure(moves, std::vector{*assembly});
}

std::optional<double> TiltCase::shortestStickOut(const std::vector<CutterLocation>& poses, double step_mm) const {
    std::optional<double> shortest;
    for (double stick_out = job_.tool.stickOutMm(); stick_out > job_.tool.cutting_height_mm; stick_out -= step_mm) {
        if (detail::ClearanceProbe(*probe_, job_.tool, stick_out).overlap(poses, detail::ClearanceProbe::Look::Exact) >
            0.0)
            break;
        shortest = stick_out;
    }
    return shortest;
}

}  // namespace cusp::tilt
