// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Splitting a statement's body into fields.
#include "fields.hpp"

#include "number_scan.hpp"
#include "statement.hpp"

#include <algorithm>

namespace cusp::toolpath::detail {

bool Field::is(std::string_view word) const { return !is_number && equalsWord(text, word); }

Fields::Fields(std::string_view body) {
    body = trimmed(body);
    bool more = !body.empty();
    while (more) {
        if (size_ == capacity) {
            truncated_ = true;
            return;
        }
        const std::size_t comma = body.find(',');
        more = comma != std::string_view::npos;
        Field& field = fields_[size_++];
        field.text = trimmed(body.substr(0, comma));
        const char* const last = field.text.data() + field.text.size();
        field.is_number = scanNumber(field.text.data(), last, field.number) == last && !field.text.empty();
        body.remove_prefix(more ? comma + 1 : body.size());
    }
}

bool Fields::contains(std::string_view word) const {
    return std::any_of(begin(), end(), [word](const Field& field) { return field.is(word); });
}

}  // namespace cusp::toolpath::detail
