// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Draws a program and its CL path side by side; shared by the files that draw the different forms.
#pragma once

#include "drawn_program.hpp"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace cusp::post::verify::test {

inline constexpr double drawn_chord_error_mm = 0.0006;
inline constexpr int drawn_decimals = 5;

[[nodiscard]] inline double rounded(double value, int decimals = drawn_decimals) {
    const double unit = std::pow(10.0, decimals);
    return std::round(value * unit) / unit;
}
[[nodiscard]] inline Vector3d rounded(const Vector3d& v) { return {rounded(v.x()), rounded(v.y()), rounded(v.z())}; }

[[nodiscard]] inline NcWord word(const char* address) { return {address, std::nullopt, 0}; }
[[nodiscard]] inline NcWord number(std::string address, double value, int decimals = drawn_decimals) {
    return {std::move(address), value, decimals};
}
[[nodiscard]] inline NcWord code(double g) { return number("G", g, 0); }
[[nodiscard]] inline NcWord function(double m) { return number("M", m, 0); }

using Words = std::vector<NcWord>;

[[nodiscard]] inline Words operator+(Words a, const Words& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}
[[nodiscard]] inline Words xyz(const Vector3d& v) {
    return {number("X", v.x()), number("Y", v.y()), number("Z", v.z())};
}

class ProgramDrawer {
public:
    ProgramDrawer(Form form, base::Random& random, double tool_length_error_mm);
    [[nodiscard]] DrawnProgram draw();

private:
    struct Pose {
        Vector3d tip = Vector3d::Zero();
        double first_deg = 0.0;
        double second_deg = 0.0;
    };

    double uniform(double low, double high) { return random_.uniform(low, high); }
    int whole(int low, int high) { return static_cast<int>(random_.integer(low, high)); }
    NcBlock& block(Words words, bool link = false);
    void record(toolpath::ClStatement statement);
    void point(const Vector3d& tip, const Vector3d& axis, bool rapid = false);
    void chooseMachine();
    [[nodiscard]] Words rotary(double first_deg, double second_deg) const;
    void home();
    void operation(int index);
    void content();
    void chooseFeedCode();
    [[nodiscard]] Words feedWord(bool first, double length_mm);

    // five axes
    void fiveAxisMoves();
    [[nodiscard]] Vector3d axisOf(const Pose& pose) const;
    [[nodiscard]] Vector3d programmed(const Pose& pose, double tool_length_error_mm) const;
    [[nodiscard]] Pose onTheWay(const Pose& from, const Pose& to, double fraction) const;
    [[nodiscard]] double chordError(const Pose& from, const Pose& to, int pieces) const;
    void poseBlock(const Words& before, const Pose& pose, const Words& after);
    void cut(const Pose& from, const Pose& to, bool first);

    // the plane and frames
    void arcs();
    void arc(Vector3d& at);
    void holes();
    void chooseCycle(toolpath::CycleStart& cycle, NcBlock& call);
    void zigzag(const Eigen::Isometry3d& frame, const Vector3d& axis);
    void swivelled();
    void framed();

    base::Random& random_;
    double tool_length_error_mm_;
    double feed_ = 0.0;
    double rpm_ = 0.0;
    bool left_ = false;  ///< the spindle turns counter-clockwise
    int feed_code_ = 94;
    DrawnProgram out_;
};

}  // namespace cusp::post::verify::test
