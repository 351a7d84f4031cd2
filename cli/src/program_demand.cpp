// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A program's bytes against its time, from the reader's motions.
#include "program_demand.hpp"

#include <cusp/base/number_text.hpp>
#include <cusp/post/reader/program_reader.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <sstream>
#include <string_view>
#include <vector>

namespace cusp::cli {

namespace {

constexpr double step_s = 0.1;
constexpr double most_s = 100.0 * 3600.0;

/// What leads backward, or may (GOTO looks forward first, then back: 840D job planning, "Jumps").
bool mayJumpBackward(std::string_view word) {
    static constexpr std::array<std::string_view, 11> words{"GOTO",  "GOTOB", "GOTOC",  "GOTOS",   "LOOP", "ENDLOOP",
                                                            "WHILE", "FOR",   "REPEAT", "REPEATB", "UNTIL"};
    return std::ranges::find(words, word) != words.end();
}

/// The block without comment, operator messages and other quoted text.
std::string codeOf(std::string_view line) {
    std::string out;
    bool quoted = false;
    for (const char c : line) {
        if (c == '"') quoted = !quoted;
        if (c == ';' && !quoted) break;
        if (!quoted) out += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    return out;
}

bool hasBackwardJump(const std::string& code) {
    std::string word;
    for (const char c : code + ' ') {
        if (std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_') {
            word += c;
            continue;
        }
        if (mayJumpBackward(word)) return true;
        word.clear();
    }
    return false;
}

template <class Visit>
void forEachLine(const std::string& text, const Visit& visit) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        visit(at, std::string_view(text).substr(at, end - at));
        at = end + 1;
    }
}

double distance(const post::reader::Vector3& a, const post::reader::Vector3& b) {
    return std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
}

class DemandSink : public post::reader::ProgramSink {
public:
    DemandSink(const std::string& text, const machine::MachineDefinition& machine) {
        forEachLine(text, [&](std::size_t at, std::string_view) { line_begin_.push_back(at); });
        line_begin_.push_back(text.size());
        for (const auto& [name, axis] : machine.linear)
            fastest_mm_per_s_ = std::hypot(fastest_mm_per_s_, axis.max_velocity_mm_per_s);
        for (const auto& [name, axis] : machine.rotary)
            fastest_rad_per_s_ = std::max(fastest_rad_per_s_, axis.max_velocity_rad_per_s);
        demand_.step_s = step_s;
    }

    void motion(const post::reader::ExecutedMotion& motion) override {
        take(motion.place.line);
        now_s_ += std::max(linearTime(motion), rotaryTime(motion));
    }
    void event(const post::reader::BlockPlace& place, const post::reader::ExecutedEvent& event) override {
        take(place.line);
        if (const auto* dwell = std::get_if<post::reader::DwellTime>(&event)) now_s_ += dwell->seconds.value_or(0.0);
    }

    comm::DemandProfile finish() {
        take(line_begin_.size() - 1);
        return std::move(demand_);
    }

private:
    /// The control needs a block when it begins, and with it everything before.
    void take(std::size_t line) {
        const std::size_t end = line_begin_[std::min(line, line_begin_.size() - 1)];
        if (end <= taken_) return;
        const auto step = static_cast<std::size_t>(std::min(now_s_, most_s) / step_s);
        if (demand_.steps.size() <= step) demand_.steps.resize(step + 1);
        demand_.steps[step].bytes += static_cast<double>(end - taken_);
        demand_.steps[step].blocks += static_cast<double>(line - lines_);
        taken_ = end;
        lines_ = line;
    }
    [[nodiscard]] double linearTime(const post::reader::ExecutedMotion& motion) const {
        double length_mm = distance(motion.path_start_mm, motion.path_end_mm);
        if (motion.arc)
            length_mm = std::hypot(motion.arc->sweep_rad * motion.arc->start_radius_mm, motion.arc->height_mm);
        double mm_per_s = fastest_mm_per_s_;
        const auto& feed = motion.state->feed;
        if (motion.code != post::reader::MotionCode::Rapid && feed.value && *feed.value > 0.0) {
            using Mode = post::reader::Feed::Mode;
            if (feed.mode == Mode::InverseTime) return 60.0 / *feed.value;
            mm_per_s = *feed.value * (feed.mode == Mode::PerRevolution ? motion.state->spindle_rpm : 1.0) / 60.0;
        }
        return mm_per_s > 0.0 ? length_mm / mm_per_s : 0.0;
    }
    [[nodiscard]] double rotaryTime(const post::reader::ExecutedMotion& motion) const {
        double most_rad = 0.0;
        for (std::size_t i = 0; i < motion.start.rotary_rad.size(); ++i) {
            if (motion.start.rotary_rad[i] && motion.end.rotary_rad[i])
                most_rad = std::max(most_rad, std::abs(*motion.end.rotary_rad[i] - *motion.start.rotary_rad[i]));
        }
        return fastest_rad_per_s_ > 0.0 ? most_rad / fastest_rad_per_s_ : 0.0;
    }

    std::vector<std::size_t> line_begin_;
    double fastest_mm_per_s_ = 0.0;
    double fastest_rad_per_s_ = 0.0;
    comm::DemandProfile demand_;
    double now_s_ = 0.0;
    std::size_t taken_ = 0;
    std::size_t lines_ = 0;
};

}  // namespace

ProgramFacts factsOf(const std::string& text) {
    ProgramFacts out;
    std::size_t number = 0;
    forEachLine(text, [&](std::size_t, std::string_view line) {
        ++number;
        const std::string code = codeOf(line);
        if (code.find_first_not_of(" \t\r%") != std::string::npos) ++out.blocks;
        if (!out.jump_line && hasBackwardJump(code)) out.jump_line = number;
    });
    return out;
}

std::optional<std::uint32_t> byteOfBlock(const std::string& text, std::uint32_t block) {
    std::optional<std::uint32_t> found;
    forEachLine(text, [&](std::size_t at, std::string_view line) {
        if (found || line.size() < 2 || std::toupper(static_cast<unsigned char>(line[0])) != 'N') return;
        const std::size_t digits = std::min(line.find_first_not_of("0123456789", 1), line.size());
        if (base::parseInteger(line.substr(1, digits - 1)) == block) found = static_cast<std::uint32_t>(at);
    });
    return found;
}

base::Result<comm::DemandProfile> demandOf(const std::string& text, const std::string& name,
                                           const post::MachineFile& machine) {
    DemandSink sink(text, machine.machine);
    std::istringstream stream(text);
    base::Diagnostics report;
    post::reader::readProgram(stream, name, machine, {}, sink, report);
    if (report.hasErrors()) return base::fail(std::move(report));
    return sink.finish();
}

}  // namespace cusp::cli
