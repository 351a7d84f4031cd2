// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From records to characteristics, parts and values, in the units used inside.
#include <cusp/base/number_text.hpp>
#include <cusp/base/units.hpp>
#include <cusp/inspect/qif_results.hpp>

#include "qif/qif_xml.hpp"

#include <cmath>
#include <fmt/format.h>
#include <unordered_map>
#include <utility>

namespace cusp::inspect {

namespace {

using qif::Record;

constexpr double mm_per_m = 1000.0;

/// "DiameterCharacteristicItem" is "Diameter".
std::string kindOf(const std::string& element) {
    const auto at = element.find("Characteristic");
    return at == std::string::npos ? element : element.substr(0, at);
}

/// Angularity is a zone, and a length.
bool isAngle(const std::string& kind) { return kind.starts_with("Angle") || kind == "AngularCoordinate"; }

/// Characteristics whose tolerance bounds a value that cannot be negative.
bool isZone(const std::string& kind) {
    for (const char* zone : {"Angularity", "Circularity", "CircularRunout", "Concentricity", "Cylindricity", "Flatness",
                             "LineProfile", "Parallelism", "Perpendicularity", "Position", "Straightness",
                             "SurfaceProfile", "Symmetry", "TotalRunout", "Coaxiality"})
        if (kind == zone) return true;
    return false;
}

struct Definition {
    std::optional<double> max, min, zone, outer;
    bool absolute = false;
};
struct Nominal {
    std::string definition;
    std::optional<double> target;
};
struct Item {
    std::string nominal, name, kind;
    std::size_t line = 0;
};
struct Value {
    std::size_t part = 0, line = 0;
    std::string item, feature, status;
    double value = 0.0;
};

class Collector : public qif::RecordTaker {
public:
    Collector(std::string name, base::Diagnostics& report, base::Diagnostics& warnings)
        : name_(std::move(name)), report_(report), warnings_(warnings) {
        results_.source = name_;
        results_.points.source = name_;
        results_.points.format = "qif";
    }

    void root(const std::string& name, const std::string& version, std::size_t line) override {
        if (name != "QIFDocument")
            fail("qif.not-qif", fmt::format("the document is <{}>, not a QIFDocument", name), line);
        else if (!version.starts_with("2.") && !version.starts_with("3."))
            fail("qif.version", fmt::format("QIF version '{}' is not known; 2.1 and 3.0 are", version), line);
        results_.version = version;
    }

    void begin(const std::string& name) override {
        if (name != "MeasurementResults") return;
        results_.parts.emplace_back();
        component_of_part_.emplace_back();
        feature_of_measured_.clear();
    }

    void leaf(const std::string& path, const std::string& text, std::size_t line) override {
        if (path.ends_with("PrimaryUnits/LinearUnit/UnitConversion/Factor"))
            takeFactor(mm_per_unit_, text, mm_per_m, line);
        else if (path.ends_with("PrimaryUnits/AngularUnit/UnitConversion/Factor"))
            takeFactor(rad_per_unit_, text, 1.0, line);
        else if (path.ends_with("PrimaryUnits/LinearUnit/SIUnitName"))
            // A unit without conversion is the SI unit itself; a factor that follows replaces it.
            mm_per_unit_ = mm_per_m;
        else if (path.ends_with("PrimaryUnits/AngularUnit/SIUnitName"))
            rad_per_unit_ = 1.0;
        else if (path.ends_with("MeasurementResults/ActualComponentIds/Id") && !component_of_part_.empty())
            component_of_part_.back() = text;
    }

