// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Tells the formats of measured points apart and calls the reader of each.
#include <cusp/inspect/point_reader.hpp>

#include "compressed.hpp"
#include "points/formats.hpp"
#include "points/point_text.hpp"

#include <fmt/format.h>

namespace cusp::inspect {
namespace {

constexpr std::size_t head_bytes = std::size_t{1} << 16U;

bool contains(const std::string& text, std::string_view word) { return text.find(word) != std::string::npos; }

/// By what only this format has in its first lines.
std::string formatOf(std::string_view head) {
    const std::string text = lowered(head);
    const std::string_view begin = trimmed(std::string_view(text).substr(0, 200));
    if (text.starts_with("ply\n") || text.starts_with("ply\r")) return "ply";
    if (contains(text, "\nfields ") && contains(text, "\ndata ")) return "pcd";
    if (begin.starts_with('<')) return contains(text, "qifdocument") ? "qif" : "xml";
    if (contains(text, "actl/") || contains(text, "theo/") || (contains(text, "dim ") && contains(text, "outtol")))
        return "pc-dmis";
    if (contains(text, "=feat/") || contains(text, "ptdata/") || contains(text, "dmismn/") ||
        begin.starts_with("filnam/"))
        return "dmis";
    if (begin.starts_with("planid\t")) return "calypso";
    return "table";
}

/// Text has no NUL, but for UTF-16, which is a common export and a common puzzle.
bool isBinary(std::string_view head) { return head.find('\0') != std::string_view::npos; }

}  // namespace

base::Result<MeasuredPoints> readMeasuredPoints(std::istream& in, const std::string& name,
                                                const PointReaderOptions& options, base::Diagnostics& report) {
    ByteSource source(in, options.block_bytes);
    PointCollector out(name, options, report);
    const std::string_view head = source.peek(head_bytes);
    const std::string format = options.format.empty() ? formatOf(head) : options.format;
    const bool may_be_binary = format == "ply" || format == "pcd";
    if (!may_be_binary && (head.starts_with("\xff\xfe") || head.starts_with("\xfe\xff")))
        out.error("points.format", "the file is UTF-16 text; save it as UTF-8 or plain text");
    else if (const std::string_view packed = compressionOf(head); !packed.empty())
        out.error("points.format", fmt::format("the file is compressed ({}); unpack it first", packed));
    else if (!may_be_binary && isBinary(head))
        out.error("points.format", "the file is neither text nor a PLY or PCD cloud");
    else if (format == "table")
        readTable(source, options, out);
    else if (format == "dmis")
        readDmis(source, out);
    else if (format == "pc-dmis")
        readPcDmis(source, out);
    else if (format == "calypso")
        readCalypso(source, options, out);
    else if (format == "pcd")
        readPcd(source, out);
    else if (format == "ply")
        readPly(source, out);
    else if (format == "qif")
        readQifPoints(source, out);
    else
        out.error("points.format", fmt::format("the format {} holds no points that are read here", inQuotes(format)));
    return out.finish();
}

}  // namespace cusp::inspect
