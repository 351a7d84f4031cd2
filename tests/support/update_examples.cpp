// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Rewrites the generated files under examples/: `update_examples [SOURCE_FOLDER]`. Their tests then compare bytes.
#include "benchmark_path.hpp"

#include <cstdlib>
#include <fmt/format.h>
#include <fstream>

int main(int argc, char** argv) {
    const std::string folder = argc > 1 ? argv[1] : CUSP_SOURCE_DIR;
    const std::string file = folder + "/examples/benchmark/surface_finish.cls";
    std::ofstream out(file, std::ios::binary);
    out << cusp::test_support::benchmarkPathText();
    if (!out.flush()) {
        fmt::print(stderr, "cannot write {}\n", file);
        return EXIT_FAILURE;
    }
    fmt::print("{}\n", file);
    return EXIT_SUCCESS;
}
