// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Collects what is wrong with options, each with its name.
#pragma once

#include <cusp/base/result.hpp>

#include <fmt/format.h>
#include <string>
#include <string_view>
#include <utility>

namespace cusp::optimizer {

class OptionCheck {
public:
    void require(bool good, std::string_view key, std::string message) {
        if (!good)
            report_.error("evolution.option", std::move(message),
                          {.file = {}, .line = 0, .column = 0, .key = std::string(key)});
    }
    void share(double value, std::string_view key) {
        require(value >= 0.0 && value <= 1.0, key, fmt::format("{} is no share; it must be from 0 to 1", value));
    }
    base::Result<void> result() {
        if (report_.hasErrors()) return base::fail(std::move(report_));
        return {};
    }

private:
    base::Diagnostics report_;
};

}  // namespace cusp::optimizer
