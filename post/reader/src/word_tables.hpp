// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The words of the 840D as tables: G groups, what is refused and why, what has no bearing on geometry.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace cusp::post::reader {

/// G groups this reader acts on, by Siemens' numbers (PM12, list of G functions).
namespace group {
inline constexpr int motion = 1;
inline constexpr int plane = 6;
inline constexpr int compensation = 7;
inline constexpr int work_offset = 8;
inline constexpr int frame_suppression = 9;
inline constexpr int path = 10;
inline constexpr int units = 13;
inline constexpr int dimension = 14;
inline constexpr int feed = 15;
inline constexpr int orientation_frame = 25;
inline constexpr int orientation_angles = 50;
inline constexpr int orientation_path = 51;
inline constexpr int count = 64;
}  // namespace group

struct GroupCode {
    std::string_view name;
    int group = 0;
    bool modal = true;
};

/// "G54", "TRAORI" is none. Nothing for words that belong to no group here, or that are refused.
[[nodiscard]] std::optional<GroupCode> findGroupCode(std::string_view name);
[[nodiscard]] std::optional<GroupCode> findGroupCode(int g_number);

/// Calls for the eyes of the operator: the blank of the simulation, folds of the editor.
[[nodiscard]] bool hasNoEffect(std::string_view call);

/// What a refused word is ("a jump"), or empty when it is not refused.
[[nodiscard]] std::string_view refusedWord(std::string_view name);
[[nodiscard]] std::string_view refusedCode(int g_number);
/// The same for addresses with a value ("AR", "SPOS").
[[nodiscard]] std::string_view refusedAddress(std::string_view name);

/// Words that take the rest of the block: DEF, and what this reader refuses but must not mistake for words.
[[nodiscard]] bool isStatement(std::string_view name);
/// Those of them that say which block runs next.
[[nodiscard]] bool isFlowStatement(std::string_view name);
/// Keywords and calls that have a meaning on the control, known or refused here: no names of subprograms.
[[nodiscard]] bool isVocabulary(std::string_view name);
/// "CR5": an address that needs '=' and has none.
[[nodiscard]] bool isAddressWithoutEquals(std::string_view name);

}  // namespace cusp::post::reader
