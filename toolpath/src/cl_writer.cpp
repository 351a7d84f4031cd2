// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The writer: each record as the statement from which the reader makes the same record.
#include "statement.hpp"
#include "tool_shape.hpp"

#include <cusp/base/number_text.hpp>
#include <cusp/base/units.hpp>
#include <cusp/base/version.hpp>
#include <cusp/toolpath/cl_writer.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <initializer_list>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

namespace cusp::toolpath {
namespace {

using geometry::Cutter;
using geometry::RigidTransform;
using geometry::Vector3;

/// The number that `forward` takes to exactly `target`: a short one near `guess` if there is, else a neighbour of it. A
/// value that was read has one; for another the nearest is as good.
template <class Forward>
double preimage(Forward forward, double guess, double target) {
    constexpr std::array<const char*, 3> shorter{"{:.9g}", "{:.12g}", "{:.15g}"};
    for (const char* const format : shorter) {
        const std::optional<double> rounded = base::parseDouble(fmt::format(fmt::runtime(format), guess));
        if (rounded && forward(*rounded) == target) {
            return *rounded;
        }
    }
    constexpr int neighbours = 3;
    double below = guess;
    double above = guess;
    for (int i = 0; i <= neighbours; ++i) {
        if (forward(below) == target) {
            return below;
        }
        if (forward(above) == target) {
            return above;
        }
        below = std::nextafter(below, -std::numeric_limits<double>::infinity());
        above = std::nextafter(above, std::numeric_limits<double>::infinity());
    }
    return guess;
}

double degreesFor(double rad) {
    return preimage([](double deg) { return base::radFromDeg(deg); }, base::degFromRad(rad), rad);
}

double writtenFeed(const FeedRate& feed) {
    if (feed.unit == FeedRate::Unit::MmPerRev) {
        return feed.value;
    }
    return preimage([](double written) { return base::mmPerSFromMmPerMin(written); },
                    base::mmPerMinFromMmPerS(feed.value), feed.value);
}

const char* feedWord(const FeedRate& feed) { return feed.unit == FeedRate::Unit::MmPerS ? "MMPM" : "MMPR"; }

bool sameShape(const Cutter& a, const Cutter& b) {
    return a.diameter_mm == b.diameter_mm && a.corner_radius_mm == b.corner_radius_mm &&
           a.corner_e_mm == b.corner_e_mm && a.corner_f_mm == b.corner_f_mm && a.point_angle_rad == b.point_angle_rad &&
           a.taper_angle_rad == b.taper_angle_rad && a.cutting_height_mm == b.cutting_height_mm;
}

}  // namespace

struct ClWriter::State {
    State(std::ostream& stream, const ClWriterOptions& options) : out(&stream), nx(options.dialect == Dialect::Nx) {
        text = fmt::format("$$ CL file written by cusp {}\n$$ CUSP DIALECT {}\nUNITS/MM\n", base::version(),
                           nx ? "NX" : "APT");
        if (!nx) {
            text += "MULTAX\n";  // a GOTO with three values keeps the axis
        }
    }

    // --- text ---
    void put(double value) {
        if (!std::isfinite(value)) {
            refuse("a number is not finite");
            return;
        }
        text += base::formatShortest(value);
    }
    void put(std::string_view word) { text += word; }
    void put(const Vector3& v) { list({v.x(), v.y(), v.z()}); }
    void list(std::initializer_list<double> values) {
        const char* separator = "";
        for (const double value : values) {
            text += separator;
            put(value);
            separator = ",";
        }
    }
    template <class... Parts>
    void line(const Parts&... parts) {
        (put(parts), ...);
        text += '\n';
    }
    void refuse(const std::string& message) {
        if (!std::exchange(refused, true)) {
            report.error("cl.not-writable", message, {{}, record_line, 0, {}});
        }
    }
    /// Text that stands in one line and comes back as it is; `forbidden` has a meaning where it stands.
    void checkText(std::string_view value, std::string_view forbidden) {
        if (detail::trimmed(value) != value || value.find_first_of(std::string("\n\0", 2)) != std::string_view::npos ||
            value.find_first_of(forbidden) != std::string_view::npos) {
            refuse(fmt::format("the text '{}' cannot stand in a CL file: blanks at its ends, a line end{}", value,
                               forbidden.empty() ? "" : fmt::format(", or one of {}", forbidden)));
        }
    }

    // --- records ---
    void write(const ClRecord& record);
    void writeHeader(const std::string& tool);
    void writePose(const CutterLocation& location);
    void writeFrame(std::string_view mark, const RigidTransform& frame);
    void writeCutter(const Cutter& cutter);

