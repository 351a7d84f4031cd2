// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What each CAM system decides where plain APT leaves a choice: one trait record per dialect.
#pragma once

#include <cusp/toolpath/cl_reader.hpp>

#include <cstdint>
#include <span>
#include <string_view>

namespace cusp::toolpath::detail {

/// Which tool axis a GOTO with three values has.
enum class AxisRule : std::uint8_t {
    Modal,    ///< that of the GOTO before
    Declared  ///< TLAXIS or 0,0,1; that of the GOTO before while MULTAX is on
};

/// How a tool's name reaches the file.
enum class ToolNameRule : std::uint8_t {
    OperationHeader,  ///< TOOL PATH/operation,TOOL,name
    ToolPrint         ///< TPRINT/name,…
};

struct DialectTraits {
    Dialect dialect;
    const char* name;  ///< for messages
    AxisRule axis_rule;
    ToolNameRule tool_name_rule;
    /// Comments carry the system's records: `$$*CATIA0` and `$$ OPERATION NAME :`. Those of cusp's own are read always.
    bool comments_carry_records;
    /// Times the axis that CIRCLE names: the axis about which the motion is right-handed.
    double circle_axis_sign;
    /// Statements, or beginnings of comments, that only this dialect writes.
    std::span<const std::string_view> signature_words;
    std::span<const std::string_view> signature_comments;
};

[[nodiscard]] std::span<const DialectTraits> allDialects();
[[nodiscard]] const DialectTraits& traitsOf(Dialect dialect);

/// A set of dialects, for statements whose meaning differs between them.
using DialectSet = std::uint8_t;
inline constexpr DialectSet every_dialect = 0xFF;
[[nodiscard]] constexpr DialectSet only(Dialect dialect) {
    return static_cast<DialectSet>(1U << static_cast<unsigned>(dialect));
}

}  // namespace cusp::toolpath::detail
