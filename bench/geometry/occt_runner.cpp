// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The only file of the benchmark that sees OCCT.
#include "occt_runner.hpp"

#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include <vector>

namespace cusp::bench {
namespace {

struct Knots {
    std::vector<double> values;
    std::vector<int> multiplicities;

    explicit Knots(const std::vector<double>& flat) {
        for (const double knot : flat) {
            if (values.empty() || knot != values.back()) {
                values.push_back(knot);
                multiplicities.push_back(0);
            }
            ++multiplicities.back();
        }
    }
};

Handle(Geom_BSplineSurface) surfaceOf(const geometry::BSplineForm& form) {
    const int rows = static_cast<int>(form.points.size());
    const int columns = static_cast<int>(form.points.front().size());
    TColgp_Array2OfPnt poles(1, rows, 1, columns);
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const geometry::Vector3& p = form.points[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
            poles.SetValue(i + 1, j + 1, gp_Pnt(p.x(), p.y(), p.z()));
        }
    }
    const Knots u(form.knots_u);
    const Knots v(form.knots_v);
    const auto count = [](const Knots& knots) { return static_cast<int>(knots.values.size()); };
    return new Geom_BSplineSurface(
        poles, TColStd_Array1OfReal(u.values.front(), 1, count(u)), TColStd_Array1OfReal(v.values.front(), 1, count(v)),
        TColStd_Array1OfInteger(u.multiplicities.front(), 1, count(u)),
        TColStd_Array1OfInteger(v.multiplicities.front(), 1, count(v)), form.degree_u, form.degree_v);
}

}  // namespace

struct OcctRunner::Surface {
    GeomAPI_ProjectPointOnSurf projection;
};

OcctRunner::OcctRunner(const geometry::BSplineForm& form) : surface_(std::make_unique<Surface>()) {
    const Handle(Geom_BSplineSurface) made = surfaceOf(form);
    double low_u = 0.0;
    double high_u = 0.0;
    double low_v = 0.0;
    double high_v = 0.0;
    made->Bounds(low_u, high_u, low_v, high_v);
    surface_->projection.Init(made, low_u, high_u, low_v, high_v, Extrema_ExtAlgo_Tree);
}

OcctRunner::~OcctRunner() = default;

double OcctRunner::distance(const geometry::Vector3& query) {
    surface_->projection.Perform(gp_Pnt(query.x(), query.y(), query.z()));
    return surface_->projection.NbPoints() > 0 ? surface_->projection.LowerDistance() : -1.0;
}

}  // namespace cusp::bench
