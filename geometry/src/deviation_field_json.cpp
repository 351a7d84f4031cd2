// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A deviation field as JSON, written and read with every value checked.
#include <cusp/geometry/deviation_field.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace cusp::geometry {
namespace {

using base::Json;

constexpr std::size_t most_coefficients = 100'000;
constexpr std::int64_t schema = 1;

Json listOf(const Vector3& v) { return Json::array({v.x(), v.y(), v.z()}); }

/// Reads keys of one object and keeps what is wrong with them.
class ObjectReader {
public:
    ObjectReader(const Json& json, base::Location where) : json_(json), where_(std::move(where)) {
        if (!json_.is_object()) problem("deviation-field.key", "a deviation field is a JSON object", "");
    }

    double number(const char* key) { return numberOf(find(key), key); }

    std::int64_t integer(const char* key) { return integerOf(find(key), key); }

    std::vector<double> numbers(const char* key, std::size_t wanted) {
        std::vector<double> out;
        for (const Json* item : items(key, wanted)) out.push_back(numberOf(item, key));
        out.resize(wanted, 0.0);
        return out;
    }

    Vector3 vector(const char* key) {
        const std::vector<double> values = numbers(key, 3);
        return {values[0], values[1], values[2]};
    }

    /// `wanted` items of a list; none after a problem.
    std::vector<const Json*> items(const char* key, std::size_t wanted) {
        const Json* list = find(key);
        std::vector<const Json*> out;
        if (list == nullptr) return out;
        if (!list->is_array() || list->size() != wanted) {
            problem("deviation-field.key", fmt::format("a list of {} is needed", wanted), key);
            return out;
        }
        for (const Json& item : *list) out.push_back(&item);
        return out;
    }

    double numberOf(const Json* value, const char* key) {
        if (value == nullptr) return 0.0;
        if (value->is_number() && std::isfinite(value->get<double>())) return value->get<double>();
        problem("deviation-field.key", "a number is needed", key);
        return 0.0;
    }

    std::int64_t integerOf(const Json* value, const char* key) {
        if (value == nullptr) return 0;
        constexpr double largest = 1e9;
        if (value->is_number_integer() && std::abs(value->get<double>()) < largest) return value->get<std::int64_t>();
        problem("deviation-field.key", "a whole number is needed", key);
        return 0;
    }

    void require(bool holds, const char* text, const char* key) {
        if (!holds) problem("deviation-field.value", text, key);
    }

    void problem(std::string_view code, const std::string& text, std::string_view key) {
        base::Location place = where_;
        if (!key.empty()) place.key += (place.key.empty() ? "" : ".") + std::string(key);
        problems_.error(code, text, place);
    }

    [[nodiscard]] bool sound() const { return !problems_.hasErrors(); }
    [[nodiscard]] const base::Diagnostics& problems() const { return problems_; }

private:
    const Json* find(const char* key) {
        const auto found = json_.is_object() ? json_.find(key) : json_.end();
        if (json_.is_object() && found == json_.end()) problem("deviation-field.key", "this key is missing", key);
        return json_.is_object() && found != json_.end() ? &*found : nullptr;
    }

    const Json& json_;
    base::Location where_;
    base::Diagnostics problems_;
};

Matrix3 rotationOf(ObjectReader& reader) {
    const std::vector<double> values = reader.numbers("field_from_nominal", 9);
    Matrix3 out;
    for (std::size_t i = 0; i < values.size(); ++i)
        out(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3)) = values[i];
    const bool rotation = (out * out.transpose() - Matrix3::Identity()).norm() < 1e-9 && out.determinant() > 0.0;
    reader.require(rotation, "this is no rotation", "field_from_nominal");
    return out;
}

std::array<FieldAxis, 3> axesOf(ObjectReader& reader) {
    std::array<FieldAxis, 3> out{};
    const auto degrees = reader.items("degrees", 3);
    const auto cells = reader.items("cells", 3);
    const std::vector<double> low = reader.numbers("low_mm", 3);
    const std::vector<double> high = reader.numbers("high_mm", 3);
    if (!reader.sound()) return out;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t degree = reader.integerOf(degrees[k], "degrees");
        const std::int64_t count = reader.integerOf(cells[k], "cells");
        reader.require(degree == 0 || degree == 3, "a degree is 0 or 3", "degrees");
        reader.require(count >= 1 && count <= static_cast<std::int64_t>(most_coefficients) &&
                           (degree != 0 || count == 1),
                       "cells are 1 or more, exactly 1 along an axis of degree 0", "cells");
        reader.require(low[k] < high[k] || (degree == 0 && low[k] == high[k]), "the low end must be below the high end",
                       "low_mm");
        out[k] = {static_cast<int>(degree), static_cast<int>(count), low[k], high[k]};
    }
    return out;
}

