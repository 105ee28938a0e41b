#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "planet/trace/lod_trace.h"
#include "tests/program/small_planet.h"
#include "tests/support/small_trace.h"

namespace worldy {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class TraceCommand : public testing::Test {
protected:
    TraceCommand() {
        std::ofstream(folder_.path() / "flight.toml")
            << "name = \"Down\"\n[[key]]\ntime_s = 0\nlatitude_deg = 0\nlongitude_deg = 0\naltitude_m = "
               "90000\n"
               "heading_deg = 0\npitch_deg = -60\n[[key]]\ntime_s = 4\nlatitude_deg = 10\nlongitude_deg = "
               "30\n"
               "altitude_m = 8000\nheading_deg = 0\npitch_deg = -30\n";
    }
    void fly() {
        bakePlanet(folder_);
        flown_ = runWorldy(folder_,
                           "fly planet.chk --flight flight.toml --frames 40 --size 320x200 --tau 1 --trace "
                           "down.lodtrace -o fly.json");
        ASSERT_EQ(flown_.exitCode, 0) << flown_.errors;
    }
    // Writes a trace with τ and without errors, times and paging.
    void writeBareTrace() const {
        std::array<char, 512> error{};
        lod_trace* const trace =
            lod_trace_open((folder_.path() / "bare.lodtrace").c_str(), nullptr, error.data(), error.size());
        ASSERT_NE(trace, nullptr) << error.data();
        lod_trace_setting(trace, LOD_TRACE_TAU, 2);
        for (int frame = 0; frame < 3; ++frame) {
            lod_trace_frame_begin(trace, frame);
            lod_trace_drawn(trace, 0, 7, 0);
            lod_trace_frame_end(trace, -1, -1);
        }
        lod_trace_close(trace);
    }
    json trace(const std::string& options = "") {
        const Ran ran = runWorldy(folder_, "trace down.lodtrace --json " + options);
        EXPECT_EQ(ran.exitCode, 0) << ran.errors;
        return json::parse(ran.output);
    }

