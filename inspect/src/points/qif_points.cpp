// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Measured points of a QIF document: its point sets, or the locations of its point features.
#include "points/formats.hpp"

#include <cusp/inspect/qif_results.hpp>

#include <algorithm>
#include <array>
#include <istream>
#include <streambuf>

namespace cusp::inspect {

namespace {

/// The rest of a source as a stream.
class SourceBuffer : public std::streambuf {
public:
    explicit SourceBuffer(ByteSource& source) : source_(source) {}

protected:
    int_type underflow() override {
        std::string_view bytes = source_.peek(block_.size());
        if (bytes.empty() || !source_.take(bytes.size(), bytes)) return traits_type::eof();
        std::copy(bytes.begin(), bytes.end(), block_.begin());
        setg(block_.data(), block_.data(), block_.data() + bytes.size());
        return traits_type::to_int_type(block_[0]);
    }

private:
    ByteSource& source_;
    std::array<char, std::size_t{1} << 16U> block_{};
};

}  // namespace

void readQifPoints(ByteSource& source, PointCollector& out) {
    out.format("qif");
    SourceBuffer buffer(source);
    std::istream in(&buffer);
    base::Diagnostics warnings;
    const auto results = readQif(in, "", warnings);
    // What is peculiar about tolerances does not concern who wants the points.
    for (const base::Diagnostic& item : warnings)
        if (item.code != "qif.tolerance") out.warning(item.code, item.message, item.where.line);
    if (!results) {
        for (const base::Diagnostic& item : results.error()) out.error(item.code, item.message, item.where.line);
        return;
    }
    const MeasuredPoints& points = results->points;
    if (points.unit_stated) out.unit(points.mm_per_unit);
    if (points.kind) out.kind(*points.kind);
    if (points.probe_radius_mm) out.probeRadius(*points.probe_radius_mm);
    for (std::size_t i = 0; i < points.size(); ++i) {
        // The collector makes millimetres of what is in the file's unit.
        out.add(points.lines[i], points.positions[i] / points.mm_per_unit);
        if (!points.directions.empty()) out.direction(points.directions[i]);
    }
}

}  // namespace cusp::inspect
