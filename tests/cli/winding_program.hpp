// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A five-axis program for the tests of send and controller, and the control that runs it as fast as it can.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace cusp::cli {

inline const std::vector<std::string> place{"--wcs-origin-mm", "3000", "0", "-700"};

/// Winds in five axes, numbered; about 45 bytes a block.
inline std::string windingProgram(int blocks, double feed = 6000.0) {
    std::string text =
        "N1 G40 G17 G710 G94 G90 G60 G601\nN2 TRAFOOF\nN3 SUPA G0 Z0 D0\nN4 T=\"BALL_10\"\nN5 M6\nN6 D1\n"
        "N7 CYCLE832(0.01,_ORI_FINISH,0.1)\nN8 G54\nN9 S8000 M3\nN10 G0 C20 A15\nN11 TRAORI\nN12 G54\n"
        "N13 ORIAXES\nN14 G0 X0 Y0 C20 A15\nN15 Z30\nN16 G1 Z0 F" +
        std::to_string(static_cast<int>(feed)) + "\n";
    for (int i = 1; i <= blocks; ++i) {
        const double s = 0.5 * i;
        char block[160];
        std::snprintf(block, sizeof block, "N%d X%.5f Y%.5f Z%.5f C%.5f A%.5f\n", 16 + i, 40.0 * std::sin(s / 40.0),
                      0.05 * s + 0.4 * std::sin(s / 7.0), 2.0 * std::cos(s / 25.0) - 2.0,
                      20.0 + 10.0 * std::sin(s / 60.0), 15.0 + 5.0 * std::sin(s / 45.0));
        text += block;
    }
    return text + "N90001 G0 Z100\nN90002 TRAFOOF\nN90003 SUPA G0 Z0 D0\nN90004 M30\n";
}

/// `cusp controller` for that program.
inline std::vector<std::string> controller(const std::vector<std::string>& more) {
    std::vector<std::string> out{"controller", "-m", "fooke-endura-ca", "--pace", "fast"};
    out.insert(out.end(), place.begin(), place.end());
    out.insert(out.end(), more.begin(), more.end());
    return out;
}

}  // namespace cusp::cli
