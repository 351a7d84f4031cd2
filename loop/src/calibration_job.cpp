// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The field tables of a calibration job.
#include <cusp/loop/calibration_job.hpp>

namespace cusp::loop {
namespace {

const base::Section<CalibrationPartJob>& partSection() {
    static const auto section = [] {
        base::Section<CalibrationPartJob> out("A part that was cut on the machine and measured.");
        out.field("cl_file", &CalibrationPartJob::cl_file, "CL file it was cut with.", base::required());
        out.field("nominal", &CalibrationPartJob::nominal, "Nominal surface.", base::required());
        out.field("points", &CalibrationPartJob::points, "Measured points, in any format cusp inspect reads.",
                  base::required());
        out.field("probe_radius_mm", &CalibrationPartJob::probe_radius_mm,
                  "Radius of the ball; absent: as the file says. 0 for surface points.", {.min = 0.0});
        out.field("motion", &CalibrationPartJob::motion,
                  "What the axes did, from cusp controller --record; empty: they follow the CL file.");
        out.choice("datums", &CalibrationPartJob::datums,
                   {{"free", CalibrationPartJob::Datums::Free}, {"fixed", CalibrationPartJob::Datums::Fixed}},
                   "Whether the part was measured in the machine's own datums (fixed), or in a frame of its own.");
        return out;
    }();
    return section;
}

const base::Section<KnownJob>& knownSection() {
    static const auto section = [] {
        base::Section<KnownJob> out("An error known from elsewhere: a presetter, a ball bar.");
        out.field("name", &KnownJob::name, "Name of the error, e.g. tool_length_mm.", base::required());
        out.field("value", &KnownJob::value, "In the unit the name ends in.", base::required());
        out.field("uncertainty", &KnownJob::uncertainty, "Standard uncertainty, in the same unit.",
                  base::requiredPositive());
        return out;
    }();
    return section;
}

}  // namespace

const base::Section<CalibrationJob>& calibrationJobSection() {
    static const auto section = [] {
        base::Section<CalibrationJob> out("A calibration: which parts, cut and measured how.");
        out.field("schema", &CalibrationJob::schema, "Version of this file's form.",
                  {.required = true, .min = 1.0, .max = 1.0});
        out.field("machine", &CalibrationJob::machine, "Machine file, or the name of one that ships with cusp.",
                  base::required());
        out.field("tool_length_mm", &CalibrationJob::tool_length_mm, "Of the tool as the control has it.",
                  base::requiredPositive());
        out.field("wcs_origin_mm", &CalibrationJob::wcs_origin_mm,
                  "Origin of the work offset in machine coordinates, rotary axes at zero.");
        out.field("noise_mm", &CalibrationJob::noise_mm,
                  "Standard deviation of one measured deviation; 0: from what the fit leaves.", {.min = 0.0});
        out.field("drift", &CalibrationJob::drift, "The measuring machine may have drifted evenly.");
        out.field("lobes", &CalibrationJob::lobes, "Its trigger may have three lobes about the stylus.");
        out.tables("part", &CalibrationJob::parts, partSection(), base::required());
        out.tables("known", &CalibrationJob::known, knownSection());
        return out;
    }();
    return section;
}

}  // namespace cusp::loop
