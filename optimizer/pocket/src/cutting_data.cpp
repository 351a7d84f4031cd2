// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Catalogue tables read, loads computed.
#include <cusp/optimizer/pocket/cutting_data.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cusp::pocket {
namespace {

const base::Section<MaterialData>& materialSection() {
    static const auto section =
        base::Section<MaterialData>("A material.")
            .field("number", &MaterialData::number, "What a job calls it.", base::required())
            .field("name", &MaterialData::name, "What it is.")
            .field("vc_m_per_min", &MaterialData::vc_mm_per_s, "Cutting speed, least and most.", base::required())
            .field("fz_min_mm", &MaterialData::fz_min_mm, "Least feed per tooth, one for each span of diameters.",
                   base::required())
            .field("fz_max_mm", &MaterialData::fz_max_mm, "Most.", base::required())
            .field("kc_n_per_mm2", &MaterialData::kc_n_per_mm2, "Specific cutting force.", base::positive());
    return section;
}

void check(const CuttingTable& table, const std::string& path, base::Diagnostics& report) {
    const base::Location where{.file = path, .line = 0, .column = 0, .key = "diameters_mm"};
    if (table.diameters_mm.size() < 2 || !std::is_sorted(table.diameters_mm.begin(), table.diameters_mm.end()))
        report.error("pocket.table", "the ends of the spans must be at least two and ascend", where);
    for (const MaterialData& m : table.materials) {
        const base::Location at{.file = path, .line = 0, .column = 0, .key = "material." + m.number};
        if (m.fz_min_mm.size() + 1 != table.diameters_mm.size() || m.fz_max_mm.size() != m.fz_min_mm.size()) {
            report.error("pocket.table",
                         fmt::format("{} and {} feeds for {} spans of diameters", m.fz_min_mm.size(),
                                     m.fz_max_mm.size(), table.diameters_mm.size() - 1),
                         at);
            continue;
        }
        for (std::size_t i = 0; i < m.fz_min_mm.size(); ++i)
            if (!(m.fz_min_mm[i] > 0.0) || m.fz_min_mm[i] > m.fz_max_mm[i])
                report.error("pocket.table",
                             fmt::format("feed per tooth {} to {} mm is no range; the least comes first and is above 0",
                                         m.fz_min_mm[i], m.fz_max_mm[i]),
                             at);
        if (!(m.vc_mm_per_s[0] > 0.0) || m.vc_mm_per_s[0] > m.vc_mm_per_s[1])
            report.error("pocket.table",
                         fmt::format("cutting speed {} to {} m/min is no range; the least comes first and is above 0",
                                     m.vc_mm_per_s[0] * 0.06, m.vc_mm_per_s[1] * 0.06),
                         at);
    }
}

}  // namespace

const base::Section<CuttingTable>& cuttingTableSection() {
    static const auto section = base::Section<CuttingTable>("Cutting data of a catalogue.")
                                    .field("diameters_mm", &CuttingTable::diameters_mm,
                                           "Ends of the spans of diameters, ascending.", base::required())
                                    .tables("material", &CuttingTable::materials, materialSection());
    return section;
}

base::Result<CuttingTable> readCuttingTableFile(const std::string& path) {
    const auto document = base::TomlDocument::readFile(path);
    if (!document) return base::fail(document.error());
    base::Diagnostics report;
    CuttingTable table = cuttingTableSection().read(document->root(), report);
    if (!report.hasErrors()) check(table, path, report);
    if (report.hasErrors()) return base::fail(std::move(report));
    return table;
}

base::Result<CuttingRange> rangeFor(const CuttingTable& table, const std::string& material, double diameter_mm) {
    std::string numbers;
    for (const MaterialData& m : table.materials) {
        numbers += (numbers.empty() ? "" : ", ") + m.number;
        if (m.number != material) continue;
        if (diameter_mm < table.diameters_mm.front() || diameter_mm > table.diameters_mm.back())
            return base::fail("pocket.diameter",
                              fmt::format("the table has tools from {} to {} mm, not {} mm", table.diameters_mm.front(),
                                          table.diameters_mm.back(), diameter_mm));
        std::size_t span = 0;
        while (span + 2 < table.diameters_mm.size() && diameter_mm > table.diameters_mm[span + 1]) ++span;
        CuttingRange out;
        out.fz_mm = {m.fz_min_mm[span], m.fz_max_mm[span]};
        for (std::size_t i = 0; i < 2; ++i)
            out.spindle_rpm[i] = m.vc_mm_per_s[i] * 60.0 / (std::numbers::pi * diameter_mm);
        out.kc_n_per_mm2 = m.kc_n_per_mm2;
        return out;
    }
    return base::fail("pocket.no-such-material",
                      fmt::format("the table has no material \"{}\"; it has {}", material, numbers));
}

CuttingLoad loadOf(const CuttingData& data, const CutterLimits& limits, double kc_n_per_mm2) {
    CuttingLoad out;
    out.feed_mm_per_min = data.fz_mm * limits.teeth * data.spindle_rpm;
    out.mrr_mm3_per_min = out.feed_mm_per_min * data.ap_mm * data.ae_mm;
    out.power_kw = out.mrr_mm3_per_min * kc_n_per_mm2 / (60e6 * limits.efficiency);
    const double angle = std::acos(std::clamp(1.0 - 2.0 * data.ae_mm / limits.diameter_mm, -1.0, 1.0));
    out.engagement_deg = angle * 180.0 / std::numbers::pi;
    const double chip_mm = data.fz_mm * (angle < std::numbers::pi / 2.0 ? std::sin(angle) : 1.0);
    const double teeth_in = std::max(1.0, limits.teeth * angle / (2.0 * std::numbers::pi));
    out.force_n = kc_n_per_mm2 * data.ap_mm * chip_mm * teeth_in;
    // A cantilever of 0.8 D, loaded at half the depth of cut.
    const double d = 0.8 * limits.diameter_mm;
    const double arm_mm = std::max(limits.overhang_mm - data.ap_mm / 2.0, 0.0);
    out.bending_n_per_mm2 = 32.0 * out.force_n * arm_mm / (std::numbers::pi * d * d * d);
    const double inertia_mm4 = std::numbers::pi * d * d * d * d / 64.0;
    out.deflection_mm = out.force_n * arm_mm * arm_mm * arm_mm / (3.0 * limits.modulus_n_per_mm2 * inertia_mm4);
    return out;
}

std::string infeasibility(const CuttingData& data, const CutterLimits& limits, double kc_n_per_mm2) {
    const CuttingLoad load = loadOf(data, limits, kc_n_per_mm2);
    const auto above = [](const char* what, double value, double limit, const char* unit) {
        return fmt::format("{} {:.3g} {} above {:.3g} {}", what, value, unit, limit, unit);
    };
    if (data.spindle_rpm > limits.max_spindle_rpm)
        return above("spindle speed", data.spindle_rpm, limits.max_spindle_rpm, "rpm");
    if (load.power_kw > limits.spindle_power_kw) return above("power", load.power_kw, limits.spindle_power_kw, "kW");
    if (load.bending_n_per_mm2 > limits.bending_n_per_mm2)
        return above("bending stress", load.bending_n_per_mm2, limits.bending_n_per_mm2, "N/mm2");
    if (load.deflection_mm > limits.deflection_mm)
        return above("deflection", load.deflection_mm, limits.deflection_mm, "mm");
    if (load.engagement_deg > limits.engagement_deg)
        return above("engagement of a straight cut", load.engagement_deg, limits.engagement_deg, "deg");
    return {};
}

}  // namespace cusp::pocket
