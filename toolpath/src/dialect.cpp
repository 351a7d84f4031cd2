// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The table of dialects.
#include "dialect.hpp"

#include <array>

namespace cusp::toolpath {

namespace detail {
namespace {

constexpr std::array<std::string_view, 3> nx_words{"TOOL PATH", "TLDATA", "MSYS"};
constexpr std::array<std::string_view, 3> solidworks_words{"TRNTYP", "CSYS", "CSI_SET_FLUTE_LENGTH"};
constexpr std::array<std::string_view, 2> catia_comments{"*CATIA0", "CATIA APT"};
// The writer's own heads.
constexpr std::array<std::string_view, 1> nx_comments{"CUSP DIALECT NX"};
constexpr std::array<std::string_view, 1> apt_comments{"CUSP DIALECT APT"};

constexpr std::array<DialectTraits, 4> dialects{{
    {Dialect::Nx, "NX", AxisRule::Modal, ToolNameRule::OperationHeader, false, -1.0, nx_words, nx_comments},
    {Dialect::Catia, "CATIA", AxisRule::Declared, ToolNameRule::ToolPrint, true, 1.0, {}, catia_comments},
    {Dialect::SolidWorksCam,
     "SolidWorks CAM",
     AxisRule::Declared,
     ToolNameRule::ToolPrint,
     false,
     1.0,
     solidworks_words,
     {}},
    {Dialect::Apt, "APT", AxisRule::Declared, ToolNameRule::ToolPrint, false, 1.0, {}, apt_comments},
}};

}  // namespace

std::span<const DialectTraits> allDialects() { return dialects; }

const DialectTraits& traitsOf(Dialect dialect) {
    for (const DialectTraits& traits : dialects) {
        if (traits.dialect == dialect) {
            return traits;
        }
    }
    return dialects.back();
}

}  // namespace detail

const char* dialectName(Dialect dialect) { return detail::traitsOf(dialect).name; }

}  // namespace cusp::toolpath
