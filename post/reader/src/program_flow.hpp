// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Jumps, structures and subprograms: which line runs next.
#pragma once

#include "block.hpp"
#include "expression.hpp"
#include "program_source.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::post::reader {

/// Keeps no state of its loops but the line that runs: a FOR reads its end value anew at each turn, and a jump may leave
/// any structure. What the control does with a jump into a structure is left to the control.
class ProgramFlow {
public:
    ProgramFlow(ProgramSource& source, Variables& variables, base::Diagnostics& report)
        : source_(source), variables_(variables), report_(report) {}

    /// Whether the block leaves the order of the file, and so is not for the executor.
    [[nodiscard]] bool takes(const Block& block);
    /// Runs such a block. False when the program cannot go on, which is then reported.
    [[nodiscard]] bool run(const Block& block);

    [[nodiscard]] bool inSubprogram() const { return !calls_.empty(); }
    /// M17, or another end, in a subprogram.
    void leaveSubprogram();
    /// The file goes on, but the subprogram that runs has ended without M17.
    [[nodiscard]] bool ranOut() const;

private:
    struct Call {
        std::string name;
        std::size_t back_to = 0;
        std::size_t runs_left = 0;
        std::vector<double> arguments;
    };
    enum class Way { Forward, Backward, Either };

    [[nodiscard]] std::optional<double> value(std::size_t first, std::size_t last);
    [[nodiscard]] std::optional<bool> condition(std::size_t first, std::size_t last);
    [[nodiscard]] bool conditionalJump(const Word& word, std::size_t jump);
    [[nodiscard]] bool jumpAt(std::size_t token, std::size_t& end);
    [[nodiscard]] std::optional<std::size_t> target(std::size_t token, Way way, std::string& name, std::size_t& end);
    [[nodiscard]] bool caseOf(const Word& word);
    [[nodiscard]] bool structure(const Word& word);
    [[nodiscard]] bool beginFor(const Word& word);
    [[nodiscard]] bool endFor(const Structure& structure);
    [[nodiscard]] bool withinForRange(const Block& block, const Word& word, bool& inside);
    [[nodiscard]] bool assignCounter(const Block& block, const Word& word, double value);
    [[nodiscard]] bool call(const Word& word, const ProgramPart& part);
    [[nodiscard]] bool heading(const Word& word);
    [[nodiscard]] const ProgramPart* subprogram(const Block& block);
    [[nodiscard]] bool alone(const Word& word);
    void continueAfter(std::size_t line) { source_.continueAt(line + 1); }
    bool error(std::string_view code, std::string message, std::size_t column);

    ProgramSource& source_;
    Variables& variables_;
    base::Diagnostics& report_;
    const Block* block_ = nullptr;
    std::vector<Call> calls_;
};

}  // namespace cusp::post::reader
