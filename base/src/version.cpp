// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The one file that is compiled again when the version changes.
#include <cusp/base/version.hpp>

namespace cusp::base {

std::string_view version() { return CUSP_VERSION; }

}  // namespace cusp::base