    void take(const LinearMotion& motion) {
        if (motion.kind == MotionKind::Rapid) {
            line("RAPID");
        }
        writePose(motion.location);
    }
    void take(const HoleLocation& hole) { writePose(hole.location); }
    void take(const ArcMotion& arc);
    void take(const StartPosition& start) {
        line("FROM/", start.location.tip_mm, ",", start.location.axis);
        axis = start.location.axis;
    }
    void take(const HomeReturn&) { line("GOHOME"); }
    void take(const FeedRate& feed) {
        if (nx) {
            line("FEDRAT/", feedWord(feed), ",", writtenFeed(feed));
        } else {
            line("FEDRAT/", writtenFeed(feed), ",", feedWord(feed));
        }
    }
    void take(const SpindleCommand& command);
    void take(const CoolantCommand& command) {
        constexpr std::array<const char*, 4> kinds{"OFF", "FLOOD", "MIST", "THRU"};
        line("COOLNT/", kinds.at(static_cast<std::size_t>(command.kind)));
    }
    void take(const ToolCall& call);
    void take(const OperationStart& operation) {
        if (nx) {
            checkText(operation.name, "$");
            held_operation = operation.name;  // its statement names the tool: that of the call which may follow
        } else {
            checkText(operation.name, {});
            line("$$ CUSP OPERATION ", operation.name);
        }
    }
    void take(const ProgrammingFrame& frame) {
        const RigidTransform& t = frame.part_from_programming;
        if (nx) {
            line("MSYS/", Vector3(t.translation()), ",", Vector3(t.linear().col(0)), ",", Vector3(t.linear().col(1)));
        } else {
            writeFrame("$$ CUSP FRAME", t);
        }
    }
    void take(const WorkPlane& plane) { writeFrame("$$ CUSP PLANE", plane.programming_from_plane); }
    void take(const Remark& remark) {
        constexpr std::array<const char*, 3> words{"PARTNO/", "PPRINT/", "INSERT/"};
        checkText(remark.text, {});
        line(words.at(static_cast<std::size_t>(remark.kind)), remark.text);
    }
    void take(const ProgramStop& stop) { line(stop.optional ? "OPSTOP" : "STOP"); }
    void take(const Dwell& dwell) { line("DELAY/", dwell.seconds); }
    void take(const CycleStart& cycle);
    void take(const CycleEnd&) { line("CYCLE/OFF"); }
    void take(const SplineMotion&) { refuse("a NURBS curve cannot be written: what its numbers mean is not known"); }
    void take(const PathTolerance& tolerance) { line(tolerance.outside ? "OUTTOL/" : "INTOL/", tolerance.value_mm); }
    void take(const CutterCompensation& command) {
        constexpr std::array<const char*, 3> sides{"OFF", "LEFT", "RIGHT"};
        line("CUTCOM/", sides.at(static_cast<std::size_t>(command.side)),
             command.offset_number ? fmt::format(",{}", *command.offset_number) : std::string());
    }
    void take(const ProgramEnd&) {
        if (nx && std::exchange(operation_open, false)) {
            line("END-OF-PATH");
        }
        line("FINI");
    }

