// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Values: R parameters, DEF variables and arithmetic.
#pragma once

#include "block.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::post::reader {

/// Whether an expression goes on after this token: arithmetic, comparison and logic.
[[nodiscard]] bool isBinaryOperator(const Token& token);

class Variables {
public:
    /// False when the name exists already.
    [[nodiscard]] bool declare(std::string_view name, bool integer);
    [[nodiscard]] bool isDeclared(std::string_view name) const { return named().find(name) != named().end(); }
    /// Integers are rounded as the control does.
    void set(std::string_view name, double value);
    [[nodiscard]] std::optional<double> get(std::string_view name) const;
    void setParameter(int number, double value) { parameters_[number] = value; }
    /// R parameters outlive programs on the control, so one the program has not set has no value here.
    [[nodiscard]] std::optional<double> parameter(int number) const;
    /// A subprogram does not see its caller's variables (MD11120 as delivered); R parameters belong to all.
    void enterSubprogram() { levels_.emplace_back(); }
    void leaveSubprogram() { levels_.pop_back(); }

private:
    struct Variable {
        double value = 0.0;
        bool integer = false;
    };
    using Named = std::map<std::string, Variable, std::less<>>;
    [[nodiscard]] const Named& named() const { return levels_.back(); }

    std::vector<Named> levels_{1};
    std::map<int, double> parameters_;
};

/// The value of the tokens [first, last) of a block; angles of functions are degrees, as on the control. Nothing, and an
/// error in `report` (`nc.expression`, `nc.undeclared`, `nc.unset-parameter`, `nc.arithmetic`), when there is none.
[[nodiscard]] std::optional<double> evaluate(const Block& block, std::size_t first, std::size_t last,
                                             const Variables& variables, base::Diagnostics& report);

}  // namespace cusp::post::reader
