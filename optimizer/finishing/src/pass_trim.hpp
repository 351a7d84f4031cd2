// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Passes end where the face does.
#pragma once

#include <cusp/geometry/parametric_surface.hpp>
#include <cusp/optimizer/finishing/pass_curve.hpp>

#include <vector>

namespace cusp::finishing {

/// Appends what of `pass` lies on `shape`, in the direction of the pass: nothing, all, or several pieces. Gaps and pieces
/// shorter than a 256th of the pass may go unseen; ends are found within a millionth of it.
void trimPass(const PassCurve& pass, const geometry::ParametricSurface& shape, std::vector<PassCurve>& out);

}  // namespace cusp::finishing
