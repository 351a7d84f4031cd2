// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A chart of few lines, drawn pixel by pixel.
#include "convergence_chart.hpp"

#include "picture.hpp"

#include <cusp/base/number_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace cusp::bench {
namespace {

using cli::Rgb;

constexpr int width = 900;
constexpr int height = 520;
constexpr int left = 60;
constexpr int right = 20;
constexpr int top = 20;
constexpr int bottom = 40;
constexpr Rgb ground{255, 255, 255};
constexpr Rgb grid{220, 224, 228};
constexpr Rgb ink{60, 66, 74};
constexpr Rgb band{188, 215, 245};
constexpr Rgb thin{120, 165, 215};
constexpr Rgb line{20, 90, 170};
constexpr Rgb grey{165, 170, 176};

class Chart {
public:
    explicit Chart(double last) : last_(std::max(1.0, last)), pixels_(std::size_t{width} * height, ground) {}

    [[nodiscard]] int column(double x) const {
        return left + static_cast<int>(std::lround(x / last_ * (width - left - right)));
    }
    [[nodiscard]] static int row(double y) {
        return height - bottom - static_cast<int>(std::lround(y * (height - top - bottom)));
    }
    void dot(int x, int y, Rgb color) {
        if (x >= 0 && x < width && y >= 0 && y < height)
            pixels_[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] = color;
    }
    void stroke(int x0, int y0, int x1, int y1, Rgb color, int thickness) {
        const int steps = std::max({1, std::abs(x1 - x0), std::abs(y1 - y0)});
        for (int i = 0; i <= steps; ++i)
            for (int dx = 0; dx < thickness; ++dx)
                for (int dy = 0; dy < thickness; ++dy)
                    dot(x0 + (x1 - x0) * i / steps + dx, y0 + (y1 - y0) * i / steps + dy, color);
    }
    void number(int value, int tenths, int x, int y) {
        std::string text = std::to_string(value);
        if (tenths >= 0) text += "." + std::to_string(tenths);
        for (const char c : text) {
            glyph(c, x, y);
            x += c == '.' ? 6 : 12;
        }
    }
    [[nodiscard]] std::string png() const { return cli::pngOf(pixels_, width, height); }

private:
    /// Three by five squares of three pixels, rows from the top.
    void glyph(char c, int x, int y) {
        static constexpr std::array<std::array<int, 5>, 10> digits{{{7, 5, 5, 5, 7},
                                                                    {2, 6, 2, 2, 7},
                                                                    {7, 1, 7, 4, 7},
                                                                    {7, 1, 7, 1, 7},
                                                                    {5, 5, 7, 1, 1},
                                                                    {7, 4, 7, 1, 7},
                                                                    {7, 4, 7, 5, 7},
                                                                    {7, 1, 1, 1, 1},
                                                                    {7, 5, 7, 5, 7},
                                                                    {7, 5, 7, 1, 7}}};
        constexpr int size = 3;
        const auto square = [&](int column, int line_of) {
            for (int i = 0; i < size * size; ++i) dot(x + column * size + i % size, y + line_of * size + i / size, ink);
        };
        if (c == '.') return square(0, 4);
        const auto& rows = digits[static_cast<std::size_t>(c - '0')];
        for (int r = 0; r < 5; ++r)
            for (int k = 0; k < 3; ++k)
                if ((rows[static_cast<std::size_t>(r)] & (4 >> k)) != 0) square(k, r);
    }

    double last_;
    std::vector<Rgb> pixels_;
};

void drawFrame(Chart& chart, std::size_t generations) {
    for (int tenths = 0; tenths <= 10; tenths += 2) {
        const int y = Chart::row(tenths / 10.0);
        chart.stroke(left, y, width - right, y, grid, 1);
        chart.number(tenths / 10, tenths % 10, 12, y - 7);
    }
    const std::size_t step = generations > 25 ? 10 : generations > 12 ? 5 : 1;
    for (std::size_t g = 0; g < generations; g += step) {
        const int x = chart.column(static_cast<double>(g));
        chart.stroke(x, top, x, height - bottom, grid, 1);
        chart.number(static_cast<int>(g), -1, x - 6, height - bottom + 12);
    }
}

}  // namespace

