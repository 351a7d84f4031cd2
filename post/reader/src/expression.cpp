// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A recursive evaluator over the tokens of one value.
#include "expression.hpp"

#include <cusp/base/units.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <vector>

namespace cusp::post::reader {

namespace {

/// Deeper than any real program; keeps a hostile one from exhausting the stack.
constexpr int deepest_nesting = 64;
constexpr double largest_parameter = 99'999.0;

constexpr double largest_integer = 2147483648.0;

/// From loosest to tightest, as the 840D has them: comparisons come last of all, after AND, XOR and OR (PM12, priority of
/// operators; NOT binds tightest). `B_NOT` and `<<` are not here.
constexpr std::array<std::array<std::string_view, 6>, 9> operator_levels = {{{"==", "<>", "<", ">", "<=", ">="},
                                                                             {"OR"},
                                                                             {"XOR"},
                                                                             {"AND"},
                                                                             {"B_OR"},
                                                                             {"B_XOR"},
                                                                             {"B_AND"},
                                                                             {"+", "-"},
                                                                             {"*", "/", "DIV", "MOD"}}};
constexpr std::size_t comparison_level = 0;

/// Comparisons look for relative equality to 1e-12 (PM12, precision correction on comparison errors).
bool equal(double a, double b) { return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b)); }

bool isTrue(double value) { return value != 0.0; }

using Value = std::optional<double>;

}  // namespace

bool isBinaryOperator(const Token& token) {
    if (token.kind != TokenKind::Name && token.kind != TokenKind::Symbol) return false;
    for (const auto& level : operator_levels)
        for (const std::string_view name : level)
            if (!name.empty() && token.text == name) return true;
    return false;
}

bool Variables::declare(std::string_view name, bool integer) {
    return levels_.back().emplace(std::string(name), Variable{0.0, integer}).second;
}

void Variables::set(std::string_view name, double value) {
    if (const auto found = levels_.back().find(name); found != levels_.back().end())
        found->second.value = found->second.integer ? std::round(value) : value;
}

std::optional<double> Variables::get(std::string_view name) const {
    const auto found = named().find(name);
    if (found == named().end()) return std::nullopt;
    return found->second.value;
}

std::optional<double> Variables::parameter(int number) const {
    const auto found = parameters_.find(number);
    if (found == parameters_.end()) return std::nullopt;
    return found->second;
}

namespace {

class Evaluator {
public:
    Evaluator(const Block& block, std::size_t first, std::size_t last, const Variables& variables,
              base::Diagnostics& report)
        : block_(block), at_(first), last_(last), variables_(variables), report_(report) {}

    Value run() {
        const Value value = whole();
        if (!value) return std::nullopt;
        if (at_ != last_) return fail("nc.expression", fmt::format("\"{}\" is out of place here", here().text));
        if (!std::isfinite(*value)) return fail("nc.arithmetic", "the value is not a finite number");
        return value;
    }

private:
    [[nodiscard]] const Token& here() const { return at_ < last_ ? block_.tokens[at_] : end_; }
    [[nodiscard]] bool accept(std::string_view symbol) {
        if (!here().is(symbol)) return false;
        ++at_;
        return true;
    }

    Value whole() { return binary(0); }

    Value fail(std::string_view code, std::string message) {
        const std::size_t at = std::min(at_, block_.tokens.size() - 1);
        report_.error(code, std::move(message), block_.at(block_.tokens[at].column));
        return std::nullopt;
    }

    /// One level of the operator table; what binds tighter stands below it.
    Value binary(std::size_t level) {
        if (level == operator_levels.size()) return factor();
        Value value = binary(level + 1);
        for (std::size_t chained = 0; value; ++chained) {
            const std::string_view name = operatorAt(level);
            if (name.empty()) return value;
            if (level == comparison_level && chained > 0)
                return fail("nc.expression",
                            "comparisons cannot follow one another; AND and OR bind tighter than comparisons on the "
                            "840D, so each comparison needs parentheses");
            ++at_;
            const Value right = binary(level + 1);
            if (!right) return std::nullopt;
            value = apply(name, *value, *right);
        }
        return value;
    }

    /// The operator of `level` that stands here, or an empty text.
    [[nodiscard]] std::string_view operatorAt(std::size_t level) const {
        if (here().kind != TokenKind::Name && here().kind != TokenKind::Symbol) return {};
        for (const std::string_view name : operator_levels[level])
            if (!name.empty() && here().text == name) return name;
        return {};
    }

    Value apply(std::string_view name, double a, double b) {
        if (name == "*") return a * b;
        if (name == "+") return a + b;
        if (name == "-") return a - b;
        if (name == "/" || name == "DIV" || name == "MOD") {
            if (b == 0.0) return fail("nc.arithmetic", "division by zero");
            return name == "/" ? a / b : name == "DIV" ? std::trunc(a / b) : std::fmod(a, b);
        }
        if (name.starts_with("B_")) return bitwise(name, a, b);
        const bool result = name == "AND"   ? isTrue(a) && isTrue(b)
                            : name == "OR"  ? isTrue(a) || isTrue(b)
                            : name == "XOR" ? isTrue(a) != isTrue(b)
                            : name == "=="  ? equal(a, b)
                            : name == "<>"  ? !equal(a, b)
                            : name == "<"   ? a < b && !equal(a, b)
                            : name == ">"   ? a > b && !equal(a, b)
                            : name == "<="  ? a < b || equal(a, b)
                                            : a > b || equal(a, b);
        return result ? 1.0 : 0.0;
    }

