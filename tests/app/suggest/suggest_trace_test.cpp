// Tests that a suggestion for a trace calls unknown what the trace does not tell.
#include "app/suggest/suggest_trace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/suggest/suggest_budget.h"

namespace worldy {
namespace {

using testing::HasSubstr;

SuggestedForTrace suggestedFor(std::uint64_t triangles, std::uint64_t bytes) {
    SuggestedForTrace suggested;
    suggested.budget = suggestBudgetFromText("3 px").value();
    suggested.found.tauPx = 2.5;
    suggested.found.isMet = true;
    suggested.found.errorPx = 2.75;
    suggested.found.triangles = suggested.engineTriangles = triangles;
    suggested.found.bytes = suggested.engineBytes = bytes;
    suggested.engineErrorPx = 1.5;
    return suggested;
}

TEST(SuggestTrace, valuesThatTheTraceDoesNotTellAreNoNumbers) {
    const SuggestedForTrace suggested = suggestedFor(0, 0);
    EXPECT_THAT(traceMarkdown(suggested, "a.lodtrace"),
                HasSubstr("| Triangles | none | not told | not told |"));
    const nlohmann::ordered_json json = traceSuggestJson(suggested, "a.lodtrace");
    for (const char* side : {"engine", "suggested"}) {
        EXPECT_TRUE(json[side]["triangles"].is_null());
        EXPECT_TRUE(json[side]["resident_bytes"].is_null());
    }
    EXPECT_EQ(json["engine"]["error_px"], 1.5);
    EXPECT_EQ(json["suggested"]["error_px"], 2.75);
}

TEST(SuggestTrace, valuesThatTheTraceTellsAreReported) {
    const SuggestedForTrace suggested = suggestedFor(1200, 3 << 20);
    EXPECT_THAT(traceMarkdown(suggested, "a.lodtrace"),
                HasSubstr("| Triangles | none | 1200 triangles | 1200 triangles |"));
    const nlohmann::ordered_json json = traceSuggestJson(suggested, "a.lodtrace");
    EXPECT_EQ(json["engine"]["triangles"], 1200);
    EXPECT_EQ(json["suggested"]["resident_bytes"], 3 << 20);
}

}  // namespace
}  // namespace worldy
