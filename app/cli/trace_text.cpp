#include "app/cli/trace_text.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace worldy {

namespace {

using Json = nlohmann::ordered_json;

}  // namespace

std::string tracedNodeText(const std::optional<planet::TraceDescription>& description, std::uint64_t id) {
    return planet::traceIdText(description.value_or(planet::TraceDescription{}), id);
}

std::string tracedPxText(double px) {
    if (!std::isfinite(px)) return "-";
    return px < 1e5 ? fmt::format("{:.2f}", px) : fmt::format("{:.2e}", px);
}

Json tracedNumberJson(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json traceTotalsJson(const planet::TraceSelectionTotals& totals,
                     const std::optional<planet::TraceDescription>& description) {
    Json json = {{"frames", totals.frames},
                 {"mean_drawn", totals.meanDrawn},
                 {"max_drawn", totals.mostDrawn},
                 {"mean_triangles", totals.meanTriangles},
                 {"max_triangles", totals.mostTriangles},
                 {"mean_bytes", totals.meanBytes},
                 {"max_bytes", totals.mostBytes},
                 {"splits", totals.splits},
                 {"merges", totals.merges},
                 {"mean_error_px", tracedNumberJson(totals.meanErrorPx)},
                 {"max_error_px", tracedNumberJson(totals.worstErrorPx)}};
    if (std::isfinite(totals.worstErrorPx)) {
        json["max_error_frame"] = totals.worstFrame;
        json["max_error_node"] = tracedNodeText(description, totals.worstNode);
    }
    json["unknown_nodes"] = totals.unknown;
    json["unknown_frames"] = totals.unknownFrames;
    json["waiting_nodes"] = totals.waiting;
    json["limited_nodes"] = totals.limited;
    return json;
}

}  // namespace worldy