    void take(const Record& record) override {
        if (record.list == "CharacteristicDefinitions")
            definitions_[record.id] = definitionOf(record);
        else if (record.list == "CharacteristicNominals")
            nominals_[record.id] = {std::string(record.text("CharacteristicDefinitionId")),
                                    number(record, "TargetValue")};
        else if (record.list == "CharacteristicItems")
            takeItem(record);
        else if (record.list == "FeatureItems")
            feature_names_[record.id] = std::string(record.text("FeatureName"));
        else if (record.list == "FeatureActuals" || record.list == "MeasuredFeatures")
            takeFeature(record);
        else if (record.list == "MeasuredPointSets")
            takePoints(record);
        else if (record.list == "ActualComponentSet")
            serial_numbers_[record.id] = std::string(record.text("SerialNumber"));
        else
            takeValue(record);
    }

    [[nodiscard]] bool failed() const override { return report_.hasErrors(); }

    QifResults finish() {
        settleUnits();
        labelParts();
        for (const Value& value : values_)
            if (!place(value)) break;
        if (!report_.hasErrors()) settlePoints();
        return std::move(results_);
    }

private:
    void fail(std::string_view code, std::string message, std::size_t line) {
        report_.error(code, std::move(message), {name_, line, 0, {}});
    }

    void takeFactor(std::optional<double>& unit, const std::string& text, double scale, std::size_t line) {
        const auto factor = base::parseDouble(text);
        if (!factor || !(*factor > 0.0))
            return fail("qif.unit", fmt::format("'{}' is no factor of a unit", text), line);
        unit = *factor * scale;
    }

    /// Absent, or a number; anything else is a problem.
    std::optional<double> number(const Record& record, std::string_view path) {
        const std::string_view text = record.text(path);
        if (text.empty()) return std::nullopt;
        const auto value = base::parseDouble(text);
        if (!value)
            fail("qif.number", fmt::format("{} {}: {} '{}' is not a number", record.kind, record.id, path, text),
                 record.line);
        return value;
    }

    Definition definitionOf(const Record& record) {
        Definition out;
        out.max = number(record, "Tolerance/MaxValue");
        out.min = number(record, "Tolerance/MinValue");
        out.zone = number(record, "ToleranceValue");
        out.outer = number(record, "OuterDisposition");
        out.absolute =
            record.text("Tolerance/DefinedAsLimit") == "true" || record.text("Tolerance/DefinedAsLimit") == "1";
        if (out.zone && !(*out.zone >= 0.0)) {
            warnings_.warning(
                "qif.tolerance",
                fmt::format("{} {}: a zone of width {:.6g} cannot be meant; the characteristic is taken as "
                            "without limits",
                            record.kind, record.id, *out.zone),
                {name_, record.line, 0, {}});
            out.zone.reset();
        }
        return out;
    }

    void takeItem(const Record& record) {
        std::string name(record.text("Name"));
        for (const char* path : {"CharacteristicDesignator/Designator", "KeyCharacteristic/Designator"})
            if (name.empty()) name = std::string(record.text(path));
        const std::string kind = kindOf(record.kind);
        if (name.empty()) name = kind + " " + record.id;
        items_[record.id] = {std::string(record.text("CharacteristicNominalId")), name, kind, record.line};
    }

    void takeFeature(const Record& record) {
        const std::string item(record.text("FeatureItemId"));
        const auto name = feature_names_.find(item);
        feature_of_measured_[record.id] = name == feature_names_.end() || name->second.empty() ? item : name->second;
        if (record.kind.find("PointFeature") == std::string::npos) return;
        if (const auto at = pointFrom(record)) {
            feature_points_.push_back(*at);
            feature_lines_.push_back(record.line);
        }
    }

    std::optional<Vector3> pointFrom(const Record& record) {
        std::string_view text = record.text("Location");
        Vector3 out;
        for (int axis = 0; axis < 3; ++axis) {
            const auto begin = text.find_first_not_of(" \n\t\r");
            if (begin == std::string_view::npos) return std::nullopt;
            const auto end = std::min(text.find_first_of(" \n\t\r", begin), text.size());
            const auto value = base::parseDouble(text.substr(begin, end - begin));
            if (!value) {
                fail("qif.number",
                     fmt::format("{} {}: '{}' is not a location", record.kind, record.id, record.text("Location")),
                     record.line);
                return std::nullopt;
            }
            out[axis] = *value;
            text.remove_prefix(end);
        }
        return out;
    }

