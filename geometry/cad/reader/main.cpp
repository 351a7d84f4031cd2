// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// cusp-cad: reads one STEP or IGES file with OCCT and writes its faces and edges as a stream; runs as a child of cusp, so that
// whatever a broken file does to OCCT ends here.
//
//   cusp-cad step|iges FILE        the stream goes to standard output, "code: message" lines to standard error
#include "brep_to_model.hpp"
#include "cad_stream.hpp"
#include "read_shape.hpp"

#include <Standard_Failure.hxx>

#include <cstdio>
#include <exception>
#include <fcntl.h>
#include <string>
#include <unistd.h>

namespace {

constexpr int bad_input = 3;
constexpr int no_output = 4;

int fail(const std::string& code, const std::string& message) {
    std::fprintf(stderr, "%s: %s\n", code.c_str(), message.c_str());
    return bad_input;
}

bool writeAll(int descriptor, const std::string& bytes) {
    std::size_t written = 0;
    while (written < bytes.size()) {
        const ssize_t n = ::write(descriptor, bytes.data() + written, bytes.size() - written);
        if (n <= 0) return false;
        written += static_cast<std::size_t>(n);
    }
    return true;
}

int run(bool step, const std::string& path) {
    // OCCT's readers print to standard output. What they say goes nowhere; the stream keeps the real one.
    const int out = ::dup(STDOUT_FILENO);
    const int nowhere = ::open("/dev/null", O_WRONLY);
    if (out < 0 || nowhere < 0 || ::dup2(nowhere, STDOUT_FILENO) < 0) return no_output;
    cusp::geometry::cad::ReadShape read = cusp::geometry::cad::readShape(step, path);
    if (!read.error_code.empty()) return fail(read.error_code, read.message);
    for (const std::string& warning : read.warnings) std::fprintf(stderr, "%s\n", warning.c_str());
    const cusp::geometry::cad::CadModel model = cusp::geometry::cad::modelOf(read.shape);
    if (model.faces.empty()) return fail("cad.no-faces", "there is no face in the file");
    return writeAll(out, cusp::geometry::cad::toStream(model)) ? 0 : no_output;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) return fail("cad.usage", "cusp-cad step|iges FILE");
    try {
        return run(std::string(argv[1]) == "step", argv[2]);
    } catch (const Standard_Failure& failure) {
        return fail("cad.unreadable", std::string("OCCT gives up: ") + failure.GetMessageString());
    } catch (const std::exception& error) {
        return fail("cad.unreadable", std::string("OCCT gives up: ") + error.what());
    }
}
