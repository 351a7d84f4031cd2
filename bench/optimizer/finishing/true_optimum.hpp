// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The best candidate there is, by a dense grid over all genes and a refinement until nothing moves.
#pragma once

#include <cusp/optimizer/evolution/encoding.hpp>
#include <cusp/optimizer/evolution/evaluation.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bench {

struct Optimum {
    std::vector<std::uint64_t> codes;
    double objective = 0.0;
    std::size_t evaluations = 0;
};

/// Every choice of the first gene × `steps[g]` evenly spaced codes of each other gene; then from the best `starts` of each choice a
/// search along every gene and along pairs of genes, by steps halved from half the grid's to one code (and doubled where they gain), until no step of one code
/// in one gene or in two together is better.
[[nodiscard]] Optimum trueOptimum(const cusp::optimizer::Encoding& encoding,
                                  const cusp::optimizer::EvaluateBatch& evaluate, const std::vector<std::size_t>& steps,
                                  std::size_t starts);

/// The refinement alone, from one candidate.
[[nodiscard]] Optimum refined(const cusp::optimizer::Encoding& encoding, const cusp::optimizer::EvaluateBatch& evaluate,
                              const Optimum& start, const std::vector<std::uint64_t>& first_step);

}  // namespace bench