/// How many coefficients the axes have; 0 when too many.
std::size_t coefficientsOf(const std::array<FieldAxis, 3>& axes) {
    std::size_t total = 1;
    for (const FieldAxis& axis : axes) {
        if (axis.coefficients() > most_coefficients / total) return 0;
        total *= axis.coefficients();
    }
    return total;
}

}  // namespace

base::Json DeviationField::toJson() const {
    Json out;
    out["schema"] = schema;
    out["shortest_wave_mm"] = data_.shortest_wave_mm;
    Json rotation = Json::array();
    for (Eigen::Index row = 0; row < 3; ++row)
        for (Eigen::Index column = 0; column < 3; ++column) rotation.push_back(data_.field_from_nominal(row, column));
    out["field_from_nominal"] = std::move(rotation);
    for (const char* key : {"degrees", "cells", "low_mm", "high_mm"}) out[key] = Json::array();
    for (const FieldAxis& axis : data_.axes) {
        out["degrees"].push_back(axis.degree);
        out["cells"].push_back(axis.cells);
        out["low_mm"].push_back(axis.low_mm);
        out["high_mm"].push_back(axis.high_mm);
    }
    out["coefficients_mm"] = data_.coefficients_mm;
    out["pose_translation_mm"] = listOf(data_.pose_translation_mm);
    out["pose_rotation_rad"] = listOf(data_.pose_rotation_rad);
    out["pivot_mm"] = listOf(data_.pivot_mm);
    out["samples"] = data_.samples;
    out["effective_freedoms"] = data_.effective_freedoms;
    out["smoothing"] = data_.smoothing;
    out["rms_mm"] = data_.rms_mm;
    out["residual_mm"] = data_.residual_mm;
    return out;
}

base::Result<DeviationField> DeviationField::fromJson(const base::Json& json, const base::Location& where) {
    ObjectReader reader(json, where);
    if (!reader.sound()) return base::fail(reader.problems());
    const std::int64_t version = reader.integer("schema");
    if (reader.sound() && version != schema)
        reader.problem("deviation-field.schema",
                       fmt::format("schema {} is not known; this version reads schema {}", version, schema), "schema");
    if (!reader.sound()) return base::fail(reader.problems());
    Data data;
    data.shortest_wave_mm = reader.number("shortest_wave_mm");
    data.field_from_nominal = rotationOf(reader);
    data.axes = axesOf(reader);
    if (reader.sound()) {
        const std::size_t total = coefficientsOf(data.axes);
        reader.require(total > 0, "the axes have more than 100000 coefficients", "cells");
        if (reader.sound()) data.coefficients_mm = reader.numbers("coefficients_mm", total);
    }
    data.pose_translation_mm = reader.vector("pose_translation_mm");
    data.pose_rotation_rad = reader.vector("pose_rotation_rad");
    data.pivot_mm = reader.vector("pivot_mm");
    data.samples = static_cast<std::size_t>(std::max<std::int64_t>(reader.integer("samples"), 0));
    data.effective_freedoms = reader.number("effective_freedoms");
    data.smoothing = reader.number("smoothing");
    data.rms_mm = reader.number("rms_mm");
    data.residual_mm = reader.number("residual_mm");
    if (!reader.sound()) return base::fail(reader.problems());
    return DeviationField(std::move(data));
}

base::Result<DeviationField> readReportedDeviationField(std::string_view json_text, const std::string& file_name,
                                                        std::string_view frame) {
    base::Location where;
    where.file = file_name;
    const Json json = Json::parse(json_text, nullptr, false);
    if (json.is_discarded()) return base::fail("json.syntax", "this is no JSON document", where);
    const std::string name(frame);
    where.key = "deviation_field";
    const auto fields = json.is_object() ? json.find("deviation_field") : json.end();
    if (!json.is_object() || fields == json.end() || !fields->is_object())
        return base::fail("deviation-field.none",
                          "this report holds no deviation field; it must be the report.json of cusp inspect", where);
    const auto field = fields->find(name);
    if (field == fields->end() || field->is_null()) {
        const auto reason = fields->find("reason");
        const bool told = reason != fields->end() && reason->is_string() && !reason->get<std::string>().empty();
        where.key += "." + name;
        return base::fail("deviation-field.none",
                          told ? reason->get<std::string>() : "this report holds no such deviation field", where);
    }
    where.key += "." + name;
    return DeviationField::fromJson(*field, where);
}

}  // namespace cusp::geometry
