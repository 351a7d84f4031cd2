// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// BRepBuilderAPI_NurbsConvert makes B-splines of planes, quadrics and swept surfaces, exactly, and of the curves on them.
#include "brep_to_model.hpp"

#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dConvert.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

namespace cusp::geometry::cad {
namespace {

// By index: the iterators of this array are made of one that C++17 deprecates.
std::vector<double> flatKnots(const TColStd_Array1OfReal& flat) {
    std::vector<double> knots;
    knots.reserve(static_cast<std::size_t>(flat.Length()));
    for (int i = flat.Lower(); i <= flat.Upper(); ++i) knots.push_back(flat(i));
    return knots;
}

BSplineForm surfaceForm(const Handle(Geom_BSplineSurface) & surface) {
    surface->SetUNotPeriodic();
    surface->SetVNotPeriodic();
    BSplineForm form;
    form.degree_u = surface->UDegree();
    form.degree_v = surface->VDegree();
    form.knots_u = flatKnots(surface->UKnotSequence());
    form.knots_v = flatKnots(surface->VKnotSequence());
    const bool rational = surface->IsURational() || surface->IsVRational();
    for (int i = 1; i <= surface->NbUPoles(); ++i) {
        form.points.emplace_back();
        if (rational) form.weights.emplace_back();
        for (int j = 1; j <= surface->NbVPoles(); ++j) {
            const gp_Pnt p = surface->Pole(i, j);
            form.points.back().emplace_back(p.X(), p.Y(), p.Z());
            if (rational) form.weights.back().push_back(surface->Weight(i, j));
        }
    }
    return form;
}

BSplineCurveForm spaceForm(const Handle(Geom_BSplineCurve) & curve) {
    curve->SetNotPeriodic();
    BSplineCurveForm form;
    form.degree = curve->Degree();
    form.knots = flatKnots(curve->KnotSequence());
    for (int i = 1; i <= curve->NbPoles(); ++i) {
        const gp_Pnt p = curve->Pole(i);
        form.points.emplace_back(p.X(), p.Y(), p.Z());
        form.weights.push_back(curve->Weight(i));
    }
    return form;
}

BSplineCurveForm parameterForm(const Handle(Geom2d_BSplineCurve) & curve) {
    curve->SetNotPeriodic();
    BSplineCurveForm form;
    form.degree = curve->Degree();
    form.knots = flatKnots(curve->KnotSequence());
    for (int i = 1; i <= curve->NbPoles(); ++i) {
        const gp_Pnt2d p = curve->Pole(i);
        form.points.emplace_back(p.X(), p.Y(), 0.0);
        form.weights.push_back(curve->Weight(i));
    }
    return form;
}

StreamedEdge edgeOf(const TopoDS_Edge& edge) {
    StreamedEdge out;
    double first = 0.0;
    double last = 0.0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
    out.is_point = BRep_Tool::Degenerated(edge) || curve.IsNull();
    if (!out.is_point) {
        out.curve = spaceForm(GeomConvert::CurveToBSplineCurve(new Geom_TrimmedCurve(curve, first, last)));
    }
    return out;
}

void addUse(const TopoDS_Edge& edge, const TopoDS_Face& face, std::size_t index, StreamedEdge& out) {
    double first = 0.0;
    double last = 0.0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
    if (curve.IsNull()) throw Standard_Failure("an edge has no curve on its face");
    out.uses.push_back(
        {index, parameterForm(Geom2dConvert::CurveToBSplineCurve(new Geom2d_TrimmedCurve(curve, first, last)))});
}

}  // namespace

CadModel modelOf(const TopoDS_Shape& shape) {
    CadModel model;
    TopExp_Explorer any_face(shape, TopAbs_FACE);
    if (!any_face.More()) return model;
    const TopoDS_Shape splines = BRepBuilderAPI_NurbsConvert(shape, true).Shape();
    TopTools_IndexedMapOfShape edges;
    TopExp::MapShapes(splines, TopAbs_EDGE, edges);
    for (int i = 1; i <= edges.Extent(); ++i) model.edges.push_back(edgeOf(TopoDS::Edge(edges(i))));
    for (TopExp_Explorer at(splines, TopAbs_FACE); at.More(); at.Next()) {
        const TopoDS_Face face = TopoDS::Face(at.Current());
        const std::size_t index = model.faces.size();
        const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
        model.faces.push_back(
            {surfaceForm(GeomConvert::SurfaceToBSplineSurface(surface)), face.Orientation() == TopAbs_REVERSED});
        for (TopExp_Explorer side(face, TopAbs_EDGE); side.More(); side.Next()) {
            const TopoDS_Edge edge = TopoDS::Edge(side.Current());
            addUse(edge, face, index, model.edges[static_cast<std::size_t>(edges.FindIndex(edge)) - 1]);
        }
    }
    return model;
}

}  // namespace cusp::geometry::cad
