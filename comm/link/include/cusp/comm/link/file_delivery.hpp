// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Delivery to a folder a control reads from: a network drive, an external program memory.
#pragma once

#include <cusp/base/result.hpp>

#include <string>
#include <string_view>

namespace cusp::comm {

struct FileDelivery {
    std::string path;
    std::string digest;  ///< SHA-256 of what was read back
};

/// `text` appears in `folder` as `name`, whole or not at all, and is read back and compared. Beside it `name`.sha256
/// keeps its digest in the form `sha256sum -c` takes.
/// Errors: `file.name` (would leave the folder), `io.no-folder`, `io.…`, `file.differs` (read back something else).
[[nodiscard]] base::Result<FileDelivery> deliverFile(const std::string& folder, const std::string& name,
                                                     std::string_view text);

}  // namespace cusp::comm
