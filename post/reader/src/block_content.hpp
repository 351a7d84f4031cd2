// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a block asks for: its words sorted by meaning and evaluated, before the state of the machine is touched.
#pragma once

#include "block.hpp"
#include "drilling_cycle.hpp"
#include "expression.hpp"
#include "word_tables.hpp"

#include <cusp/post/reader/forward_chain.hpp>
#include <cusp/post/reader/program_reader.hpp>

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace cusp::post::reader {

/// A programmed coordinate in the program's units: mm or inch, degrees.
struct AxisTarget {
    enum class Mode { Modal, Absolute, Incremental, ShortestWay };
    Mode mode = Mode::Modal;
    double value = 0.0;
};

enum class FrameCommand { Trans, ATrans, Rot, ARot };

/// CYCLE800: the swivelled plane as its arguments say it, or none.
struct Swivel {
    bool clear = false;                         ///< CYCLE800(): no plane
    bool additive = false;                      ///< on top of the plane before (_ST)
    bool moves = false;                         ///< the cycle moves the rotary axes (_DIR)
    std::array<std::size_t, 3> order{0, 1, 2};  ///< axes of the first, second and third turn (_MODE)
    std::array<double, 3> before{};             ///< reference point before the turns
    std::array<double, 3> angles_deg{};
    std::array<double, 3> after{};  ///< zero point after the turns
};

struct CycleCall {
    std::vector<CycleStep> steps;
};

struct BlockContent {
    std::array<std::optional<AxisTarget>, 3> linear;
    std::array<std::optional<AxisTarget>, max_rotary_axes> rotary;
    std::array<std::optional<double>, 3> vector;       ///< A3, B3, C3
    std::array<std::optional<double>, 3> angles_deg;   ///< A2, B2, C2
    std::array<std::optional<AxisTarget>, 3> center;   ///< I, J, K
    std::array<std::optional<AxisTarget>, 3> through;  ///< I1, J1, K1
    std::optional<double> radius;                      ///< CR
    std::optional<double> arc_angle_deg;               ///< AR
    std::optional<double> turns;                       ///< TURN
    std::optional<double> feed;
    std::optional<double> speed;
    std::optional<std::string> tool;
    std::optional<double> cutting_edge;
    std::optional<double> contour_tolerance;          ///< CTOL
    std::optional<double> orientation_tolerance_deg;  ///< OTOL
    std::vector<GroupCode> codes;
    std::vector<int> m_functions;
    std::optional<bool> transformation;
    std::optional<std::string> message;
    std::optional<std::vector<std::string>> high_speed;
    bool dwell = false;  ///< G4
    std::optional<FrameCommand> frame;
    std::optional<double> plane_angle_deg;  ///< RPL
    std::optional<Swivel> swivel;
    std::optional<CycleCall> cycle;
    bool modal_call = false;  ///< MCALL

    [[nodiscard]] bool movesLinear() const { return linear[0] || linear[1] || linear[2]; }
    [[nodiscard]] bool movesRotary() const { return rotary[0] || rotary[1] || rotary[2]; }
    [[nodiscard]] bool hasAngles() const { return angles_deg[0] || angles_deg[1] || angles_deg[2]; }
    /// An orientation that leaves the rotary axes to the control.
    [[nodiscard]] bool hasVector() const { return vector[0] || vector[1] || vector[2] || hasAngles(); }
    [[nodiscard]] bool hasThrough() const { return through[0] || through[1] || through[2]; }
    [[nodiscard]] bool hasArcWords() const {
        return center[0] || center[1] || center[2] || radius || arc_angle_deg || turns || hasThrough();
    }
};

/// Sorts blocks; keeps the program's variables, which assignments in a block change at once.
class ContentReader {
public:
    ContentReader(const machine::MachineDefinition& machine, const ForwardChain& chain, const ReaderOptions& options,
                  base::Diagnostics& report)
        : machine_(machine), chain_(chain), options_(options), report_(report) {}

    [[nodiscard]] BlockContent read(const Block& block);
    [[nodiscard]] Variables& variables() { return variables_; }

private:
    void code(const Word& word);
    void mFunction(int number, std::size_t column);
    void keyword(const Word& word);
    void call(const Word& word);
    void indexed(const Word& word);
    void statement(const Word& word);
    void declare(const Word& word);
    void value(const Word& word);
    [[nodiscard]] bool axisValue(const Word& word);
    [[nodiscard]] bool singleLetterValue(const Word& word);
    [[nodiscard]] bool extendedValue(const Word& word);
    [[nodiscard]] bool namedValue(const Word& word);
    void toolValue(const Word& word);
    void highSpeed(const Word& word);
    void swivel(const Word& word);
    void drillingCycle(const Word& word);
    [[nodiscard]] std::optional<CycleArguments> arguments(const Word& word);
    void addCode(const GroupCode& code, std::size_t column);
    [[nodiscard]] std::optional<double> number(const Word& word);
    void setNumber(std::optional<double>& slot, const Word& word);
    void setTarget(std::optional<AxisTarget>& slot, const Word& word);
    void repeated(const Word& word);
    void error(std::string_view code, std::string message, std::size_t column);
    void refuse(std::string_view word, std::string_view what, std::size_t column);

    const machine::MachineDefinition& machine_;
    const ForwardChain& chain_;
    const ReaderOptions& options_;
    base::Diagnostics& report_;
    Variables variables_;
    std::set<int> machine_functions_seen_;
    const Block* block_ = nullptr;
    BlockContent out_;
};

}  // namespace cusp::post::reader
