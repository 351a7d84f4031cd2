// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Atomic copies with their digests.
#include <cusp/comm/link/file_delivery.hpp>

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/hash.hpp>

#include <filesystem>

namespace cusp::comm {

base::Result<FileDelivery> deliverFile(const std::string& folder, const std::string& name, std::string_view text) {
    const base::Location where{folder, 0, 0, {}};
    if (name.empty() || name.front() == '.' || name.find('/') != std::string::npos)
        return base::fail("file.name", "'" + name + "' is no name for a file in this folder", where);
    std::error_code ignored;
    if (!std::filesystem::is_directory(folder, ignored))
        return base::fail("io.no-folder", "is no folder that can be reached", where);
    const std::string path = (std::filesystem::path(folder) / name).string();
    if (auto written = base::writeWholeFile(path, text); !written) return base::fail(std::move(written).error());
    // One byte more than there should be is enough to see that it differs.
    const auto back = base::readWholeFile(path, text.size() + 1);
    if (!back) return base::fail(back.error());
    const std::string digest = base::sha256Hex(*back);
    if (digest != base::sha256Hex(text))
        return base::fail("file.differs", "what was read back is not what was written", {path, 0, 0, {}});
    if (auto written = base::writeWholeFile(path + ".sha256", digest + "  " + name + "\n"); !written)
        return base::fail(std::move(written).error());
    return FileDelivery{path, digest};
}

}  // namespace cusp::comm
