#include "app/measure/kept_results.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// Results in which every figure has a value of its own.
KeptResults someResults() {
    KeptResults results;
    KeptSweep& sweep = results.sweep.emplace();
    sweep.table.flight = "andes \"low\"";
    sweep.table.request.flight = "/f/andes.toml";
    sweep.table.request.frames = 12;
    sweep.table.source = "/terrain/ü.tif";
    sweep.table.whole = true;
    sweep.chunkSizes = {17, 65};
    sweep.files = {{"/c/a.chk", 1000, -4'600'000'000'000'000'000}, {"/c/b.chk", 2000, 5}};
    SweepPoint point{.chunkSize = 65, .metric = planet::ErrorMetric::Tight, .tauPx = 1.0 / 3};
    point.figures = {12, 1.5, 2.5, 4, 5.25, 6, 7, 8, 9, 10, 11, 0.1, 13, 14, 15};
    sweep.table.points = {point, {.chunkSize = 17, .tauPx = 4}};
    SweepSuggestion suggestion;
    suggestion.metric = planet::ErrorMetric::Tight;
    suggestion.goal = {false, SweepCost::MemoryMiB, 64.5};
    suggestion.found = {1.75, 63.25, true, 7};
    results.suggestions = {{suggestion}, {{"/c/a.chk", 1000, 7}}};
    KeptFlight& flight = results.flight.emplace();
    flight.name = "andes, 12 sample frames.";
    flight.figures[0].triangles = 1e6;
    flight.figures[0].worstErrorPx = 1.0 / 7;
    flight.figures[1].late = 3;
    flight.files = {{"/c/a.chk", 1, 2}, {"/c/b.chk", 3, 4}};
    return results;
}

class KeptResultsFile : public testing::Test {
protected:
    planet::Result<KeptResults> loaded(const std::string& text) {
        std::ofstream(file_, std::ios::binary) << text;
        return loadKeptResults(file_);
    }
    std::string problemOf(const std::string& text) {
        const planet::Result<KeptResults> results = loaded(text);
        return results ? "no problem" : results.error().message;
    }
    // Returns the problem of the text of some results after a change of it.
    std::string problemAfter(const std::string& before, const std::string& after) {
        std::string text = keptResultsText(someResults());
        const std::size_t at = text.find(before);
        if (at == std::string::npos) return "no " + before;
        return problemOf(text.replace(at, before.size(), after));
    }

    tests::TemporaryFolder folder_;
    const std::filesystem::path file_ = folder_ / "results.toml";
};

TEST_F(KeptResultsFile, isReadAsItWasWritten) {
    const KeptResults written = someResults();
    const planet::Result<KeptResults> read = loaded(keptResultsText(written));
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_TRUE(read->sweep && read->suggestions && read->flight);
    EXPECT_EQ(read->sweep->table.points, written.sweep->table.points);
    EXPECT_EQ(read->sweep->table.flight, written.sweep->table.flight);
    EXPECT_EQ(read->sweep->table.source, written.sweep->table.source);
    EXPECT_TRUE(read->sweep->table.whole);
    EXPECT_EQ(read->sweep->table.request.frames, 12);
    EXPECT_EQ(read->sweep->files, written.sweep->files);
    EXPECT_EQ(read->sweep->chunkSizes, written.sweep->chunkSizes);
    const SweepSuggestion& suggestion = read->suggestions->found.at(0);
    EXPECT_EQ(suggestion.metric, planet::ErrorMetric::Tight);
    EXPECT_EQ(suggestion.goal.cost, SweepCost::MemoryMiB);
    EXPECT_EQ(suggestion.goal.limit, 64.5);
    EXPECT_EQ(suggestion.found.tauPx, 1.75);
    EXPECT_EQ(read->flight->figures, written.flight->figures);
    EXPECT_EQ(read->flight->name, written.flight->name);
    EXPECT_EQ(read->flight->files, written.flight->files);
    EXPECT_EQ(keptResultsText(*read), keptResultsText(written));
}