    void takePoints(const Record& record) {
        if (record.points.empty())
            return fail(
                "qif.binary",
                fmt::format("point set {}: its points are binary, which is not read; export them as text", record.id),
                record.line);
        const std::size_t count = record.points.size() / 3;
        if (record.points.size() % 3 != 0 || std::to_string(count) != record.count)
            return fail("qif.count",
                        fmt::format("point set {} says it has {} points and holds {} numbers", record.id, record.count,
                                    record.points.size()),
                        record.line);
        MeasuredPoints& points = results_.points;
        const bool has_normals = record.normals.size() == record.points.size();
        has_all_normals_ = has_all_normals_ && has_normals;
        for (std::size_t i = 0; i < count; ++i) {
            points.positions.emplace_back(record.points[3 * i], record.points[3 * i + 1], record.points[3 * i + 2]);
            points.lines.push_back(record.line);
            if (!has_all_normals_) continue;
            const Vector3 normal(record.normals[3 * i], record.normals[3 * i + 1], record.normals[3 * i + 2]);
            has_all_normals_ = normal.norm() > 1e-12 && normal.allFinite();
            points.directions.push_back(normal.normalized());
        }
        takeProbe(record);
    }

    /// One kind and one probe for all sets, or nothing is said of either.
    void takeProbe(const Record& record) {
        const std::string_view compensated = record.text("Compensated");
        std::optional<PointKind> kind;
        if (compensated == "true" || compensated == "1") kind = PointKind::Surface;
        if (compensated == "false" || compensated == "0") kind = PointKind::Centre;
        const std::optional<double> radius = number(record, "ProbeRadius");
        const bool first = results_.points.size() * 3 == record.points.size();
        if (first) {
            results_.points.kind = kind;
            results_.points.probe_radius_mm = radius;
        } else if (results_.points.kind != kind || results_.points.probe_radius_mm != radius) {
            results_.points.kind.reset();
            results_.points.probe_radius_mm.reset();
        }
    }

    void takeValue(const Record& record) {
        if (results_.parts.empty())
            return fail("qif.reference", fmt::format("{} {} lies outside of any results", record.kind, record.id),
                        record.line);
        const auto value = number(record, "Value");
        if (!value) {
            ++results_.without_value;
            return;
        }
        std::string feature(record.text("FeatureActualIds/Id"));
        if (feature.empty()) feature = std::string(record.text("FeatureMeasurementIds/Id"));
        const auto known = feature_of_measured_.find(feature);
        values_.push_back({results_.parts.size() - 1, record.line, std::string(record.text("CharacteristicItemId")),
                           known == feature_of_measured_.end() ? std::string() : known->second,
                           std::string(record.text("Status/CharacteristicStatusEnum")), *value});
    }

    void settleUnits() {
        if (!mm_per_unit_ && (!values_.empty() || !results_.points.positions.empty()))
            warnings_.warning("qif.unit", "the document states no unit of length; millimetres are assumed",
                              {name_, 0, 0, {}});
        results_.points.unit_stated = mm_per_unit_.has_value();
        results_.points.mm_per_unit = mm_per_unit_.value_or(1.0);
    }

    void labelParts() {
        for (std::size_t i = 0; i < results_.parts.size(); ++i) {
            const auto serial = serial_numbers_.find(component_of_part_[i]);
            const bool known = serial != serial_numbers_.end() && !serial->second.empty();
            results_.parts[i].label = known ? serial->second : fmt::format("part {}", i + 1);
        }
    }

