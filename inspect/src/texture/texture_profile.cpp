// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The reader of stylus profiles: a head of keys with units, then one or two columns of numbers.
#include <cusp/base/number_text.hpp>
#include <cusp/inspect/texture_profile.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace cusp::inspect {

namespace {

constexpr std::size_t longest_line = 1000;
constexpr std::size_t least_heights = 100;
constexpr std::size_t most_heights = 20'000'000;
constexpr double largest_step_error = 0.01;
constexpr double largest_length_mm = 1e6;
constexpr double largest_height_mm = 1e3;

std::string_view trimmed(std::string_view text) {
    const auto begin = text.find_first_not_of(" \r");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \r") - begin + 1);
}

/// "spacing_um" is {"spacing", 1e-3}; no unit known: factor 0.
std::pair<std::string_view, double> keyAndUnit(std::string_view text) {
    for (const auto& [unit, factor] : {std::pair{"_mm", 1.0}, std::pair{"_um", 1e-3}, std::pair{"_nm", 1e-6}})
        if (text.ends_with(unit)) return {text.substr(0, text.size() - 3), factor};
    return {text, 0.0};
}

class Reader {
public:
    Reader(std::istream& in, std::string name) : in_(in), name_(std::move(name)) { profile_.source = name_; }

    base::Result<StylusProfile> read(base::Diagnostics& warnings) {
        if (!readHead() || !readColumns()) return base::fail(std::move(report_));
        if (in_.bad()) return base::fail("io.read", "the profile could not be read to its end", where());
        if (!settleSpacing() || !checkFineness(warnings)) return base::fail(std::move(report_));
        return std::move(profile_);
    }

private:
    base::Location where() const { return {name_, line_number_, 0, {}}; }
    bool fail(std::string_view code, std::string message) {
        report_.error(code, std::move(message), where());
        return false;
    }

