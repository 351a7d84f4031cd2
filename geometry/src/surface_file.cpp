// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The field table of a surface file, and its faces from what is written there.
#include "surface_terms.hpp"

#include <cusp/geometry/surface_file.hpp>
#include <cusp/geometry/surface_forms.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace cusp::geometry {
namespace {

using base::Diagnostics;
using base::Location;
using base::Section;
using base::TomlNode;
using Form = FaceDescription::Form;

Location at(const TomlNode& table, std::string_view key) {
    const std::optional<TomlNode> node = table.at(key);
    return node ? node->where() : table.whereKey(key);
}

/// Every term of one coordinate into the coefficients, which grow as needed.
void addTerms(const FaceDescription::Terms& terms, int axis, const TomlNode& table, const char* key,
              std::vector<std::vector<Vector3>>& coefficients, Diagnostics& report) {
    std::set<std::pair<std::size_t, std::size_t>> seen;
    for (const auto& [term, value] : terms) {
        const auto powers = detail::parseTerm(term);
        if (!powers) {
            report.error("surface.term",
                         fmt::format("'{}' is no term; write \"1\", \"u\", \"v^2\", \"u^2 v\" with exponents up to {}",
                                     term, max_surface_degree),
                         at(table, key));
            continue;
        }
        if (!seen.insert({powers->of_u, powers->of_v}).second) {
            report.error("surface.term", fmt::format("the term '{}' is written twice", term), at(table, key));
        }
        const std::size_t rows = std::max(coefficients.size(), powers->of_u + 1);
        const std::size_t columns = std::max(coefficients.front().size(), powers->of_v + 1);
        coefficients.resize(rows);
        for (auto& row : coefficients) row.resize(columns, Vector3::Zero());
        coefficients[powers->of_u][powers->of_v][axis] = value;
    }
}

PolynomialForm polynomialOf(const FaceDescription& face, const TomlNode& table, Diagnostics& report) {
    PolynomialForm form;
    form.coefficients.assign(1, std::vector<Vector3>(1, Vector3::Zero()));
    const FaceDescription::Terms none;
    addTerms(face.x_mm.value_or(none), 0, table, "x_mm", form.coefficients, report);
    addTerms(face.y_mm.value_or(none), 1, table, "y_mm", form.coefficients, report);
    addTerms(face.z_mm.value_or(none), 2, table, "z_mm", form.coefficients, report);
    form.u_range = face.u_range.value_or(form.u_range);
    form.v_range = face.v_range.value_or(form.v_range);
    return form;
}

std::vector<std::vector<Vector3>> pointsOf(const FaceDescription& face) {
    std::vector<std::vector<Vector3>> out;
    for (const auto& row : face.points_mm.value_or(FaceDescription::Points{})) {
        out.emplace_back();
        for (const auto& point : row) out.back().push_back(toVector(point));
    }
    return out;
}

base::Result<SurfaceFace> faceOf(const FaceDescription& face, const TomlNode& table, Diagnostics& report) {
    if (face.form == Form::Polynomial) return toFace(polynomialOf(face, table, report), face.outward);
    const FaceDescription::Weights weights = face.weights.value_or(FaceDescription::Weights{});
    if (face.form == Form::Bezier) return toFace(BezierForm{pointsOf(face), weights}, face.outward);
    constexpr std::int64_t too_high = max_surface_degree + 1;
    BSplineForm form;
    form.degree_u = static_cast<int>(std::clamp<std::int64_t>(face.degree_u.value_or(0), 0, too_high));
    form.degree_v = static_cast<int>(std::clamp<std::int64_t>(face.degree_v.value_or(0), 0, too_high));
    form.knots_u = face.knots_u.value_or(std::vector<double>());
    form.knots_v = face.knots_v.value_or(std::vector<double>());
    form.points = pointsOf(face);
    form.weights = weights;
    return toFace(form, face.outward);
}

/// Which keys a form needs (1), may have (0) and must not have (−1).
struct KeyRule {
    const char* key;
    bool present;
    int polynomial;
    int bezier;
    int b_spline;
};

void checkKeys(const FaceDescription& face, const TomlNode& table, Diagnostics& report) {
    const KeyRule rules[] = {
        {"x_mm", face.x_mm.has_value(), 1, -1, -1},         {"y_mm", face.y_mm.has_value(), 1, -1, -1},
        {"z_mm", face.z_mm.has_value(), 1, -1, -1},         {"u_range", face.u_range.has_value(), 0, -1, -1},
        {"v_range", face.v_range.has_value(), 0, -1, -1},   {"points_mm", face.points_mm.has_value(), -1, 1, 1},
        {"weights", face.weights.has_value(), -1, 0, 0},    {"degree_u", face.degree_u.has_value(), -1, -1, 1},
        {"degree_v", face.degree_v.has_value(), -1, -1, 1}, {"knots_u", face.knots_u.has_value(), -1, -1, 1},
        {"knots_v", face.knots_v.has_value(), -1, -1, 1}};
    for (const KeyRule& rule : rules) {
        const bool polynomial = face.form == Form::Polynomial;
        const int need = polynomial ? rule.polynomial : face.form == Form::Bezier ? rule.bezier : rule.b_spline;
        const char* name = polynomial ? "polynomial" : face.form == Form::Bezier ? "Bézier" : "B-spline";
        if (need > 0 && !rule.present) {
            report.error("surface.key", fmt::format("a {} face needs {}", name, rule.key), table.whereKey(rule.key));
        } else if (need < 0 && rule.present) {
            report.error("surface.key", fmt::format("a {} face has no {}", name, rule.key), at(table, rule.key));
        }
    }
}

void checkFace(const FaceDescription& face, const TomlNode& table, Diagnostics& report) {
    const std::size_t errors_before = report.errorCount();
    checkKeys(face, table, report);
    if (report.errorCount() != errors_before) return;
    const auto made = faceOf(face, table, report);
    if (made || report.errorCount() != errors_before) return;
    for (const base::Diagnostic& problem : made.error()) {
        report.error(problem.code, problem.message, at(table, problem.where.key));
    }
}

void checkFile(const SurfaceFile& file, const TomlNode& root, Diagnostics& report) {
    if (file.schema != 1) {
        report.error("surface.schema-version",
                     fmt::format("schema {} is not known; this version reads schema 1", file.schema),
                     at(root, "schema"));
    }
    if (file.faces.empty()) {
        report.error("surface.empty", "a surface needs at least one face", at(root, "face"));
    }
}

Section<FaceDescription> faceSection() {
    Section<FaceDescription> section("A face.");
    section
        .choice("form", &FaceDescription::form,
                {{"polynomial", Form::Polynomial}, {"bezier", Form::Bezier}, {"b-spline", Form::BSpline}},
                "How the face is written down.", base::required())
        .choice("outward", &FaceDescription::outward,
                {{"du x dv", Outward::DuCrossDv}, {"dv x du", Outward::DvCrossDu}},
                "The normal that points out of the material.", base::required())
        .field("x_mm", &FaceDescription::x_mm, "Polynomial: terms of x, as {\"1\" = 2.5, \"u^2 v\" = 1}.")
        .field("y_mm", &FaceDescription::y_mm, "Polynomial: terms of y.")
        .field("z_mm", &FaceDescription::z_mm, "Polynomial: terms of z.")
        .field("u_range", &FaceDescription::u_range, "Polynomial: from and to; without it 0 to 1.")
        .field("v_range", &FaceDescription::v_range, "Polynomial: from and to; without it 0 to 1.")
        .field(
            "points_mm", &FaceDescription::points_mm,
            "Bézier and B-spline: control points, a row for each step of u, in it a point [x, y, z] for each step of v.")
        .field("weights", &FaceDescription::weights, "Bézier and B-spline: a weight for each point, when they differ.")
        .field("degree_u", &FaceDescription::degree_u, "B-spline: degree along u.")
        .field("degree_v", &FaceDescription::degree_v, "B-spline: degree along v.")
        .field("knots_u", &FaceDescription::knots_u,
               "B-spline: knots along u, each as often as it counts: points + degree + 1 of them.")
        .field("knots_v", &FaceDescription::knots_v, "B-spline: knots along v.")
        .check(checkFace);
    return section;
}

Section<SurfaceFile> fileSection() {
    Section<SurfaceFile> section("A surface, of one or more faces.");
    section.field("schema", &SurfaceFile::schema, "Version of this file format; 1.", base::required())
        .field("name", &SurfaceFile::name, "Name of the surface.", base::required())
        .field("description", &SurfaceFile::description, "What it is, and where it is from.")
        .tables("face", &SurfaceFile::faces, faceSection(), base::required())
        .check(checkFile);
    return section;
}

base::Result<std::vector<SurfaceFace>> facesOf(base::Result<base::TomlDocument> document) {
    if (!document) return base::fail(std::move(document).error());
    Diagnostics report;
    const SurfaceFile file = surfaceFileSection().read(document->root(), report);
    std::vector<SurfaceFace> faces;
    if (!report.hasErrors()) {
        const std::vector<TomlNode> tables = document->root().at("face")->elements();
        for (std::size_t i = 0; i < file.faces.size(); ++i) {
            // The check above made each face once, so there is a value.
            faces.push_back(faceOf(file.faces[i], tables[i], report).value());
        }
    }
    if (report.hasErrors()) return base::fail(std::move(report));
    return faces;
}

}  // namespace

const base::Section<SurfaceFile>& surfaceFileSection() {
    static const Section<SurfaceFile> section = fileSection();
    return section;
}

base::Result<std::vector<SurfaceFace>> readSurfaceFile(const std::string& path) {
    return facesOf(base::TomlDocument::readFile(path));
}

base::Result<std::vector<SurfaceFace>> readSurface(std::string_view text, const std::string& file_name) {
    return facesOf(base::TomlDocument::parse(text, file_name));
}

}  // namespace cusp::geometry