    /// The index of an item's characteristic, made when it is first met.
    std::optional<std::size_t> characteristicOf(const Value& value) {
        const auto known = index_of_item_.find(value.item);
        if (known != index_of_item_.end()) return known->second;
        const auto item = items_.find(value.item);
        if (item == items_.end()) {
            fail("qif.reference",
                 fmt::format("a value speaks of the characteristic item '{}', which nothing has", value.item),
                 value.line);
            return std::nullopt;
        }
        QifCharacteristic made;
        made.id = value.item;
        made.name = item->second.name;
        made.kind = item->second.kind;
        made.is_angle = isAngle(made.kind);
        setLimits(made, item->second);
        results_.characteristics.push_back(made);
        return index_of_item_[value.item] = results_.characteristics.size() - 1;
    }

    double unitOf(const QifCharacteristic& characteristic) const {
        return characteristic.is_angle ? rad_per_unit_.value_or(base::radFromDeg(1.0)) : mm_per_unit_.value_or(1.0);
    }

    void setLimits(QifCharacteristic& out, const Item& item) const {
        const auto nominal = nominals_.find(item.nominal);
        if (nominal == nominals_.end()) return;
        const double unit = unitOf(out);
        const auto scaled = [unit](std::optional<double> value) {
            return value ? std::optional(*value * unit) : value;
        };
        out.target = scaled(nominal->second.target);
        const auto found = definitions_.find(nominal->second.definition);
        if (found == definitions_.end()) return;
        const Definition& definition = found->second;
        if (definition.absolute || out.target) {
            const double about = definition.absolute ? 0.0 : *out.target;
            if (definition.max) out.upper = *definition.max * unit + about;
            if (definition.min) out.lower = *definition.min * unit + about;
        }
        if (!definition.zone) return;
        if (isZone(out.kind)) out.upper = *definition.zone * unit;
        if (out.kind == "PointProfile") {
            const double outer = definition.outer.value_or(*definition.zone / 2.0);
            out.upper = outer * unit;
            out.lower = (outer - *definition.zone) * unit;
        }
    }

    bool place(const Value& value) {
        const auto characteristic = characteristicOf(value);
        if (!characteristic) return false;
        const double unit = unitOf(results_.characteristics[*characteristic]);
        results_.measurements.push_back({value.part, *characteristic, value.feature, value.value * unit, value.status});
        return true;
    }

    void settlePoints() {
        MeasuredPoints& points = results_.points;
        if (points.positions.empty()) {
            points.positions = feature_points_;
            points.lines.assign(feature_lines_.begin(), feature_lines_.end());
        }
        const double unit = points.mm_per_unit;
        for (Vector3& position : points.positions) position *= unit;
        if (points.probe_radius_mm) *points.probe_radius_mm *= unit;
        if (points.directions.size() != points.positions.size()) points.directions.clear();
    }

    std::string name_;
    base::Diagnostics& report_;
    base::Diagnostics& warnings_;
    QifResults results_;
    std::optional<double> mm_per_unit_;
    std::optional<double> rad_per_unit_;
    std::unordered_map<std::string, Definition> definitions_;
    std::unordered_map<std::string, Nominal> nominals_;
    std::unordered_map<std::string, Item> items_;
    std::unordered_map<std::string, std::string> feature_names_;
    std::unordered_map<std::string, std::string> feature_of_measured_;  ///< in the part being read
    std::unordered_map<std::string, std::string> serial_numbers_;
    std::unordered_map<std::string, std::size_t> index_of_item_;
    std::vector<std::string> component_of_part_;
    std::vector<Value> values_;
    std::vector<Vector3> feature_points_;
    std::vector<std::size_t> feature_lines_;
    bool has_all_normals_ = true;
};

}  // namespace

base::Result<QifResults> readQif(std::istream& in, const std::string& name, base::Diagnostics& warnings) {
    base::Diagnostics report;
    Collector collector(name, report, warnings);
    qif::readRecords(in, name, collector, report);
    if (report.hasErrors()) return base::fail(std::move(report));
    QifResults results = collector.finish();
    if (report.hasErrors()) return base::fail(std::move(report));
    return results;
}

}  // namespace cusp::inspect
