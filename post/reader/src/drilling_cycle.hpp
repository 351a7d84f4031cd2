// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// CYCLE81 to CYCLE86 and CYCLE840 as the motions they make.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::post::reader {

/// One argument of a call; nothing where it is left out.
using CycleArguments = std::vector<std::optional<double>>;

/// One thing the cycle does. Heights are coordinates along the axis perpendicular to the plane, in the program's unit.
struct CycleStep {
    enum class Kind { Rapid, Feed, Aside, DwellSeconds, DwellRevolutions, SpindleTurn, SpindleReverse, SpindleRestore };
    Kind kind = Kind::Rapid;
    /// Height; length of the dwell; the M function of the spindle, 0 for the one before the cycle.
    double value = 0.0;
    double first = 0.0;               ///< Aside: a rapid by so much along the first axis of the plane,
    double second = 0.0;              ///< along its second,
    double up = 0.0;                  ///< and along its normal
    std::optional<double> feed;       ///< per minute, for this step; absent: the feed that holds
    double feed_factor = 1.0;         ///< of the feed that holds
    std::optional<double> pitch;      ///< feed per revolution of the spindle
    std::optional<double> speed_rpm;  ///< of the spindle, for this step
};

[[nodiscard]] bool isDrillingCycle(std::string_view name);

/// Nothing, with the reason in `problem`, when the arguments make no hole or one this reader does not know.
///
/// Order and meaning of the arguments: Siemens, SINUMERIK 840D/840Di/810D Programming Guide Cycles (PGZ), drilling cycles:
/// RTP, RFP, SDIS, DP, DPR; CYCLE82 + DTB; CYCLE83 + FDEP, FDPR, DAM, DTB, DTS, FRF, VARI; CYCLE84 + DTB, SDAC, MPIT, PIT,
/// POSS, SST, SST1; CYCLE840 + DTB, SDR, SDAC, ENC, MPIT, PIT; CYCLE85 + DTB, FFR, RFF; CYCLE86 + DTB, SDIR, RPA, RPO, RPAP, POSS. DPR and FDPR, unsigned from RFP, go
/// before DP and FDEP; a value left out is 0.
[[nodiscard]] std::optional<std::vector<CycleStep>>
drillingSteps(std::string_view name, const CycleArguments& arguments, std::string& problem);

}  // namespace cusp::post::reader
