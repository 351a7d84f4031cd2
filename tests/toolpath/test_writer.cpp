// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The CL writer against the reader: random tool paths come back as they were, and a second writing changes nothing.
#include "cl_text.hpp"

#include <cusp/base/random.hpp>
#include <cusp/base/units.hpp>
#include <cusp/base/version.hpp>
#include <cusp/toolpath/cl_writer.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>
#include <sstream>

namespace cusp::toolpath::test {
namespace {

using geometry::Vector3;

/// Makes tool paths such as a reader hands out: nothing that no CL file can say.
class RandomPath {
public:
    explicit RandomPath(std::uint64_t seed) : random_(seed) {}

    std::vector<ClRecord> make(std::size_t length) {
        add(CoolantCommand{CoolantCommand::Kind::Off});
        go();
        while (records_.size() < length) {
            step();
        }
        if (std::exchange(cycle_on_, false)) {
            add(CycleEnd{});
        }
        add(ProgramEnd{});
        return std::move(records_);
    }

private:
    void add(ClStatement statement) { records_.push_back({std::move(statement), 0}); }
    /// Few digits, many digits, tiny, huge.
    double number(double size) {
        const double value = random_.uniform(-size, size);
        switch (random_.below(4)) {
            case 0: return std::round(value) + 0.0;  // no -0, which is written as 0
            case 1: return std::round(value * 1e4) / 1e4 + 0.0;
            case 2: return value * 1e-9;
            default: return value;
        }
    }
    double positive(double size) { return std::abs(number(size)) + 0.5; }
    Vector3 direction() {
        if (random_.chance(0.3)) {
            return Vector3::Unit(static_cast<Eigen::Index>(random_.below(3)));
        }
        return Vector3(random_.normal(), random_.normal(), random_.normal()).normalized();
    }
    Vector3 point() { return {number(1e4), number(1e4), number(1e4)}; }
    std::optional<double> maybe(double value) { return random_.chance(0.5) ? std::optional(value) : std::nullopt; }
    std::string text() {
        constexpr const char* texts[] = {"MILL_10", "a b  c", "Öl, 5 µm", "x/y=1", "T'1' (2)", ""};
        return texts[random_.below(std::size(texts))];
    }
    std::string toolName() {
        constexpr const char* names[] = {"MILL_10", "T1 End Mill D 10", "Fräser", "A/B", ""};
        return names[random_.below(std::size(names))];
    }
    geometry::RigidTransform frame() {
        geometry::RigidTransform t = geometry::RigidTransform::Identity();
        const Vector3 x = direction();
        const Vector3 y = x.unitOrthogonal().normalized();
        t.linear().col(0) = x;
        t.linear().col(1) = y;
        t.linear().col(2) = x.cross(y);
        t.translation() = point();
        return t;
    }
    /// As the reader computes it, from mm or inch a minute or a revolution.
    FeedRate feed() {
        const double written = positive(5000.0) * (random_.chance(0.5) ? base::mm_per_inch : 1.0);
        return random_.chance(0.5) ? FeedRate{base::mmPerSFromMmPerMin(written), FeedRate::Unit::MmPerS}
                                   : FeedRate{written, FeedRate::Unit::MmPerRev};
    }
    void go() {
        location_ = {point(), random_.chance(0.3) ? direction() : location_.axis};
        add(LinearMotion{location_, random_.chance(0.3) ? MotionKind::Rapid : MotionKind::Feed});
        at_tip_ = true;
    }
    void arc() {
        ArcMotion arc;
        arc.normal = direction();
        arc.radius_mm = positive(100.0);
        const Vector3 outward = arc.normal.unitOrthogonal();
        arc.center_mm = location_.tip_mm - arc.radius_mm * outward;
        arc.full_circle = random_.chance(0.3);
        const double sweep = arc.full_circle ? 0.0 : random_.uniform(0.05, 2.0 * std::numbers::pi - 0.05);
        arc.end.tip_mm = arc.full_circle
                             ? location_.tip_mm
                             : Vector3(arc.center_mm + arc.radius_mm * (std::cos(sweep) * outward +
                                                                        std::sin(sweep) * arc.normal.cross(outward)));
        if (random_.chance(0.3)) {
            arc.end.tip_mm += number(10.0) * arc.normal;
        }
        arc.end.axis = location_.axis;
        location_ = arc.end;
        add(arc);
    }
    void cycle() {
        CycleStart cycle;
        cycle.kind = static_cast<CycleStart::Kind>(random_.below(5));
        cycle.depth_mm = positive(100.0);
        cycle.clearance_mm = maybe(positive(5.0));
        cycle.retract_mm = maybe(cycle.clearance_mm.value_or(0.0) + positive(50.0));
        if (random_.chance(0.5)) {
            cycle.feed = feed();
        }
        if (cycle.kind == CycleStart::Kind::Deep || cycle.kind == CycleStart::Kind::BreakChip) {
            cycle.first_peck_mm = maybe(positive(5.0));
            cycle.peck_mm = positive(5.0);
        }
        cycle.dwell_s = maybe(positive(3.0));
        add(cycle);
        cycle_on_ = true;
        for (std::uint64_t i = random_.below(4); i > 0; --i) {
            location_ = {point(), location_.axis};
            add(HoleLocation{location_});
            at_tip_ = false;
        }
        if (random_.chance(0.8)) {
            add(CycleEnd{});
            cycle_on_ = false;
        }
    }
    void spindle() {
        SpindleCommand command;
        command.turn = static_cast<SpindleCommand::Turn>(random_.below(3));
        command.unit = static_cast<SpindleCommand::Unit>(random_.below(2));
        if (command.turn != SpindleCommand::Turn::Off) {
            command.speed = maybe(positive(20000.0));
        }
        add(command);
    }
    void tool() {
        ToolCall call{random_.integer(1, 99), toolName(), std::nullopt};
        if (random_.chance(0.8)) {
            geometry::Cutter cutter;
            cutter.diameter_mm = positive(50.0);
            cutter.corner_radius_mm = positive(5.0);
            cutter.corner_e_mm = number(10.0);
            cutter.corner_f_mm = number(10.0);
            cutter.point_angle_rad = base::radFromDeg(number(80.0));
            cutter.taper_angle_rad = base::radFromDeg(number(80.0));
            cutter.cutting_height_mm = positive(100.0);
            call.cutter = cutter;
        }
        add(call);
    }
    void compensation() {
        using Side = CutterCompensation::Side;
        compensated_ = !compensated_;
        CutterCompensation command;
        if (compensated_) {
            command.side = random_.chance(0.5) ? Side::Left : Side::Right;
            command.offset_number = random_.chance(0.5) ? std::optional(random_.integer(0, 99)) : std::nullopt;
        }
        add(command);
    }
    void step() {
        switch (random_.below(cycle_on_ ? 15 : 19)) {
            case 0: add(feed()); break;
            case 1: spindle(); break;
            case 2: add(CoolantCommand{static_cast<CoolantCommand::Kind>(random_.below(4))}); break;
            case 3: tool(); break;
            case 4: add(OperationStart{text()}); break;
            case 5: add(ProgrammingFrame{frame()}); break;
            case 6: add(WorkPlane{frame()}); break;
            case 7: add(Remark{static_cast<Remark::Kind>(random_.below(3)), text() + "$"}); break;
            case 8: add(ProgramStop{random_.chance(0.5)}); break;
            case 9: add(Dwell{std::abs(number(100.0))}); break;
            case 10: compensation(); break;
            case 11:
                location_ = {point(), direction()};
                add(StartPosition{location_});
                at_tip_ = true;
                break;
            case 12: cycle(); break;
            case 13:
                add(HomeReturn{});
                at_tip_ = false;
                break;
            case 14: add(PathTolerance{random_.chance(0.5), std::abs(number(0.1))}); break;
            default:
                if (at_tip_ && random_.chance(0.5)) {
                    arc();
                } else {
                    go();
                }
                break;
        }
    }

