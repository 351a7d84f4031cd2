// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The comma-separated values behind a statement's slash.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace cusp::toolpath::detail {

struct Field {
    std::string_view text;  ///< trimmed
    double number = 0.0;
    bool is_number = false;

    /// Compares with a word given in upper case, whatever the case of the field.
    [[nodiscard]] bool is(std::string_view word) const;
};

/// No blank body has a field; `a,,b` has three, the second empty.
class Fields {
public:
    static constexpr std::size_t capacity = 24;  ///< CSYS, the longest statement read, has 12

    explicit Fields(std::string_view body);

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    /// There were more than `capacity`.
    [[nodiscard]] bool truncated() const { return truncated_; }
    [[nodiscard]] const Field& operator[](std::size_t i) const { return fields_[i]; }
    [[nodiscard]] const Field* begin() const { return fields_.data(); }
    [[nodiscard]] const Field* end() const { return fields_.data() + size_; }
    [[nodiscard]] bool contains(std::string_view word) const;

private:
    std::array<Field, capacity> fields_{};
    std::size_t size_ = 0;
    bool truncated_ = false;
};

}  // namespace cusp::toolpath::detail
