// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the enumerations of an inspection are called in results files and messages.
#include <cusp/inspect/alignment.hpp>
#include <cusp/inspect/conformance.hpp>

namespace cusp::inspect {

std::string_view freedomName(Freedom freedom) {
    constexpr std::array<std::string_view, 6> names{"tx", "ty", "tz", "rx", "ry", "rz"};
    return names.at(static_cast<std::size_t>(freedom));
}

std::string_view fitName(FitKind kind) {
    switch (kind) {
        case FitKind::None: return "none";
        case FitKind::LeastSquares: return "least-squares";
        case FitKind::Minimax: return "minimax";
    }
    return "";
}

std::string_view terminationName(Termination termination) {
    switch (termination) {
        case Termination::NotAsked: return "not-asked";
        case Termination::Converged: return "converged";
        case Termination::Stalled: return "stalled";
        case Termination::MaxIterations: return "max-iterations";
    }
    return "";
}

std::string_view verdictName(Verdict verdict) {
    switch (verdict) {
        case Verdict::NotAsked: return "not-asked";
        case Verdict::Accept: return "accept";
        case Verdict::Reject: return "reject";
        case Verdict::Undecided: return "undecided";
    }
    return "";
}

std::string_view ruleName(DecisionRule rule) {
    switch (rule) {
        case DecisionRule::Probability: return "ISO 14253-1:2017, probability 95 %";
        case DecisionRule::GuardBand: return "limits shrunk or widened by U = 2u";
    }
    return "";
}

}  // namespace cusp::inspect