TEST_F(KeptResultsFile, isEmptyWithoutResults) {
    const planet::Result<KeptResults> none = loadKeptResults(file_);
    ASSERT_TRUE(none);
    EXPECT_FALSE(none->sweep || none->suggestions || none->flight);
    const planet::Result<KeptResults> empty = loaded(keptResultsText({}));
    ASSERT_TRUE(empty) << empty.error().message;
    EXPECT_FALSE(empty->sweep || empty->suggestions || empty->flight);
}

TEST_F(KeptResultsFile, isRefusedWithItsLineIfItIsWrong) {
    EXPECT_THAT(problemOf(""), AllOf(HasSubstr("results.toml"), HasSubstr("format is missing")));
    EXPECT_THAT(problemOf("format = 2\n"), AllOf(HasSubstr("results.toml: line 1"), HasSubstr("format")));
    EXPECT_THAT(problemOf("format = 1\nsweeps = 3\n"), AllOf(HasSubstr("line 2"), HasSubstr("unknown")));
    EXPECT_THAT(problemOf("format = 1\nsweep = 3\n"), AllOf(HasSubstr("line 2"), HasSubstr("a table")));
    EXPECT_THAT(problemOf("format = 1\n[sweep]\nflight = 'a'\n"), HasSubstr("flight_file is missing"));
    EXPECT_THAT(problemAfter("metric = \"tight\"", "metric = \"loose\""),
                HasSubstr("metric: loose; expected additive, tight"));
    EXPECT_THAT(problemAfter("error_px = 11", "error_px = -1"), HasSubstr("error_px"));
    EXPECT_THAT(problemAfter("error_px = 11", "error_px = nan"), HasSubstr("error_px"));
    EXPECT_THAT(problemAfter("chunk_size = 17", "chunk_size = 1000000"), HasSubstr("chunk_size"));
    EXPECT_THAT(problemAfter("bytes = 1000", "bytes = \"many\""), HasSubstr("bytes"));
    EXPECT_THAT(problemAfter("[comparison.b]", "[comparison.c]"), HasSubstr("b is missing"));
    EXPECT_THAT(problemOf(std::string(1 << 16, '[')), HasSubstr("results.toml"));
}

TEST_F(KeptResultsFile, readsNoCutFileButIsNeverHarmed) {
    const std::string text = keptResultsText(someResults());
    for (std::size_t bytes = 0; bytes < text.size(); bytes += 7) {
        const planet::Result<KeptResults> cut = loaded(text.substr(0, bytes));
        EXPECT_TRUE(cut || cut.error().message.find("results.toml") != std::string::npos) << bytes;
    }
    for (std::size_t at = 0; at < text.size(); at += 5) {
        std::string changed = text;
        changed[at] = static_cast<char>(changed[at] ^ 0x15);
        const planet::Result<KeptResults> read = loaded(changed);
        EXPECT_TRUE(read || read.error().message.find("results.toml") != std::string::npos) << at;
    }
}

TEST_F(KeptResultsFile, namesTheFirstMeasuredFileThatHasChanged) {
    const std::filesystem::path chunks = folder_ / "a.chk";
    std::ofstream(chunks) << "one";
    const std::vector<MeasuredFile> files = {measuredFileOf(chunks)};
    EXPECT_EQ(changedSince(files), "");
    std::ofstream(chunks) << "three";
    EXPECT_EQ(changedSince(files), chunks.string() + " has changed");
    std::ofstream(chunks) << "one";
    std::filesystem::last_write_time(chunks,
                                     std::filesystem::file_time_type::clock::now() + std::chrono::seconds(5));
    EXPECT_EQ(changedSince(files), chunks.string() + " has changed") << "of the same size";
    std::filesystem::remove(chunks);
    EXPECT_EQ(changedSince(files), chunks.string() + " is gone");
}

}  // namespace
}  // namespace worldy
