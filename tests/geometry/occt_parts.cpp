// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The only test file that sees OCCT.
#include "occt_parts.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Circ.hxx>

#include <cmath>
#include <numbers>

namespace cusp::geometry::test {

struct OcctPart::Shape {
    TopoDS_Shape shape;
    TopoDS_Compound faces;  ///< a solid swallows what is inside it; its faces do not

    explicit Shape(const TopoDS_Shape& made) : shape(made) {
        BRep_Builder builder;
        builder.MakeCompound(faces);
        for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next()) builder.Add(faces, at.Current());
    }
};

namespace {

gp_Ax2 tilted() { return {gp_Pnt(5, -3, 2), gp_Dir(0.3, 0.2, 1.0), gp_Dir(1.0, 0.1, -0.32)}; }

}  // namespace

OcctPart OcctPart::plateWithHole() {
    const gp_Ax3 axes(tilted());
    const gp_Pln plane(axes);
    const TopoDS_Face square = BRepBuilderAPI_MakeFace(plane, -20.0, 20.0, -15.0, 15.0);
    const gp_Circ circle(gp_Ax2(gp_Pnt(5, -3, 2), gp_Dir(0.3, 0.2, 1.0)), 6.0);
    TopoDS_Wire hole = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle));
    hole.Reverse();
    BRepBuilderAPI_MakeFace face(square);
    face.Add(hole);
    return {"plate with a hole", std::make_shared<Shape>(face.Face())};
}

OcctPart OcctPart::cylinder() {
    return {"cylinder", std::make_shared<Shape>(BRepPrimAPI_MakeCylinder(tilted(), 7.0, 25.0).Shape())};
}

OcctPart OcctPart::cone() {
    return {"cone", std::make_shared<Shape>(BRepPrimAPI_MakeCone(tilted(), 9.0, 0.0, 14.0).Shape())};
}

OcctPart OcctPart::torus() {
    return {"torus", std::make_shared<Shape>(BRepPrimAPI_MakeTorus(tilted(), 20.0, 6.0).Shape())};
}

OcctPart OcctPart::sphere() {
    return {"sphere", std::make_shared<Shape>(BRepPrimAPI_MakeSphere(tilted(), 12.0).Shape())};
}

OcctPart OcctPart::sphereSlice() {
    return {"slice of a sphere",
            std::make_shared<Shape>(BRepPrimAPI_MakeSphere(tilted(), 12.0, -0.4, 1.1, 2.0).Shape())};
}

OcctPart OcctPart::freeFormFace() {
    TColgp_Array2OfPnt points(1, 7, 1, 6);
    for (int i = 1; i <= 7; ++i) {
        for (int j = 1; j <= 6; ++j) {
            points.SetValue(i, j, gp_Pnt(8.0 * i, 9.0 * j, 4.0 * std::sin(0.9 * i) * std::cos(0.8 * j)));
        }
    }
    const Handle(Geom_BSplineSurface) surface = GeomAPI_PointsToBSplineSurface(points).Surface();
    return {"free-form face", std::make_shared<Shape>(BRepBuilderAPI_MakeFace(surface, 1e-6).Face())};
}

OcctPart OcctPart::drilledBlock() {
    const TopoDS_Shape block = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 40.0, 30.0, 20.0).Shape();
    const TopoDS_Shape drill =
        BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(15, 14, -5), gp_Dir(0.2, 0.1, 1.0)), 6.0, 60.0).Shape();
    const TopoDS_Shape pocket = BRepPrimAPI_MakeSphere(gp_Pnt(34, 25, 20), 8.0).Shape();
    const TopoDS_Shape drilled = BRepAlgoAPI_Cut(block, drill).Shape();
    return {"drilled block", std::make_shared<Shape>(BRepAlgoAPI_Cut(drilled, pocket).Shape())};
}

std::vector<OcctPart> OcctPart::all() {
    return {plateWithHole(), cylinder(), cone(), torus(), sphere(), sphereSlice(), freeFormFace(), drilledBlock()};
}

bool OcctPart::writeStep(const std::string& path, const char* unit) const {
    STEPControl_Controller::Init();
    Interface_Static::SetCVal("write.step.unit", unit);  // a writer looks at it when it is made
    STEPControl_Writer writer;
    return writer.Transfer(shape_->shape, STEPControl_AsIs) == IFSelect_RetDone &&
           writer.Write(path.c_str()) == IFSelect_RetDone;
}

bool OcctPart::writeIges(const std::string& path) const {
    IGESControl_Writer writer("MM", 1);  // as B-Rep entities
    if (!writer.AddShape(shape_->shape)) return false;
    writer.ComputeModel();
    return writer.Write(path.c_str());
}

double OcctPart::distance(const Vector3& query) const {
    const TopoDS_Shape vertex = BRepBuilderAPI_MakeVertex(gp_Pnt(query.x(), query.y(), query.z()));
    const BRepExtrema_DistShapeShape extrema(vertex, shape_->faces);
    return extrema.IsDone() ? extrema.Value() : std::nan("");
}

bool OcctPart::isSolid() const { return TopExp_Explorer(shape_->shape, TopAbs_SOLID).More(); }

bool OcctPart::isInside(const Vector3& query) const {
    const BRepClass3d_SolidClassifier classifier(shape_->shape, gp_Pnt(query.x(), query.y(), query.z()), 1e-9);
    return classifier.State() == TopAbs_IN;
}

Eigen::AlignedBox3d OcctPart::bounds() const {
    Bnd_Box box;
    BRepBndLib::Add(shape_->shape, box);
    const gp_Pnt low = box.CornerMin();
    const gp_Pnt high = box.CornerMax();
    return {Vector3(low.X(), low.Y(), low.Z()), Vector3(high.X(), high.Y(), high.Z())};
}

}  // namespace cusp::geometry::test