    Value bitwise(std::string_view name, double a, double b) {
        if (std::abs(a) > largest_integer || std::abs(b) > largest_integer)
            return fail("nc.arithmetic", fmt::format("{} takes whole numbers of 32 bits", name));
        const auto left = static_cast<std::int64_t>(a);
        const auto right = static_cast<std::int64_t>(b);
        return static_cast<double>(name == "B_AND" ? left & right : name == "B_OR" ? left | right : left ^ right);
    }

    Value factor() {
        if (here().kind == TokenKind::Name && here().text == "NOT") {
            ++at_;
            const Value value = nested(&Evaluator::factor);
            if (!value) return std::nullopt;
            return isTrue(*value) ? 0.0 : 1.0;
        }
        double sign = 1.0;
        while (here().is("-") || here().is("+")) {
            if (here().is("-")) sign = -sign;
            ++at_;
        }
        const Value value = operand();
        if (!value) return std::nullopt;
        return sign * *value;
    }

    Value operand() {
        const Token& token = here();
        if (token.kind == TokenKind::Number) {
            ++at_;
            return token.number;
        }
        if (accept("(")) return closing(nested());
        if (token.kind == TokenKind::Letter) return parameter();
        if (token.kind == TokenKind::Name) return named();
        if (token.kind == TokenKind::Text) return fail("nc.expression", "a number is expected here, not a text");
        return fail("nc.expression", "a value is missing");
    }

    Value nested(Value (Evaluator::*rule)() = &Evaluator::whole) {
        if (++depth_ > deepest_nesting)
            return fail("nc.expression", fmt::format("parentheses are nested more than {} deep", deepest_nesting));
        const Value value = (this->*rule)();
        --depth_;
        return value;
    }

    Value closing(Value value) {
        if (value && !accept(")")) return fail("nc.expression", "\")\" is missing");
        return value;
    }

    Value parameter() {
        const Token& letter = here();
        const std::size_t next = at_ + 1;
        if (letter.text != "R" || next >= last_ || block_.tokens[next].kind != TokenKind::Number ||
            !block_.tokens[next].integer || block_.tokens[next].number > largest_parameter)
            return fail("nc.expression", fmt::format("\"{}\" is no value", letter.text));
        const int number = static_cast<int>(block_.tokens[next].number);
        const Value value = variables_.parameter(number);
        if (!value) return fail("nc.unset-parameter", fmt::format("R{} is used before the program sets it", number));
        at_ += 2;
        return value;
    }

    Value named() {
        const std::string_view name = here().text;
        if (at_ + 1 < last_ && block_.tokens[at_ + 1].is("(")) return function(name);
        if (name.starts_with("$"))
            return fail("nc.unsupported", fmt::format("{} (a system variable) is not interpreted", name));
        if (name == "TRUE" || name == "FALSE") {
            ++at_;
            return name == "TRUE" ? 1.0 : 0.0;
        }
        const Value value = variables_.get(name);
        if (!value) return fail("nc.undeclared", fmt::format("{} is not declared", name));
        ++at_;
        return value;
    }

    Value function(std::string_view name) {
        at_ += 2;
        const Value a = nested();
        if (!a) return std::nullopt;
        Value b;
        if (accept(",")) {
            b = nested();
            if (!b) return std::nullopt;
        }
        const Value value = b ? ofTwo(name, *a, *b) : ofOne(name, *a);
        if (!value)
            return fail("nc.expression", fmt::format("{} is no function of {} that is known here", name,
                                                     b ? "two values" : "one value"));
        return closing(value);
    }

    static Value ofTwo(std::string_view name, double a, double b) {
        if (name == "ATAN2") return base::degFromRad(std::atan2(a, b));
        if (name == "MINVAL") return std::min(a, b);
        if (name == "MAXVAL") return std::max(a, b);
        return std::nullopt;
    }

    static Value ofOne(std::string_view name, double a) {
        if (name == "SIN") return std::sin(base::radFromDeg(a));
        if (name == "COS") return std::cos(base::radFromDeg(a));
        if (name == "TAN") return std::tan(base::radFromDeg(a));
        if (name == "ASIN") return base::degFromRad(std::asin(a));
        if (name == "ACOS") return base::degFromRad(std::acos(a));
        if (name == "SQRT") return std::sqrt(a);
        if (name == "POT") return a * a;
        if (name == "ABS") return std::abs(a);
        if (name == "TRUNC") return std::trunc(a);
        if (name == "ROUND") return std::round(a);
        if (name == "EXP") return std::exp(a);
        if (name == "LN") return std::log(a);
        return std::nullopt;
    }

    const Block& block_;
    std::size_t at_;
    std::size_t last_;
    const Variables& variables_;
    base::Diagnostics& report_;
    Token end_;
    int depth_ = 0;
};

}  // namespace

std::optional<double> evaluate(const Block& block, std::size_t first, std::size_t last, const Variables& variables,
                               base::Diagnostics& report) {
    if (last == first + 1 && block.tokens[first].kind == TokenKind::Number) return block.tokens[first].number;
    return Evaluator(block, first, last, variables, report).run();
}

}  // namespace cusp::post::reader
