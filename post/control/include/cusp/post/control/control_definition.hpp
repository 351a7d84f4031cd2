// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The `[control]` part of a machine file, and the machine file as a whole.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/base/toml_schema.hpp>
#include <cusp/base/units.hpp>
#include <cusp/machine/machine_definition.hpp>
#include <cusp/post/control/sequence_definition.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cusp::post {

/// How numbers are written. 840D finishing defaults (manual 05/2009 p50): linear 5, rotary 5, vectors 6 decimals.
struct NumberFormat {
    std::int64_t linear_decimals = 5;
    std::int64_t rotary_decimals = 5;
    std::int64_t vector_decimals = 6;
    std::int64_t feed_decimals = 3;
    std::int64_t speed_decimals = 0;
};

/// How a program says where the tool is.
enum class ProgramForm : std::uint8_t {
    TraoriRotary,   ///< TRAORI: tip, and positions of the rotary axes
    TraoriVectors,  ///< TRAORI: tip, and the tool axis as A3, B3, C3
    Machine         ///< no transformation: positions of all axes, tool length and pivot resolved here
};

struct ControlDefinition {
    enum class Kind { Sinumerik840D };
    /// Which form of CYCLE832 the software takes (PM12 p1108): two numbers and a one up to 4.4, an orientation tolerance from 4.5.
    enum class Cycle832 { None, UpTo44, From45 };

    Kind kind = Kind::Sinumerik840D;
    /// MD21104 $MC_ORI_IPO_WITH_G_CODE: false → ORIWKS/ORIMKS decide the orientation's interpolation, true → ORIVECT/ORIAXES.
    bool md21104_ori_ipo_with_g_code = true;
    Cycle832 cycle832 = Cycle832::From45;
    double cycle832_tolerance_mm = 0.01;
    /// Key `cycle832_orientation_tolerance_deg`; the form from 4.5 demands one. 0.1° is an assumed finishing value.
    double cycle832_orientation_tolerance_rad = base::radFromDeg(0.1);
    ProgramForm form = ProgramForm::TraoriRotary;
    std::string start_codes = "G40 G17 G710 G94 G90 G60 G601 FNORM";
    std::string work_offset = "G54";
    std::int64_t block_number_step = 10;  ///< 0: no block numbers
    /// Numbers begin again behind it: N takes eight digits.
    std::int64_t block_number_max = 99999990;
    /// FGREF: the radius at which a rotary axis counts in the feed of blocks that only turn; absent: as the control has it.
    std::optional<double> fgref_mm;
    std::string retract_axis = "Z";  ///< goes home alone, before all others
    NumberFormat format;
    SequenceDefinition sequence;
    SwivelDefinition swivel;
};

/// The words of a file or a flag for each form: "traori-rotary", "traori-vectors", "machine".
[[nodiscard]] const std::vector<std::pair<std::string, ProgramForm>>& programFormWords();

/// One file, two rooms: `machine` belongs to kinematics, `control` to post.
struct MachineFile {
    machine::MachineDefinition machine;
    ControlDefinition control;
};

[[nodiscard]] const base::Section<ControlDefinition>& controlSection();

/// G54 to G57, G505 to G599 and G500: what an 840D takes as a settable frame.
[[nodiscard]] bool isSettableFrame(std::string_view text);

/// Reads and validates both parts; reports every problem at once, unknown keys included.
[[nodiscard]] base::Result<MachineFile> readMachineFile(const std::string& path);
[[nodiscard]] base::Result<MachineFile> parseMachineFile(std::string_view text, const std::string& file_name);

/// Every default written out, as TOML that reads back to the same.
[[nodiscard]] std::string toToml(const MachineFile& file);

}  // namespace cusp::post
