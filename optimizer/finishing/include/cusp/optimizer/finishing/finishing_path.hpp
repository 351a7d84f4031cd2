// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A whole finishing path: contact points joined by entries, exits and links; as moves, and as a CL file.
#pragma once

#include <cusp/optimizer/finishing/contact_path.hpp>
#include <cusp/simulation/tool_move.hpp>
#include <cusp/toolpath/cl_reader.hpp>
#include <cusp/toolpath/tool_library.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace cusp::finishing {

/// A place the tool goes to, and how.
struct PathMove {
    static constexpr std::uint32_t no_contact = 0xffffffff;

    toolpath::CutterLocation location;
    toolpath::MotionKind kind = toolpath::MotionKind::Feed;
    double feed_mm_per_s = 0.0;          ///< of a move at feed
    std::uint32_t contact = no_contact;  ///< index of the contact point it ends on
};

struct FinishingPath {
    ContactPath contacts;
    std::vector<PathMove> moves;  ///< the first one only places the tool
    std::uint32_t long_links =
        0;  ///< links that go over the clearance plane because the short way comes too near the part
};

/// Joins the passes: in at the approach feed along the tool axis, out along it at rapid, from pass to pass a short way off
/// the surface where the cutter stays clear of all of it, else over the clearance plane.
[[nodiscard]] FinishingPath joinPasses(ContactPath contacts, const Workpiece& part);

/// The moves as simulation takes them; `line` counts moves from 1.
[[nodiscard]] simulation::CutterPath cutterPath(const FinishingPath& path);

struct ClHeading {
    std::string part_name;  ///< PARTNO
    std::string remark;     ///< how the path came about: version, seed
    toolpath::Tool tool;    ///< called by number and name, with its cutter
    double spindle_rpm = 0.0;
    bool coolant = true;
};

/// Plain APT: the cutter by its seven values, RAPID where the tool is not cutting.
[[nodiscard]] toolpath::ToolPath clFile(const FinishingPath& path, const ClHeading& heading);

}  // namespace cusp::finishing
