// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A program outside the house that needs nothing but base.
#include <cusp/base/diagnostics.hpp>
#include <cusp/base/result.hpp>

#if __has_include(<cusp/geometry/frames.hpp>)
#error "base alone must not open the door to geometry"
#endif

int main() {
    const cusp::base::Result<int> result = cusp::base::fail("consumer.test", "works from outside");
    return !result && !cusp::base::toText(result.error()).empty() ? 0 : 1;
}
