// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// cusp-scan: a request on standard input, an answer on standard output; started by cusp, not by people.
#include "pcl_registration.hpp"

#include <cstdio>
#include <exception>
#include <iostream>
#include <iterator>
#include <pcl/console/print.h>
#include <string>

int main() {
    try {
        // PCL speaks on standard output, which carries the answer.
        pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
        const std::string bytes{std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>()};
        const auto request = cusp::inspect::decodeRequest(bytes);
        if (!request) {
            std::fputs("cusp-scan is a part of cusp inspect --start scan, which starts it\n", stderr);
            return 2;
        }
        const std::string answer = cusp::inspect::encode(cusp::inspect::registerByFeatures(*request));
        return std::fwrite(answer.data(), 1, answer.size(), stdout) == answer.size() && std::fflush(stdout) == 0 ? 0
                                                                                                                 : 4;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "cusp-scan: %s\n", error.what());
        return 5;
    }
}
