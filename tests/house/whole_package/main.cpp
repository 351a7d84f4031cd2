// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A program outside the house that reads a CL file with the installed libraries.
#include <cusp/base/diagnostics.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <iostream>
#include <sstream>

int main() {
    std::istringstream text("UNITS/MM\nLOADTL/1\nFEDRAT/100.0,MMPM\nGOTO/1.0,2.0,3.0,0.0,0.0,1.0\nFINI\n");
    cusp::base::Diagnostics warnings;
    const auto path = cusp::toolpath::readToolPath(text, "consumer.apt", {}, warnings);
    if (!path) {
        std::cerr << cusp::base::toText(path.error());
        return 1;
    }
    std::cout << path->records.size() << " records\n";
    return path->records.empty() ? 1 : 0;
}
