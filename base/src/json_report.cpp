// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Building and checking JSON summaries.
#include <cusp/base/json_report.hpp>
#include <cusp/base/version.hpp>

#include <cmath>

namespace cusp::base {
namespace {

std::string_view severityText(Severity severity) {
    switch (severity) {
        case Severity::Error: return "error";
        case Severity::Warning: return "warning";
        case Severity::Note: return "note";
    }
    return "error";
}

void findNotFinite(const Json& value, const Json::json_pointer& here, Diagnostics& report) {
    if (value.is_number_float()) {
        if (!std::isfinite(value.get<double>()))
            report.error("json.not-finite", "this result is no finite number",
                         {.file = {}, .line = 0, .column = 0, .key = here.to_string()});
    } else if (value.is_object()) {
        for (const auto& [key, child] : value.items()) findNotFinite(child, here / key, report);
    } else if (value.is_array()) {
        for (std::size_t i = 0; i < value.size(); ++i) findNotFinite(value[i], here / i, report);
    }
}

}  // namespace

Json jsonReport(std::string_view command, std::int64_t schema) {
    Json out;
    out["schema"] = schema;
    out["command"] = std::string(command);
    out["version"] = std::string(version());
    return out;
}

Json diagnosticsToJson(const Diagnostics& diagnostics) {
    Json items = Json::array();
    for (const Diagnostic& diagnostic : diagnostics) {
        Json item;
        item["severity"] = std::string(severityText(diagnostic.severity));
        item["code"] = diagnostic.code;
        item["message"] = diagnostic.message;
        if (!diagnostic.where.file.empty()) item["file"] = diagnostic.where.file;
        if (diagnostic.where.line > 0) item["line"] = diagnostic.where.line;
        if (diagnostic.where.column > 0) item["column"] = diagnostic.where.column;
        if (!diagnostic.where.key.empty()) item["key"] = diagnostic.where.key;
        items.push_back(std::move(item));
    }
    Json out;
    out["errors"] = diagnostics.errorCount();
    out["warnings"] = diagnostics.warningCount();
    out["suppressed"] = diagnostics.suppressed();
    out["items"] = std::move(items);
    return out;
}

Result<std::string> jsonText(const Json& document) {
    Diagnostics report;
    findNotFinite(document, Json::json_pointer(), report);
    if (report.hasErrors()) return fail(std::move(report));
    return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace cusp::base
