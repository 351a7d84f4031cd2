// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Reads and checks everything a simulation needs, before any of its work begins.
#include "simulate_input.hpp"

#include "console.hpp"
#include "input.hpp"
#include "program_moves.hpp"

#include <cusp/geometry/cad/nominal_file.hpp>
#include <cusp/geometry/mesh_shape.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <utility>

namespace cusp::cli {
namespace {

/// Of the chords that stand for arcs.
constexpr double chord_mm = 1e-3;

std::string endingOf(const std::string& file) {
    std::string ending = std::filesystem::path(file).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
    return ending;
}

/// Programs by the endings that Sinumerik uses.
bool isProgram(const std::string& file) {
    const std::string ending = endingOf(file);
    return ending == ".mpf" || ending == ".spf" || ending == ".nc";
}

base::Result<const toolpath::Tool*> toolOf(const SimulateFlags& flags, const toolpath::ToolLibrary& library) {
    if (flags.tool.empty()) return nullptr;
    const toolpath::Tool* found = library.findName(flags.tool);
    std::int64_t number = 0;
    const char* end = flags.tool.data() + flags.tool.size();
    if (found == nullptr && std::from_chars(flags.tool.data(), end, number).ptr == end)
        found = library.findNumber(number);
    if (found != nullptr) return found;
    std::string names;
    for (const toolpath::Tool& tool : library.tools) names += (names.empty() ? "" : ", ") + tool.name;
    return base::fail("simulate.tool", library.tools.empty() ? "--tool needs the library it is in: --tool-library FILE"
                                                             : fmt::format("{} has no tool \"{}\"; it has {}",
                                                                           flags.tool_library, flags.tool, names));
}

base::Result<simulation::CutterPath> readClMoves(const SimulateFlags& flags, const toolpath::ToolLibrary& library,
                                                 const toolpath::Tool* tool) {
    auto input = ClInput::open(flags.file, clReaderOptions(flags.dialect, flags.units, flags.strict));
    if (!input) return base::fail(input.error());
    base::Diagnostics report;
    simulation::PathCollector collector(input->text().name(), chord_mm, report);
    collector.lookUpIn(library);
    if (tool != nullptr) collector.useTool(*tool);
    for (toolpath::ClRecord record; input->reader().next(record);) collector.take(record);
    base::Diagnostics all = input->reader().report();
    all.append(report);
    if (all.hasErrors()) return base::fail(std::move(all));
    tell(all);
    return collector.finish();
}

base::Result<std::vector<simulation::ProfileRing>> ringsOf(const std::vector<double>& numbers, const char* code,
                                                           const char* flag) {
    if (numbers.size() % 3 != 0)
        return base::fail(code,
                          fmt::format("a ring is three numbers, height, lower and upper diameter; {} got {} in all",
                                      flag, numbers.size()));
    std::vector<simulation::ProfileRing> out;
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) out.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    return out;
}

base::Result<RamShape> ramOf(const SimulateFlags& flags, const std::optional<LoadedMachine>& machine) {
    RamShape ram{flags.pivot_mm, {}, flags.clearance_mm};
    auto rings = ringsOf(flags.ram_mm, "simulate.ram", "--ram-mm");
    if (!rings) return base::fail(rings.error());
    ram.rings = *std::move(rings);
    if (ram.rings.empty()) return ram;
    if (!(flags.pivot_mm >= 0.0))
        return base::fail(
            "simulate.ram",
            fmt::format("--pivot-mm is {} mm; the swivel's axis lies above the gauge plane", flags.pivot_mm));
    if (!machine) return ram;
    for (const std::string& axis : machine->model.rotaryNames())
        if (machine->file.machine.carriesWorkpiece(axis))
            return base::fail("simulate.ram",
                              fmt::format("{} turns the workpiece with {}: its ram does not keep its direction in the "
                                          "part. Where nothing swivels on the tool's side, the ram goes with the tool: "
                                          "give it with --head-mm",
                                          machine->file.machine.name, axis));
    return ram;
}

base::Result<std::vector<simulation::ToolAssembly>> assembliesOf(const SimulateFlags& flags,
                                                                 const simulation::CutterPath& path) {
    const auto head = ringsOf(flags.head_mm, "simulate.head", "--head-mm");
    if (!head) return base::fail(head.error());
    std::vector<simulation::ToolAssembly> out;
    for (std::size_t i = 0; i < path.cutters.size(); ++i) {
        auto assembly = path.tools[i] != nullptr ? simulation::assemblyOf(*path.tools[i], flags.clearance_mm, *head)
                                                 : simulation::assemblyOf(path.cutters[i]);
        if (!assembly) return base::fail(assembly.error());
        out.push_back(*std::move(assembly));
    }
    return out;
}

/// The room does not know the file its complaint is about.
base::Result<simulation::Stock> failAt(const base::Diagnostics& report, const std::string& file) {
    base::Diagnostics out;
    for (const base::Diagnostic& one : report) out.error(one.code, one.message, {file, {}, {}, {}});
    return base::fail(std::move(out));
}

base::Result<simulation::Stock> stockOf(const SimulateFlags& flags) {
    const simulation::StockOptions options{flags.resolution_mm,
                                           static_cast<std::uint64_t>(flags.memory_mb * 1024.0 * 1024.0)};
    if (flags.stock.empty() == flags.stock_box_mm.empty())
        return base::fail("simulate.stock",
                          "the stock is needed, once: --stock FILE, or --stock-box-mm with two corners");
    if (flags.stock.empty()) {
        const auto& b = flags.stock_box_mm;
        return simulation::Stock::box({geometry::Vector3(b[0], b[1], b[2]), geometry::Vector3(b[3], b[4], b[5])},
                                      options);
    }
    base::Diagnostics report;
    auto shape = geometry::loadNominal(flags.stock, report);
    if (!shape) return base::fail(shape.error());
    tell(report);
    if (const auto* mesh = dynamic_cast<const geometry::MeshShape*>(shape->get())) {
        auto stock = simulation::Stock::mesh(mesh->mesh(), options);
        if (!stock) return failAt(stock.error(), flags.stock);
        return stock;
    }
    auto solid = simulation::Stock::solid(**shape, options);
    if (!solid) return failAt(solid.error(), flags.stock);
    return solid;
}

base::Result<void> loadShapes(const SimulateFlags& flags, SimulateInput& input) {
    base::Diagnostics report;
    if (!flags.nominal.empty()) {
        auto nominal = geometry::loadNominal(flags.nominal, report);
        if (!nominal) return base::fail(nominal.error());
        input.nominal = *std::move(nominal);
    }
    for (const auto& [kind, files] : {std::pair("fixture", &flags.fixtures), std::pair("table", &flags.tables)})
        for (const std::string& file : *files) {
            auto shape = geometry::loadNominal(file, report);
            if (!shape) return base::fail(shape.error());
            input.obstacles.push_back({kind, file, *std::move(shape)});
        }
    tell(report);
    return {};
}

/// A path that never comes near the stock is in another frame, or another unit.
base::Result<void> checkReach(const SimulateInput& input, const std::string& file) {
    const Eigen::AlignedBox3d& box = input.stock->lattice().box;
    Eigen::AlignedBox3d way;
    bool meets = false;
    for (const simulation::ToolMove& move : input.path.moves) {
        way.extend(move.from.tip_mm);
        way.extend(move.to.tip_mm);
        const simulation::CutterBody& cutter = input.assemblies[move.cutter].bodies.front().body;
        // A turning tool bulges beyond its ends by less than what the turn takes from its height.
        const double bulge =
            cutter.height() * (1.0 - std::cos(0.5 * geometry::angleBetween(move.from.axis, move.to.axis)));
        Eigen::AlignedBox3d swept;
        for (const toolpath::CutterLocation& at : {move.from, move.to}) {
            const geometry::Vector3 disc =
                cutter.largestRadius() * (geometry::Vector3::Ones() - at.axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
            for (const double height : {0.0, cutter.height()})
                for (const double side : {-1.0, 1.0}) {
                    const geometry::Vector3 rim = disc + geometry::Vector3::Constant(bulge);
                    swept.extend(geometry::Vector3(at.tip_mm + height * at.axis + side * rim));
                }
        }
        meets = meets || swept.intersects(box);
    }
    if (meets) return {};
    return base::fail(
        "simulate.outside",
        fmt::format(
            "the path never reaches the stock: its tip runs from X{:.3f} Y{:.3f} Z{:.3f} to X{:.3f} Y{:.3f} "
            "Z{:.3f}, the stock lies from X{:.3f} Y{:.3f} Z{:.3f} to X{:.3f} Y{:.3f} Z{:.3f}; another frame, or "
            "another unit?",
            way.min().x(), way.min().y(), way.min().z(), way.max().x(), way.max().y(), way.max().z(), box.min().x(),
            box.min().y(), box.min().z(), box.max().x(), box.max().y(), box.max().z()),
        {file, {}, {}, {}});
}

}  // namespace

base::Result<std::unique_ptr<SimulateInput>> readSimulateInput(const SimulateFlags& flags) {
    auto input = std::make_unique<SimulateInput>();
    input->is_program = isProgram(flags.file);
    if (!flags.tool_library.empty()) {
        auto library = toolpath::readToolLibraryFile(flags.tool_library);
        if (!library) return base::fail(library.error());
        input->library = *std::move(library);
    }
    const auto tool = toolOf(flags, input->library);
    if (!tool) return base::fail(tool.error());
    if (!flags.machine.empty()) {
        auto machine = loadMachine(flags.machine);
        if (!machine) return base::fail(machine.error());
        input->machine.emplace(*std::move(machine));
    }
    if (input->is_program && !input->machine)
        return base::fail("simulate.machine", "a program is read by the machine it is for: give it with -m");
    auto path = input->is_program ? readProgramMoves(flags.file, *input->machine, input->library, *tool, chord_mm)
                                  : readClMoves(flags, input->library, *tool);
    if (!path) return base::fail(path.error());
    input->path = *std::move(path);
    if (input->path.moves.empty())
        return base::fail("simulation.no-moves", "the path has no moves of a tool whose shape is known",
                          {flags.file, {}, {}, {}});
    auto assemblies = assembliesOf(flags, input->path);
    if (!assemblies) return base::fail(assemblies.error());
    input->assemblies = *std::move(assemblies);
    auto ram = ramOf(flags, input->machine);
    if (!ram) return base::fail(ram.error());
    input->ram = *std::move(ram);
    auto stock = stockOf(flags);
    if (!stock) return base::fail(stock.error());
    input->stock = *std::move(stock);
    if (const auto ok = checkReach(*input, flags.file); !ok) return base::fail(ok.error());
    if (const auto ok = loadShapes(flags, *input); !ok) return base::fail(ok.error());
    return input;
}

}  // namespace cusp::cli