    std::ostream* out;
    bool nx;
    std::string text;
    base::Diagnostics report;
    bool refused = false;
    std::uint32_t record_line = 0;
    Vector3 axis = Vector3::UnitZ();  ///< that a GOTO with three values has
    Cutter cutter;                    ///< of the last tool, for NX's CIRCLE
    std::string tool_name;
    std::optional<std::string> held_operation;
    bool operation_open = false;
};

void ClWriter::State::write(const ClRecord& record) {
    constexpr std::size_t piece = 64 * 1024;
    record_line = record.line;
    refused = false;
    if (held_operation) {
        const auto* call = std::get_if<ToolCall>(&record.statement);
        writeHeader(call == nullptr ? tool_name : call->name);
    }
    const std::size_t before = text.size();
    std::visit([this](const auto& statement) { take(statement); }, record.statement);
    if (refused) {
        text.resize(before);
        held_operation.reset();
    }
    if (text.size() >= piece) {
        out->write(text.data(), static_cast<std::streamsize>(text.size()));
        text.clear();
    }
}

void ClWriter::State::writeHeader(const std::string& tool) {
    if (operation_open) {
        line("END-OF-PATH");
    }
    const std::size_t before = text.size();
    checkText(tool, "$");
    line("TOOL PATH/", *held_operation, ",TOOL,", tool);
    held_operation.reset();
    operation_open = true;
    if (refused) {
        text.resize(before);
    }
}

void ClWriter::State::writePose(const CutterLocation& location) {
    put("GOTO/");
    put(location.tip_mm);
    if (location.axis != axis) {
        put(",");
        put(location.axis);
        axis = location.axis;
    }
    put("\n");
}

void ClWriter::State::take(const ArcMotion& arc) {
    // Behind NX's radius: two tolerances, which the record does not have, tool diameter and corner radius.
    put("CIRCLE/");
    put(arc.center_mm);
    put(",");
    put(nx ? Vector3(-arc.normal) : arc.normal);
    put(",");
    put(arc.radius_mm);
    if (nx) {
        put(",0,0,");
        list({cutter.diameter_mm, cutter.corner_radius_mm});
    }
    put("\n");
    writePose(arc.end);
}

void ClWriter::State::take(const SpindleCommand& command) {
    using Turn = SpindleCommand::Turn;
    const char* const unit = command.unit == SpindleCommand::Unit::Rpm ? "RPM" : "SMM";
    if (command.turn == Turn::Off) {
        if (command.speed) {
            refuse("the spindle cannot be off and have a speed");
        }
        line("SPINDL/OFF,", unit);
        return;
    }
    const std::string speed = command.speed ? base::formatShortest(*command.speed) : std::string("ON");
    const char* const turn = command.turn == Turn::Clockwise ? "CLW" : "CCLW";
    if (nx) {
        line("SPINDL/", unit, ",", speed, ",", turn);
    } else {
        line("SPINDL/", speed, ",", unit, ",", turn);
    }
}

void ClWriter::State::writeCutter(const Cutter& c) {
    const double point_deg = degreesFor(c.point_angle_rad);
    const double taper_deg = degreesFor(c.taper_angle_rad);
    const Cutter mill = detail::millShape(c.diameter_mm, c.corner_radius_mm, c.cutting_height_mm,
                                          base::radFromDeg(taper_deg), base::radFromDeg(point_deg));
    if (nx && sameShape(mill, c)) {
        put("TLDATA/MILL,");
        list({c.diameter_mm, c.corner_radius_mm, c.cutting_height_mm, taper_deg, point_deg});
    } else {
        put("CUTTER/");
        list({c.diameter_mm, c.corner_radius_mm, c.corner_e_mm, c.corner_f_mm, point_deg, taper_deg,
              c.cutting_height_mm});
    }
    put("\n");
}

void ClWriter::State::take(const ToolCall& call) {
    checkText(call.name, ",$");
    if (nx && call.number == 0) {
        refuse("NX has no tool number 0: it writes 0 for a tool without a number");
    } else if (!nx && !call.number) {
        refuse("plain APT cannot call a tool without a number");
    }
    if (!nx) {
        line("TOOLNO/", std::to_string(call.number.value_or(0)));
    }
    line("TPRINT/", call.name);
    if (call.cutter) {
        writeCutter(*call.cutter);
    }
    line(nx ? "LOAD/TOOL," : "LOADTL/", std::to_string(call.number.value_or(0)));
    if (!refused) {
        tool_name = call.name;
        cutter = call.cutter.value_or(Cutter{});
    }
}

/// Three rows of R | t in comments.
void ClWriter::State::writeFrame(std::string_view mark, const RigidTransform& frame) {
    line(mark);
    for (int row = 0; row < 3; ++row) {
        line("$$ ", frame.linear()(row, 0), " ", frame.linear()(row, 1), " ", frame.linear()(row, 2), " ",
             frame.translation()[row]);
    }
}

void ClWriter::State::take(const CycleStart& cycle) {
    constexpr std::array<const char*, 5> nx_kinds{"DRILL", "DRILL,DEEP", "DRILL,BRKCHP", "BORE", "TAP"};
    constexpr std::array<const char*, 5> kinds{"DRILL", "DEEP", "BRKCHP", "BORE", "TAP"};
    const auto kind = static_cast<std::size_t>(cycle.kind);
    const auto optional = [this](const char* word, const std::optional<double>& value) {
        if (value) {
            put(word);
            put(*value);
        }
    };
    put("CYCLE/");
    put(nx ? nx_kinds.at(kind) : kinds.at(kind));
    put(",FEDTO,");
    put(nx ? -cycle.depth_mm : cycle.depth_mm);
    optional(",CLEAR,", cycle.clearance_mm);
    optional(",RTRCTO,", cycle.retract_mm);
    if (cycle.feed) {
        put(",");
        put(feedWord(*cycle.feed));
        put(",");
        put(writtenFeed(*cycle.feed));
    }
    optional(",1STPECK,", cycle.first_peck_mm);
    optional(",STEP,", cycle.peck_mm);
    optional(",DWELL,", cycle.dwell_s);
    put("\n");
}

ClWriter::ClWriter(std::ostream& out, const ClWriterOptions& options) : state_(std::make_unique<State>(out, options)) {}
ClWriter::~ClWriter() = default;
ClWriter::ClWriter(ClWriter&&) noexcept = default;
ClWriter& ClWriter::operator=(ClWriter&&) noexcept = default;

void ClWriter::write(const ClRecord& record) { state_->write(record); }

void ClWriter::finish() {
    if (state_->held_operation) {
        state_->writeHeader(state_->tool_name);
    }
    state_->out->write(state_->text.data(), static_cast<std::streamsize>(state_->text.size()));
    state_->text.clear();
}

const base::Diagnostics& ClWriter::report() const { return state_->report; }

base::Result<std::string> clText(const ToolPath& path) {
    std::ostringstream out;
    ClWriter writer(out, {path.dialect});
    for (const ClRecord& record : path.records) {
        writer.write(record);
    }
    writer.finish();
    if (writer.report().hasErrors()) {
        return base::fail(writer.report());
    }
    return out.str();
}

}  // namespace cusp::toolpath
