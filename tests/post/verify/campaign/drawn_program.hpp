// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// CL paths with programs for them in every form a program can have, drawn at random from closed forms: no part of the
// writer has a hand in them.
#pragma once

#include "closed_forms.hpp"
#include "nc_blocks.hpp"

#include <cusp/base/random.hpp>
#include <cusp/post/verify/verify_program.hpp>

#include <string>
#include <vector>

namespace cusp::post::verify::test {

enum class Form { RotaryAxes, NearThePole, Vectors, MachineCoordinates, Arcs, Chords, Drilling, Swivelled, Framed };
inline constexpr Form all_forms[] = {Form::RotaryAxes,         Form::NearThePole, Form::Vectors,
                                     Form::MachineCoordinates, Form::Arcs,        Form::Chords,
                                     Form::Drilling,           Form::Swivelled,   Form::Framed};
[[nodiscard]] std::string nameOf(Form form);

struct DrawnProgram {
    Form form = Form::RotaryAxes;
    std::string machine = "three-axis";       ///< name of its file
    const ClosedForm* closed_form = nullptr;  ///< of five-axis machines
    bool md21104 = false;                     ///< the machine file's: ORIAXES acts, not ORIMKS
    std::vector<NcBlock> blocks;
    toolpath::ToolPath path;
    VerifyOptions options;
    double tool_length_mm = 130.0;
    Vector3d origin_mm = Vector3d::Zero();
};

/// `tool_length_error_mm` is what machine coordinates are computed with, too long.
[[nodiscard]] DrawnProgram drawProgram(Form form, base::Random& random, double tool_length_error_mm = 0.0);

}  // namespace cusp::post::verify::test
