// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A main for a fuzz entry built without libFuzzer: runs it over every file of the corpus folders, whole and cut short.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

std::vector<std::filesystem::path> filesBelow(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) files.push_back(entry.path());
    }
    // Directory order differs between file systems; a failure must not move.
    std::sort(files.begin(), files.end());
    return files;
}

/// The file as it is, and cut at 32 places: a truncated file is the commonest broken input.
void replay(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    constexpr std::size_t cuts = 32;
    for (std::size_t cut = 0; cut <= cuts; ++cut) {
        const std::size_t size = bytes.size() * cut / cuts;
        // A copy of exactly that size lets the address sanitizer see a read past the end.
        const std::vector<std::uint8_t> input(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
        LLVMFuzzerTestOneInput(input.data(), input.size());
    }
}

}  // namespace

int main(int argc, char** argv) {
    std::size_t count = 0;
    for (int i = 1; i < argc; ++i) {
        if (!std::filesystem::is_directory(argv[i])) {
            std::cerr << "no corpus folder " << argv[i] << '\n';
            return 1;
        }
        for (const auto& file : filesBelow(argv[i])) {
            // Named before it runs, so that a crash says which file it was.
            std::cout << file.string() << std::endl;
            replay(file);
            ++count;
        }
    }
    std::cout << count << " corpus files replayed\n";
    return count == 0 ? 1 : 0;
}
