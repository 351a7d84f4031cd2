// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// render_page PAGE INPUT.json OUTPUT.html: what the command does with a page, for tests that look at pages alone.
#include <cusp/base/atomic_file.hpp>
#include <cusp/pages/render.hpp>

#include <cstdio>

int main(int argc, char** argv) {
    using namespace cusp;
    if (argc != 4) {
        std::fputs("usage: render_page PAGE INPUT.json OUTPUT.html\n", stderr);
        return 2;
    }
    const auto done = base::readWholeFile(argv[2], std::size_t{1} << 30U)
                          .and_then([argv](const std::string& json) { return pages::renderPage(argv[1], json); })
                          .and_then([argv](const std::string& html) { return base::writeWholeFile(argv[3], html); });
    if (!done) std::fputs(base::toText(done.error()).c_str(), stderr);
    return done ? 0 : 1;
}
