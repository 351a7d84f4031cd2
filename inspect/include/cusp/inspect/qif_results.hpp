// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Results in QIF (Quality Information Framework, ISO 23952): what was measured, read from 2.1 and 3.0.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/inspect/measured_points.hpp>

#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace cusp::inspect {

/// A characteristic item with what its nominal and definition say. Lengths in mm, angles in rad.
struct QifCharacteristic {
    std::string id;    ///< of the item, in its file
    std::string name;  ///< Name, or else the designator, or else the kind and the id
    std::string kind;  ///< "Diameter", "Flatness", "PointProfile" …
    bool is_angle = false;
    std::optional<double> target;
    std::optional<double> lower;  ///< limits of the value itself
    std::optional<double> upper;
};

/// One part: a MeasurementResults element.
struct QifPart {
    std::string label;  ///< serial number, or else "part 3"
};

struct QifMeasurement {
    std::size_t part = 0;            ///< index into `parts`
    std::size_t characteristic = 0;  ///< index into `characteristics`
    std::string feature;             ///< the feature item's name, or its id; empty when the value names none
    double value = 0.0;              ///< mm or rad
    std::string status;              ///< "PASS", "FAIL" … as the file says
};

struct QifResults {
    std::string source;
    std::string version;  ///< "2.1.0"
    std::vector<QifPart> parts;
    std::vector<QifCharacteristic> characteristics;
    std::vector<QifMeasurement> measurements;  ///< in the order of the file
    /// Of the point sets; without any, the locations of measured point features.
    MeasuredPoints points;
    std::size_t without_value = 0;  ///< measurements that state a status and no value
};

/// Reads a document as a stream: memory grows with what is kept, not with the text.
///
/// Limits: a tolerance is absolute when the file says so, else about the target; geometric tolerances (flatness,
/// position …) bound the value from above; a point profile has its zone about zero, shifted by OuterDisposition.
/// Units: the file's primary units; without any, mm and degrees are assumed, with a warning.
/// Errors: `qif.xml` (not well-formed; line and column), `qif.doctype`, `qif.not-qif`, `qif.version`, `qif.number`,
/// `qif.unit`, `qif.reference` (an id that nothing has), `qif.count` (a point set of other size than it says),
/// `qif.binary` (points in binary), `qif.large`, `io.read`. Warnings: `qif.unit`, `qif.tolerance` (a limit that cannot be
/// meant).
[[nodiscard]] base::Result<QifResults> readQif(std::istream& in, const std::string& name, base::Diagnostics& warnings);

}  // namespace cusp::inspect