    const TemporaryFolder folder_;
    Ran flown_;
};

TEST_F(TraceCommand, saysOfAFlightWhatTheFlightSaysItself) {
    fly();
    const json own = json::parse(contentOf(folder_.path() / "fly.json"));
    const json traced = trace();
    EXPECT_EQ(traced["schema_version"], 2);
    EXPECT_EQ(traced["frames"], 40);
    EXPECT_EQ(traced["name"], "Down");
    ASSERT_EQ(traced["view"].size(), 1u);
    EXPECT_EQ(traced["view"][0]["max_drawn"], own["summary"]["drawn_chunks"]["maximum"]);
    EXPECT_EQ(traced["view"][0]["max_error_px"], own["summary"]["worst_eps_px"]["maximum"]);
    EXPECT_EQ(traced["view"][0]["max_triangles"], own["summary"]["ground_triangles"]["maximum"]);
    EXPECT_EQ(traced["view"][0]["tau_px"], 1);
    EXPECT_EQ(traced["fault_counts"]["hole"], 0);
    EXPECT_EQ(traced["fault_counts"]["drawn twice"], 0);
    EXPECT_TRUE(traced["problem"].is_null());
    const Ran text = runWorldy(folder_, "trace down.lodtrace");
    EXPECT_EQ(text.exitCode, 0);
    EXPECT_THAT(text.output, HasSubstr("Down, 40 frames"));
}

TEST_F(TraceCommand, isACheckWithLimits) {
    fly();
    const Ran broken = runWorldy(folder_, "trace down.lodtrace --max-error-px 0.0001 --max-over-budget 100");
    EXPECT_EQ(broken.exitCode, 1);
    EXPECT_THAT(broken.errors, HasSubstr("expected at most 0.0001"));
    EXPECT_EQ(trace("--max-error-px 1000 --max-dropped 0")["broken_limits"].size(), 0u);
    const Ran wrong = runWorldy(folder_, "trace down.lodtrace --max-over-budget 101");
    EXPECT_EQ(wrong.exitCode, 2);
}

TEST_F(TraceCommand, readsWhatThereIsOfATraceThatIsCutOff) {
    fly();
    const fs::path file = folder_.path() / "down.lodtrace";
    fs::resize_file(file, fs::file_size(file) - 5);
    const Ran ran = runWorldy(folder_, "trace down.lodtrace");
    EXPECT_EQ(ran.exitCode, 0);
    EXPECT_THAT(ran.errors, HasSubstr("down.lodtrace: byte"));
}

TEST_F(TraceCommand, selectsAgainWithOtherTausAndSuggestsOne) {
    fly();
    const json found = trace("--what-if 0.5,1,4 --suggest error_px=2,bytes_mb=1000")["what_if"];
    ASSERT_EQ(found["view"].size(), 1u);
    const json& view = found["view"][0];
    ASSERT_EQ(view["selection"].size(), 3u);
    EXPECT_EQ(view["engine"]["frames"], 40);
    EXPECT_EQ(view["own_settings"]["totals"]["frames"], 40);
    EXPECT_LT(view["selection"][2]["totals"]["max_triangles"],
              view["selection"][1]["totals"]["max_triangles"]);
    EXPECT_LE(view["selection"][1]["totals"]["max_triangles"],
              view["selection"][0]["totals"]["max_triangles"]);
    EXPECT_EQ(view["selection"][2]["data"], "all");
    EXPECT_EQ(view["selection"][2]["on_front_of_bytes"], true);
    EXPECT_EQ(found["suggestion"]["met"], true);
    EXPECT_LE(found["suggestion"]["max_error_px"], 2);
    const Ran text =
        runWorldy(folder_, "trace down.lodtrace --what-if 2 --data disk --loaders 2 --budget-mb 8");
    EXPECT_EQ(text.exitCode, 0) << text.errors;
    EXPECT_THAT(text.output, HasSubstr("tau 2 px"));
    const json nearer = trace("--what-if 1 --metric sphere")["what_if"]["view"][0]["selection"][0];
    EXPECT_EQ(nearer["metric"], "sphere");
    EXPECT_GT(nearer["totals"]["mean_triangles"], view["selection"][1]["totals"]["mean_triangles"]);
    const Ran wrong = runWorldy(folder_, "trace down.lodtrace --suggest bytes=3");
    EXPECT_EQ(wrong.exitCode, 2);
    EXPECT_THAT(wrong.errors, HasSubstr("expected error_px=N, bytes_mb=N or triangles=N"));
    EXPECT_EQ(runWorldy(folder_, "trace down.lodtrace --what-if 0").exitCode, 2);
}

TEST_F(TraceCommand, withoutFadesWorldyDoesWhatItsOwnNumbersSay) {
    bakePlanet(folder_);
    const Ran flown =
        runWorldy(folder_,
                  "fly planet.chk --flight flight.toml --frames 40 --size 320x200 --tau 1 --set "
                  "lod.fade_s=0 --trace down.lodtrace -o fly.json");
    ASSERT_EQ(flown.exitCode, 0) << flown.errors;
    const json found = trace("--what-if 1 --max-disagreeing 0")["what_if"];
    EXPECT_EQ(found["view"][0]["own_settings"]["nodes_that_differ"], 0);
    EXPECT_EQ(found["view"][0]["own_settings"]["totals"]["max_triangles"],
              found["view"][0]["engine"]["max_triangles"]);
    EXPECT_TRUE(found["disagreement"].empty());
}

TEST_F(TraceCommand, comparesTwoTracesOfAFlight) {
    fly();
    const Ran again =
        runWorldy(folder_,
                  "fly planet.chk --flight flight.toml --frames 40 --size 320x200 --tau 4 --trace "
                  "coarse.lodtrace -o coarse.json");
    ASSERT_EQ(again.exitCode, 0) << again.errors;
    const Ran same = runWorldy(folder_, "trace down.lodtrace down.lodtrace --json --max-differing 0");
    EXPECT_EQ(same.exitCode, 0) << same.errors;
    EXPECT_EQ(json::parse(same.output)["frames_that_differ"], 0);
    EXPECT_TRUE(json::parse(same.output)["difference"].empty());
    const Ran other = runWorldy(folder_, "trace down.lodtrace coarse.lodtrace --json");
    EXPECT_EQ(other.exitCode, 0) << other.errors;
    const json found = json::parse(other.output);
    EXPECT_EQ(found["frames"], 40);
    EXPECT_GT(found["frames_that_differ"], 0);
    EXPECT_GT(found["view"][0]["a"]["max_triangles"], found["view"][0]["b"]["max_triangles"]);
    EXPECT_EQ(found["report_a"]["file"], "down.lodtrace");
    EXPECT_EQ(found["report_b"]["file"], "coarse.lodtrace");
    EXPECT_TRUE(found["report_b"]["view"][0].contains("thrashes"));
    EXPECT_GT(found["report_a"]["paging"][0]["latency_ms"]["count"],
              found["report_b"]["paging"][0]["latency_ms"]["count"]);
    const Ran limited = runWorldy(folder_, "trace down.lodtrace coarse.lodtrace --max-differing 0");
    EXPECT_EQ(limited.exitCode, 1);
    EXPECT_THAT(limited.errors, HasSubstr("expected at most 0"));
    EXPECT_THAT(limited.output, HasSubstr("B alone draws"));
    EXPECT_EQ(runWorldy(folder_, "trace down.lodtrace coarse.lodtrace --what-if 2").exitCode, 2);
    EXPECT_EQ(runWorldy(folder_, "trace down.lodtrace --max-differing 2").exitCode, 2);
}

TEST_F(TraceCommand, framesThatOnlyOneTraceHasDiffer) {
    test::writeSmallTrace(folder_.path() / "a.lodtrace");
    test::writeSmallTrace(folder_.path() / "b.lodtrace", 40);
    const auto compared = [&](const std::string& options) {
        return runWorldy(folder_, "trace " + options).exitCode;
    };
    EXPECT_EQ(compared("a.lodtrace b.lodtrace --max-differing 20"), 0);
    EXPECT_EQ(compared("a.lodtrace b.lodtrace --max-differing 19"), 1);
    EXPECT_EQ(compared("b.lodtrace a.lodtrace --max-differing 19"), 1);
}

TEST_F(TraceCommand, tracesWithoutACommonFrameDoNotAgree) {
    test::writeSmallTrace(folder_.path() / "a.lodtrace");
    test::writeSmallTrace(folder_.path() / "none.lodtrace", 0);
    for (const char* match : {"time", "number"}) {
        const Ran ran = runWorldy(
            folder_, fmt::format("trace a.lodtrace none.lodtrace --max-differing 1000 --match {}", match));
        EXPECT_EQ(ran.exitCode, 1);
        EXPECT_THAT(ran.errors, HasSubstr("cannot be checked: no frame could be compared"));
        EXPECT_THAT(ran.output, HasSubstr(fmt::format("No frame has the same {} in both", match)));
    }
    EXPECT_EQ(runWorldy(folder_, "trace a.lodtrace none.lodtrace").exitCode, 0);
}

// A check that nothing was measured for must not pass.
TEST_F(TraceCommand, limitsWithoutAValueDoNotHold) {
    test::writeSmallTrace(folder_.path() / "none.lodtrace", 0);
    const Ran empty = runWorldy(folder_, "trace none.lodtrace --max-faults 0 --max-dropped 0");
    EXPECT_EQ(empty.exitCode, 1);
    EXPECT_THAT(empty.errors, HasSubstr("the number of faults cannot be checked: the trace has no frame"));
    EXPECT_THAT(empty.errors, HasSubstr("the number of lost events cannot be checked"));
    EXPECT_EQ(runWorldy(folder_, "trace none.lodtrace").exitCode, 0);
    writeBareTrace();
    for (const auto& [option, why] :
         {std::pair{"--max-error-px 1e6", "no error of a drawn node is known"},
          std::pair{"--max-latency-ms 1e6", "no request arrived"},
          std::pair{"--max-over-budget 100", "the engine told no times"},
          std::pair{"--max-disagreeing 0", "no error of a drawn node is known"}}) {
        const Ran ran = runWorldy(folder_, std::string("trace bare.lodtrace ") + option);
        EXPECT_EQ(ran.exitCode, 1) << option;
        EXPECT_THAT(ran.errors, HasSubstr(std::string("cannot be checked: ") + why));
    }
    EXPECT_EQ(runWorldy(folder_, "trace bare.lodtrace --max-faults 0 --max-thrashes 0").exitCode, 0);
    const Ran judged = runWorldy(folder_, "trace bare.lodtrace --what-if 2");
    EXPECT_THAT(judged.output, HasSubstr("choice is not judged: no error of a drawn node is known"));
}

TEST_F(TraceCommand, refusesWhatIsNoTraceAndReplacesNothingElse) {
    bakePlanet(folder_);
    const Ran ran = runWorldy(folder_, "trace planet.chk");
    EXPECT_EQ(ran.exitCode, 2);
    EXPECT_THAT(ran.errors, HasSubstr("planet.chk"));
    EXPECT_EQ(runWorldy(folder_, "trace nothing.lodtrace").exitCode, 2);
    std::ofstream(folder_.path() / "notes.txt") << "mine";
    const Ran over = runWorldy(folder_, "fly planet.chk --flight flight.toml --frames 2 --trace notes.txt");
    EXPECT_EQ(over.exitCode, 2);
    EXPECT_THAT(over.errors, HasSubstr("notes.txt"));
    EXPECT_EQ(contentOf(folder_.path() / "notes.txt"), "mine");
}

}  // namespace
}  // namespace worldy
