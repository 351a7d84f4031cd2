// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Material, allowed places and reach from contours.
#include <cusp/optimizer/pocket/pocket_area.hpp>

#include <fmt/format.h>

namespace cusp::pocket {
namespace {

/// Polygons as one region, whether they overlap or not.
Region all(const std::vector<Polygon>& polygons) {
    Region out;
    for (const Polygon& polygon : polygons) out = unite(out, {polygon});
    return out;
}

/// Where the middle of a tool may be.
Region allowedFor(const Region& stock, const Region& keep, double radius_mm) {
    Box box = boxOf(stock);
    const double margin = 4.0 * radius_mm + 1.0;
    box.low = {box.low.x_mm - margin, box.low.y_mm - margin};
    box.high = {box.high.x_mm + margin, box.high.y_mm + margin};
    return subtract({rectangle(box)}, offset(keep, radius_mm));
}

bool reaches(const Region& stock, const Region& keep, const Region& material, double radius_mm) {
    return areaOf(intersect(offset(allowedFor(stock, keep, radius_mm), radius_mm), material)) > 1e-3;
}

}  // namespace

base::Result<PocketArea> areaFor(const PocketContours& contours, double tool_diameter_mm, double allowance_mm) {
    PocketArea out;
    out.stock = all(contours.stock);
    out.radius_mm = tool_diameter_mm / 2.0;
    if (out.stock.empty()) return base::fail("pocket.no-stock", "there is no stock; give a contour of kind \"stock\"");
    const Region pocket = contours.pockets.empty() ? out.stock : all(contours.pockets);
    Region keep = unite(subtract(out.stock, pocket), all(contours.islands));
    if (allowance_mm > 0.0) keep = offset(keep, allowance_mm);
    out.material = subtract(out.stock, keep);
    const double area = areaOf(out.material);
    if (area < 1e-3)
        return base::fail(
            "pocket.no-material",
            "nothing is to be removed: the islands cover the pocket, or the pocket lies outside the stock");
    if (!reaches(out.stock, keep, out.material, out.radius_mm)) {
        double low = 0.0;
        double high = out.radius_mm;
        for (int i = 0; i < 30; ++i)
            (reaches(out.stock, keep, out.material, (low + high) / 2.0) ? low : high) = (low + high) / 2.0;
        return base::fail(
            "pocket.tool-too-large",
            fmt::format("a tool of {:.3f} mm fits into no gap of the contour with an allowance of {:.3f} mm; the "
                        "widest takes {:.2f} mm",
                        tool_diameter_mm, allowance_mm, 2.0 * low));
    }
    out.allowed = allowedFor(out.stock, keep, out.radius_mm);
    out.coverable = intersect(offset(out.allowed, out.radius_mm), out.material);
    out.unreachable_area_mm2 = area - areaOf(out.coverable);
    return out;
}

}  // namespace cusp::pocket