std::vector<GenerationSpread> spreadOf(const std::vector<tilt::TiltOutcome>& runs) {
    std::vector<GenerationSpread> out;
    for (const tilt::TiltOutcome& run : runs) {
        bool free = false;
        for (const tilt::TiltGeneration& one : run.history) {
            if (one.points != 1) break;
            if (one.generation >= out.size()) out.resize(one.generation + 1);
            GenerationSpread& at = out[one.generation];
            free = free || one.free > 0;
            ++at.runs;
            at.free_runs += free ? 1 : 0;
            at.best_mean += one.best;
            at.best_deviation += one.best * one.best;
            at.best_least = std::min(at.best_least, one.best);
            at.best_most = std::max(at.best_most, one.best);
            at.mean_mean += one.mean;
            at.worst_mean += one.worst;
        }
    }
    for (GenerationSpread& at : out) {
        const auto n = static_cast<double>(std::max<std::size_t>(1, at.runs));
        const double squares = at.best_deviation;
        at.best_mean /= n;
        at.mean_mean /= n;
        at.worst_mean /= n;
        at.best_deviation =
            n > 1.0 ? std::sqrt(std::max(0.0, (squares - n * at.best_mean * at.best_mean) / (n - 1.0))) : 0.0;
    }
    return out;
}

std::string csvOf(const std::vector<GenerationSpread>& spread) {
    std::string out = "generation,runs,free_runs,best_mean,best_deviation,best_least,best_most,mean_mean,worst_mean\n";
    for (std::size_t g = 0; g < spread.size(); ++g) {
        const GenerationSpread& at = spread[g];
        out += std::to_string(g) + "," + std::to_string(at.runs) + "," + std::to_string(at.free_runs);
        for (const double value :
             {at.best_mean, at.best_deviation, at.best_least, at.best_most, at.mean_mean, at.worst_mean})
            out += "," + base::formatShortest(value);
        out += "\n";
    }
    return out;
}

std::string pngOf(const std::vector<GenerationSpread>& spread) {
    Chart chart(static_cast<double>(spread.size()) - 1.0);
    for (int x = left; x <= width - right && spread.size() > 1; ++x) {
        const double g =
            static_cast<double>(x - left) / (width - left - right) * static_cast<double>(spread.size() - 1);
        const auto before = std::min(static_cast<std::size_t>(g), spread.size() - 2);
        const double share = g - static_cast<double>(before);
        const auto edge = [&](double sign) {
            const auto at = [&](std::size_t i) { return spread[i].best_mean + sign * spread[i].best_deviation; };
            return Chart::row(std::clamp(std::lerp(at(before), at(before + 1), share), 0.0, 1.0));
        };
        chart.stroke(x, edge(1.0), x, edge(-1.0), band, 1);
    }
    drawFrame(chart, spread.size());
    const auto curve = [&](double GenerationSpread::* value, Rgb color, int thickness) {
        for (std::size_t g = 1; g < spread.size(); ++g)
            chart.stroke(chart.column(static_cast<double>(g - 1)), Chart::row(spread[g - 1].*value),
                         chart.column(static_cast<double>(g)), Chart::row(spread[g].*value), color, thickness);
    };
    curve(&GenerationSpread::worst_mean, grey, 1);
    curve(&GenerationSpread::mean_mean, grey, 2);
    curve(&GenerationSpread::best_least, thin, 1);
    curve(&GenerationSpread::best_most, thin, 1);
    curve(&GenerationSpread::best_mean, line, 3);
    return chart.png();
}

}  // namespace cusp::bench