    base::Random random_;
    std::vector<ClRecord> records_;
    CutterLocation location_;
    bool at_tip_ = false;
    bool cycle_on_ = false;
    bool compensated_ = false;
};

/// Without lines: a second file numbers them otherwise.
std::vector<std::string> statementsOf(const std::vector<ClRecord>& records) {
    std::vector<std::string> texts;
    for (const ClRecord& record : records) {
        texts.push_back(textOf(ClRecord{record.statement, 0}));
        const auto* call = std::get_if<ToolCall>(&record.statement);
        if (call != nullptr && call->cutter) {
            const geometry::Cutter& c = *call->cutter;
            texts.back() +=
                fmt::format(" {} {} {} {}", c.corner_e_mm, c.corner_f_mm, c.point_angle_rad, c.taper_angle_rad);
        }
    }
    return texts;
}

std::string written(const std::vector<ClRecord>& records, Dialect dialect) {
    const base::Result<std::string> text = clText({"", dialect, 1.0, records});
    EXPECT_TRUE(text.has_value()) << base::toText(text.error());
    return text.value_or("");
}

class WriterDialects : public testing::TestWithParam<Dialect> {};

TEST_P(WriterDialects, RandomPathsComeBackAsTheyWere) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const std::vector<ClRecord> records = RandomPath(seed).make(100);
        const std::string text = written(records, GetParam());
        const ReadOut out = readOut(text);
        ASSERT_EQ(out.problems, "") << "seed " << seed << "\n" << text;
        ASSERT_EQ(out.dialect, GetParam()) << "seed " << seed;
        const std::vector<std::string> before = statementsOf(records);
        const std::vector<std::string> after = statementsOf(out.records);
        for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
            ASSERT_EQ(after[i], before[i]) << "seed " << seed << " record " << i;
        }
        ASSERT_EQ(after.size(), before.size()) << "seed " << seed;
        ASSERT_EQ(written(out.records, GetParam()), text) << "seed " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(, WriterDialects, testing::Values(Dialect::Nx, Dialect::Apt),
                         [](const auto& instance) { return std::string(dialectName(instance.param)); });

TEST(Writer, WritesWhatAnAptReaderKnows) {
    EXPECT_EQ(written({{ToolCall{7, "BALL", geometry::Cutter{10, 5, 0, 5, 0, 0, 40}}, 1},
                       {SpindleCommand{SpindleCommand::Turn::Clockwise, 8000.0, SpindleCommand::Unit::Rpm}, 2},
                       {FeedRate{base::mmPerSFromMmPerMin(1000.0), FeedRate::Unit::MmPerS}, 3},
                       {LinearMotion{{{0.1, 0, -2.5}, Vector3::UnitZ()}, MotionKind::Rapid}, 4},
                       {LinearMotion{{{1, 0, -2.5}, {0.6, 0, 0.8}}, MotionKind::Feed}, 5},
                       {LinearMotion{{{2, 0, -2.5}, {0.6, 0, 0.8}}, MotionKind::Feed}, 6},
                       {ProgramEnd{}, 7}},
                      Dialect::Apt),
              "$$ CL file written by cusp " + std::string(base::version()) +
                  "\n$$ CUSP DIALECT APT\nUNITS/MM\nMULTAX\nTOOLNO/7\nTPRINT/BALL\nCUTTER/10,5,0,5,0,0,40\nLOADTL/7\n"
                  "SPINDL/8000,RPM,CLW\nFEDRAT/1000,MMPM\nRAPID\nGOTO/0.1,0,-2.5\nGOTO/1,0,-2.5,0.6,0,0.8\n"
                  "GOTO/2,0,-2.5\nFINI\n");
}

TEST(Writer, WritesWhatAnNxReaderKnows) {
    EXPECT_EQ(written({{OperationStart{"FLOOR"}, 1},
                       {ToolCall{std::nullopt, "MILL", geometry::Cutter{10, 1, 4, 1, 0, 0, 40}}, 1},
                       {LinearMotion{{{2, 0, 0}, Vector3::UnitZ()}, MotionKind::Feed}, 4},
                       {ArcMotion{{{0, 2, 0}, Vector3::UnitZ()}, Vector3::Zero(), Vector3::UnitZ(), 2.0, false}, 5},
                       {OperationStart{"WALL"}, 7},
                       {ProgramEnd{}, 8}},
                      Dialect::Nx),
              "$$ CL file written by cusp " + std::string(base::version()) +
                  "\n$$ CUSP DIALECT NX\nUNITS/MM\nTOOL PATH/FLOOR,TOOL,MILL\nTPRINT/MILL\nTLDATA/MILL,10,1,40,0,0\n"
                  "LOAD/TOOL,0\nGOTO/2,0,0\nCIRCLE/0,0,0,0,0,-1,2,0,0,10,1\nGOTO/0,2,0\nEND-OF-PATH\n"
                  "TOOL PATH/WALL,TOOL,MILL\nEND-OF-PATH\nFINI\n");
}

TEST(Writer, RefusesWhatWouldNotComeBack) {
    const auto problem = [](ClStatement statement, Dialect dialect) {
        const base::Result<std::string> text = clText({"", dialect, 1.0, {{std::move(statement), 12}}});
        return text ? std::string("written") : base::toText(text.error());
    };
    EXPECT_EQ(problem(Remark{Remark::Kind::Message, "a\nGOTO/1,2,3"}, Dialect::Apt),
              "12: error: the text 'a\\x0aGOTO/1,2,3' cannot stand in a CL file: blanks at its ends, a line end "
              "[cl.not-writable]\n");
    EXPECT_EQ(problem(ToolCall{1, "a,b", std::nullopt}, Dialect::Apt),
              "12: error: the text 'a,b' cannot stand in a CL file: blanks at its ends, a line end, or one of ,$ "
              "[cl.not-writable]\n");
    EXPECT_EQ(problem(ToolCall{std::nullopt, "a", std::nullopt}, Dialect::Apt),
              "12: error: plain APT cannot call a tool without a number [cl.not-writable]\n");
    EXPECT_EQ(problem(ToolCall{0, "a", std::nullopt}, Dialect::Nx),
              "12: error: NX has no tool number 0: it writes 0 for a tool without a number [cl.not-writable]\n");
    EXPECT_EQ(problem(Dwell{std::numeric_limits<double>::quiet_NaN()}, Dialect::Nx),
              "12: error: a number is not finite [cl.not-writable]\n");
    EXPECT_EQ(problem(SpindleCommand{SpindleCommand::Turn::Off, 5.0, SpindleCommand::Unit::Rpm}, Dialect::Apt),
              "12: error: the spindle cannot be off and have a speed [cl.not-writable]\n");
}

TEST(Writer, FramesOfItsOwnAreCheckedLikeTheOthers) {
    EXPECT_EQ(problemsOf("$$ CUSP FRAME\n$$ 1 0 0 0\nGOTO/0,0,0"),
              "1: error: $$ CUSP FRAME is not followed by the three rows of its matrix [cl.frame]\n");
    EXPECT_EQ(problemsOf("$$ CUSP PLANE\n$$ 1 0 0 0\n$$ 0 1 0 0\n$$ 0 0 -1 0"),
              "1: error: $$ CUSP PLANE: the matrix is not a rotation with an origin [cl.frame]\n");
}

}  // namespace
}  // namespace cusp::toolpath::test