    /// The next line that is neither empty nor a remark; false at the end and after a line no profile has.
    bool nextLine(std::string_view& text) {
        while (std::getline(in_, line_)) {
            ++line_number_;
            if (line_.size() > longest_line) return fail("texture.format", "this line is too long for a profile");
            text = trimmed(line_);
            if (line_number_ == 1 && text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
            if (!text.empty() && text[0] != '#') return true;
        }
        return false;
    }

    std::vector<std::string_view> split(std::string_view text) const {
        std::vector<std::string_view> parts;
        while (true) {
            const auto at = text.find(separator_);
            parts.push_back(trimmed(text.substr(0, at)));
            if (at == std::string_view::npos) return parts;
            text.remove_prefix(at + 1);
        }
    }

    std::optional<double> number(std::string_view text) const {
        std::string plain(text);
        if (separator_ != ',') std::replace(plain.begin(), plain.end(), ',', '.');
        return base::parseDouble(plain);
    }

    bool readHead() {
        std::string_view text;
        if (!nextLine(text)) return noProfile();
        const auto at = text.find_first_of(",;\t");
        if (text.substr(0, at) != "cusp_stylus_profile" || at == std::string_view::npos) return noProfile();
        separator_ = text[at];
        if (trimmed(text.substr(at + 1)) != "1")
            return fail("texture.format",
                        fmt::format("version '{}' of this format is not known; 1 is", trimmed(text.substr(at + 1))));
        while (nextLine(text)) {
            const auto parts = split(text);
            if (keyAndUnit(parts.back()).first == "height") return readColumnNames(parts);
            if (parts.size() != 2 || !readKey(parts[0], parts[1])) return headLine(text);
        }
        if (!report_.empty()) return false;
        return fail("texture.format", "the file ends before the column height_um");
    }

    bool noProfile() {
        if (!report_.empty()) return false;
        return fail("texture.format",
                    "a stylus profile begins with the line cusp_stylus_profile,1; points of a coordinate measuring "
                    "machine give form and scallops, but no texture");
    }

    bool headLine(std::string_view text) {
        if (!report_.empty()) return false;
        return fail(
            "texture.format",
            fmt::format("'{}' is not understood; spacing_um, tip_radius_um or the column height_um (or _mm, _nm) "
                        "belongs here",
                        text));
    }

    /// False for a key that is not known; a bad value is reported.
    bool readKey(std::string_view key, std::string_view value) {
        const auto [name, factor] = keyAndUnit(key);
        if (factor == 0.0 || (name != "spacing" && name != "tip_radius")) return false;
        const auto read = number(value);
        if (!read || !(*read > 0.0))
            return fail("texture.number", fmt::format("{}: '{}' is no number above 0", key, value));
        if (name == "spacing")
            profile_.spacing_mm = *read * factor;
        else
            profile_.tip_radius_mm = *read * factor;
        return true;
    }

    bool readColumnNames(const std::vector<std::string_view>& names) {
        height_factor_ = keyAndUnit(names.back()).second;
        if (names.size() == 2) {
            const auto [name, factor] = keyAndUnit(names[0]);
            x_factor_ = name == "x" ? factor : 0.0;
        }
        const bool has_x = names.size() == 2 && x_factor_ > 0.0;
        if (height_factor_ == 0.0 || names.size() > 2 || (names.size() == 2 && !has_x))
            return fail("texture.format", "columns are height_um, or x_mm and height_um (or _mm, _nm)");
        if (has_x && profile_.spacing_mm > 0.0) return fail("texture.format", "either spacing or a column x, not both");
        return true;
    }

    bool readColumns() {
        const std::size_t columns = x_factor_ > 0.0 ? 2 : 1;
        for (std::string_view text; nextLine(text);) {
            const auto parts = split(text);
            const auto height = number(parts.back());
            const auto x = columns == 2 ? number(parts.front()) : height;
            if (parts.size() != columns || !height || !x)
                return fail("texture.number",
                            fmt::format("'{}' is not {}", text, columns == 2 ? "two numbers" : "a number"));
            if (profile_.height_mm.size() == most_heights)
                return fail("texture.format", fmt::format("more than {} heights", most_heights));
            if (std::abs(*height * height_factor_) > largest_height_mm)
                return fail("texture.number", fmt::format("'{}' is no height a stylus can have", text));
            profile_.height_mm.push_back(*height * height_factor_);
            if (columns == 2) x_mm_.push_back(*x * x_factor_);
        }
        return report_.empty();
    }

    bool settleSpacing() {
        line_number_ = 0;
        if (profile_.height_mm.size() < least_heights)
            return fail("texture.too-few", fmt::format("{} heights; a profile needs at least {}",
                                                       profile_.height_mm.size(), least_heights));
        if (x_factor_ == 0.0) {
            if (profile_.spacing_mm == 0.0) return fail("texture.spacing", "neither spacing nor a column x is given");
        } else if (!takeSpacing()) {
            return false;
        }
        if (!(profile_.lengthMm() < largest_length_mm))
            return fail("texture.spacing",
                        fmt::format("a trace of {:.6g} mm is no stylus profile", profile_.lengthMm()));
        return true;
    }

    /// From the column x, which may be rounded but must not have a gap.
    bool takeSpacing() {
        const double mean = (x_mm_.back() - x_mm_.front()) / static_cast<double>(x_mm_.size() - 1);
        if (!(mean > 0.0)) return fail("texture.spacing", "x must grow from line to line");
        std::size_t worst = 1;
        const auto error = [this, mean](std::size_t i) { return std::abs(x_mm_[i] - x_mm_[i - 1] - mean); };
        for (std::size_t i = 1; i < x_mm_.size(); ++i)
            if (!(error(i) <= error(worst))) worst = i;
        if (!(error(worst) <= largest_step_error * mean))
            return fail("texture.spacing",
                        fmt::format("the step from height {} to {} is {:.6g} mm, the mean step {:.6g} "
                                    "mm; filters need equal steps",
                                    worst, worst + 1, x_mm_[worst] - x_mm_[worst - 1], mean));
        profile_.spacing_mm = mean;
        return true;
    }

    bool checkFineness(base::Diagnostics& warnings) {
        if (profile_.spacing_mm > coarsest_spacing_mm)
            return fail(
                "texture.too-coarse",
                fmt::format("points lie {:.6g} mm apart: texture needs them 0.005 mm apart (ISO 3274), and beyond "
                            "{:.6g} mm nothing of it is seen; such points give form and scallops only",
                            profile_.spacing_mm, coarsest_spacing_mm));
        if (profile_.tip_radius_mm.value_or(0.0) >= largest_tip_radius_mm)
            return fail(
                "texture.tip",
                fmt::format("a tip of radius {:.6g} mm bridges the texture instead of following it; ISO 3274 has "
                            "0.002, 0.005 and 0.01 mm",
                            *profile_.tip_radius_mm));
        if (profile_.spacing_mm > standard_spacing_mm * (1.0 + 1e-9))
            warnings.warning(
                "texture.spacing",
                fmt::format("points lie {:.6g} mm apart, coarser than the 0.005 mm of ISO 3274: the finest "
                            "texture is not seen",
                            profile_.spacing_mm),
                where());
        return true;
    }

    std::istream& in_;
    std::string name_;
    std::string line_;
    std::size_t line_number_ = 0;
    char separator_ = ',';
    double height_factor_ = 0.0;
    double x_factor_ = 0.0;
    std::vector<double> x_mm_;
    StylusProfile profile_;
    base::Diagnostics report_;
};

}  // namespace

base::Result<StylusProfile> readStylusProfile(std::istream& in, const std::string& name, base::Diagnostics& warnings) {
    return Reader(in, name).read(warnings);
}

}  // namespace cusp::inspect
