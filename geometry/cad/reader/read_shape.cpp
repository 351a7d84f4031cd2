// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// OCCT's translators convert to mm whatever unit the file states.
#include "read_shape.hpp"

#include <IGESControl_Reader.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Reader.hxx>

namespace cusp::geometry::cad {
namespace {

ReadShape readWith(XSControl_Reader& reader, const char* format, const std::string& path) {
    ReadShape out;
    Interface_Static::SetCVal("xstep.cascade.unit", "MM");
    if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) {
        out.error_code = "cad.syntax";
        out.message = std::string("this is no ") + format + " file that OCCT can read";
        return out;
    }
    const int roots = reader.NbRootsForTransfer();
    int translated = 0;
    for (int i = 1; i <= roots; ++i) translated += reader.TransferOneRoot(i) ? 1 : 0;
    if (translated < roots) {
        out.warnings.push_back("cad.partial: " + std::to_string(roots - translated) + " of " + std::to_string(roots) +
                               " parts of the file could not be translated");
    }
    if (reader.NbShapes() > 0) out.shape = reader.OneShape();
    if (out.shape.IsNull()) {
        out.error_code = "cad.no-shape";
        out.message = "there is no shape in the file that OCCT can translate";
    }
    return out;
}

}  // namespace

ReadShape readShape(bool step, const std::string& path) {
    if (step) {
        STEPControl_Reader reader;
        return readWith(reader, "STEP", path);
    }
    IGESControl_Reader reader;
    return readWith(reader, "IGES", path);
}

}  // namespace cusp::geometry::cad
