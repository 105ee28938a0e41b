#include "app/cli/trace_compare_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "app/base/text.h"
#include "app/cli/trace_text.h"

namespace worldy {

namespace {

using Json = nlohmann::ordered_json;
using planet::TraceComparison;
using planet::TraceFrameDifference;
using planet::TraceSelectionTotals;

constexpr std::size_t idsInLine = 4;

std::string idsText(const std::optional<planet::TraceDescription>& description,
                    const std::vector<std::uint64_t>& ids, std::uint64_t count) {
    std::string text;
    for (std::size_t i = 0; i < std::min(ids.size(), idsInLine); ++i)
        text += fmt::format("{}{}", i == 0 ? "" : ", ", tracedNodeText(description, ids[i]));
    if (count > idsInLine) text += fmt::format(" and {} more", count - idsInLine);
    return text.empty() ? "nothing" : text;
}

void printSide(const char* side, const TraceSelectionTotals& totals) {
    fmt::print("{:>8}{:>9}{:>10.1f}{:>9}{:>12}{:>12}{:>9}{:>9}{:>10}{:>10}\n", side, totals.frames,
               totals.meanDrawn, totals.mostDrawn, countText(totals.meanTriangles),
               countText(static_cast<double>(totals.mostTriangles)), totals.splits, totals.merges,
               tracedPxText(totals.meanErrorPx), tracedPxText(totals.worstErrorPx));
}

void printTimes(const char* name, const planet::TraceSpread& a, const planet::TraceSpread& b) {
    if (a.count == 0 && b.count == 0) return;
    const auto text = [](const planet::TraceSpread& ms) {
        return ms.count == 0 ? std::string("not told")
                             : fmt::format("{}, 99 % at most {}", millisecondsText(ms.median),
                                           millisecondsText(ms.p99));
    };
    fmt::print("{:<10}A median {}; B median {}\n", name, text(a), text(b));
}

// Prints what the reports of the whole traces add: thrashes, faults and latencies.
void printWholes(const TraceCompared& compared) {
    const planet::TraceReport &a = compared.reportA, &b = compared.reportB;
    const auto thrashes = [](const planet::TraceReport& report) {
        std::uint64_t sum = 0;
        for (const planet::TraceViewReport& view : report.views) sum += view.thrashes;
        return sum;
    };
    fmt::print("{:<10}A {}; B {}\n", "faults", a.faults.size(), b.faults.size());
    fmt::print("{:<10}A {}; B {}\n", "thrashes", thrashes(a), thrashes(b));
    for (const auto& [side, report] : {std::pair("A", &a), std::pair("B", &b)})
        for (const planet::TraceKindReport& kind : report->kinds)
            if (kind.latencyS.count > 0)
                fmt::print("{:<10}{} {}: median {}, 99 % at most {}\n", "latency", side,
                           kind.name.empty() ? fmt::format("kind {}", kind.kind) : kind.name,
                           millisecondsText(1000 * kind.latencyS.median),
                           millisecondsText(1000 * kind.latencyS.p99));
}

void printDifference(const TraceComparison& found, const TraceFrameDifference& each) {
    fmt::print("  frame {}{}, view {}: A alone draws {}; B alone draws {}; {} and {} nodes, {} and {} px\n",
               each.frameA, each.frameB == each.frameA ? "" : fmt::format(" ({} of B)", each.frameB),
               each.view, idsText(found.descriptionA, each.nodesA, each.onlyInA),
               idsText(found.descriptionB, each.nodesB, each.onlyInB), each.drawnA, each.drawnB,
               tracedPxText(each.worstErrorPxA), tracedPxText(each.worstErrorPxB));
}

Json jsonOf(const planet::TraceSpread& spread) {
    return {{"count", spread.count},
            {"median", tracedNumberJson(spread.median)},
            {"p99", tracedNumberJson(spread.p99)},
            {"max", tracedNumberJson(spread.most)}};
}

Json idsJson(const std::optional<planet::TraceDescription>& description,
             const std::vector<std::uint64_t>& ids) {
    Json json = Json::array();
    for (const std::uint64_t id : ids) json.push_back(tracedNodeText(description, id));
    return json;
}

Json jsonOf(const TraceComparison& found, const TraceFrameDifference& each) {
    return {{"frame_a", each.frameA},
            {"frame_b", each.frameB},
            {"time_s", each.timeS},
            {"view", each.view},
            {"drawn_a", each.drawnA},
            {"drawn_b", each.drawnB},
            {"triangles_a", each.trianglesA},
            {"triangles_b", each.trianglesB},
            {"max_error_px_a", tracedNumberJson(each.worstErrorPxA)},
            {"max_error_px_b", tracedNumberJson(each.worstErrorPxB)},
            {"only_in_a", each.onlyInA},
            {"only_in_b", each.onlyInB},
            {"nodes_a", idsJson(found.descriptionA, each.nodesA)},
            {"nodes_b", idsJson(found.descriptionB, each.nodesB)}};
}

}  // namespace

void printTraceComparison(const TraceCompared& compared, int worst) {
    const TraceComparison& found = compared.found;
    fmt::print("A {}\nB {}\n{} frames are in both, {} only in A, {} only in B\n",
               compared.request.fileA.string(), compared.request.fileB.string(), found.frames,
               found.framesOnlyInA, found.framesOnlyInB);
    const bool byTime = found.match == planet::TraceMatch::Time;
    if (found.frames == 0)
        fmt::print("No frame has the same {} in both. --match {} matches frames by their {}.\n",
                   byTime ? "time" : "number", byTime ? "number" : "time", byTime ? "numbers" : "times");
    if (found.skippedFrames > 0)
        fmt::print("{} frames lack events in one of the two, and are not compared\n", found.skippedFrames);
    printTimes("CPU time", found.cpuMsA, found.cpuMsB);
    printTimes("GPU time", found.gpuMsA, found.gpuMsB);
    printWholes(compared);
    for (const planet::TraceViewComparison& view : found.views) {
        fmt::print("\n{:>8}{:>9}{:>10}{:>9}{:>12}{:>12}{:>9}{:>9}{:>10}{:>10}\n",
                   fmt::format("view {}", view.view), "frames", "drawn", "most", "triangles", "most",
                   "splits", "merges", "error px", "most");
        printSide("A", view.a);
        printSide("B", view.b);
        if (view.framesThatDiffer > 0)
            fmt::print("{} frames differ; over all frames, {} nodes are only in A and {} only in B\n",
                       view.framesThatDiffer, view.onlyInA, view.onlyInB);
    }
    if (found.framesThatDiffer == 0) {
        if (found.frames > found.skippedFrames)
            fmt::print("\nBoth draw the same nodes in all frames{}.\n",
                       found.framesOnlyInA + found.framesOnlyInB > 0 ? " that both have" : "");
        return;
    }
    fmt::print("\n{} of {} frames differ. The first one:\n", found.framesThatDiffer, found.frames);
    printDifference(found, found.differences.front());
    std::vector<const TraceFrameDifference*> largest;
    for (const TraceFrameDifference& each : found.differences) largest.push_back(&each);
    std::ranges::stable_sort(largest, std::greater(),
                             [](const auto* each) { return each->onlyInA + each->onlyInB; });
    largest.resize(std::min(largest.size(), static_cast<std::size_t>(worst)));
    if (found.differences.size() > 1 && !largest.empty())
        fmt::print("Those with the most different nodes:\n");
    if (found.differences.size() > 1)
        for (const TraceFrameDifference* each : largest) printDifference(found, *each);
}

Json traceComparisonJson(const TraceCompared& compared) {
    const TraceComparison& found = compared.found;
    Json json = {{"file_a", compared.request.fileA.string()},
                 {"file_b", compared.request.fileB.string()},
                 {"frames", found.frames},
                 {"frames_only_in_a", found.framesOnlyInA},
                 {"frames_only_in_b", found.framesOnlyInB},
                 {"skipped_frames", found.skippedFrames},
                 {"frames_that_differ", found.framesThatDiffer},
                 {"cpu_ms_a", jsonOf(found.cpuMsA)},
                 {"cpu_ms_b", jsonOf(found.cpuMsB)},
                 {"gpu_ms_a", jsonOf(found.gpuMsA)},
                 {"gpu_ms_b", jsonOf(found.gpuMsB)}};
    json["view"] = Json::array();
    for (const planet::TraceViewComparison& view : found.views)
        json["view"].push_back({{"view", view.view},
                                {"frames", view.frames},
                                {"frames_that_differ", view.framesThatDiffer},
                                {"only_in_a", view.onlyInA},
                                {"only_in_b", view.onlyInB},
                                {"a", traceTotalsJson(view.a, found.descriptionA)},
                                {"b", traceTotalsJson(view.b, found.descriptionB)}});
    json["difference"] = Json::array();
    for (const TraceFrameDifference& each : found.differences)
        json["difference"].push_back(jsonOf(found, each));
    json["unlisted_differences"] = found.unlistedDifferences;
    json["problem_a"] = found.problemA ? Json(*found.problemA) : Json(nullptr);
    json["problem_b"] = found.problemB ? Json(*found.problemB) : Json(nullptr);
    return json;
}

}  // namespace worldy
