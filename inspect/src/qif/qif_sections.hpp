// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The sections of a report as line profile characteristics of QIF 3.0.
#pragma once

#include <cusp/inspect/inspection_report.hpp>

#include <cstddef>
#include <string>

namespace cusp::inspect {

/// Ids of what the characteristics point to, and the first one that is free.
struct QifSectionIds {
    int feature_nominal = 0;
    int feature_item = 0;
    int measured_feature = 0;
    int first_free = 0;
};

/// Elements to put behind those of the whole surface; empty texts when no section is there or nothing was to be decided.
struct QifSections {
    std::size_t count = 0;
    int last_id = 0;  ///< highest id used
    std::string definition;
    std::string nominals;
    std::string items;
    std::string measurements;
};

/// Sections that lie in a plane and hold points. The value is twice the largest deviation, the status the decision by the
/// rule, limits and uncertainty of the whole, taken from the section's points.
[[nodiscard]] QifSections qifSections(const InspectionReport& report, const QifSectionIds& ids);

}  // namespace cusp::inspect
