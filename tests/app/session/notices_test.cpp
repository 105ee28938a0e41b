#include "app/session/notices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "app/editor/compare_controller.h"
#include "app/editor/sweep_controller.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class NoticesTest : public testing::Test {
protected:
    std::size_t logged(const std::string& text) {
        log_.moveNewLines(lines_);
        std::size_t count = 0;
        for (const LogLine& line : lines_) count += line.text.find(text) != std::string::npos;
        return count;
    }

    Log log_;
    std::deque<LogLine> lines_;
    Notices notices_{log_};
    Workspace workspace_;
};

TEST_F(NoticesTest, aFileThatCannotBeOpenedGetsAListOfAllThatCan) {
    const ui::Message message = openingFailed("x.bin", planet::badInput("x.bin: is unknown").value());
    for (const char* const ending : {".chk", ".toml", ".regions.toml", ".atlas", ".lodtrace", ".png"})
        EXPECT_THAT(message.advice, HasSubstr(ending));
}

TEST_F(NoticesTest, aSecondErrorIsAddedToAnOpenMessage) {
    tellError(notices_, {"The first failed", "no disk", ""});
    tellError(notices_, {"The second failed", "no memory", ""});
    EXPECT_EQ(notices_.message.title, "The first failed");
    EXPECT_EQ(notices_.message.text, "no disk\n\nThe second failed: no memory");
    tellError(notices_, {"The second failed", "no memory", ""});
    EXPECT_EQ(notices_.message.text, "no disk\n\nThe second failed: no memory") << "it is told twice";
}

TEST_F(NoticesTest, manyErrorsDoNotFillTheScreen) {
    for (int i = 0; i < 60; ++i)
        tellError(notices_, {"Failed", std::string(50, 'a') + std::to_string(i), ""});
    EXPECT_LT(notices_.message.text.size(), 2200u);
    EXPECT_EQ(logged("a59"), 1u);
}

TEST_F(NoticesTest, theProblemOfAHiddenPanelIsShownOnce) {
    const auto tell = [&](const std::string& problem) {
        tellOnce(notices_, workspace_, PanelId::Sweep, "The sweep has no result", problem);
    };
    workspace_.panels[static_cast<std::size_t>(PanelId::Sweep)].shown = false;
    tell("");
    EXPECT_EQ(notices_.message.title, "");
    tell("no disk");
    EXPECT_EQ(notices_.message.text, "no disk");
    notices_.message = {};
    tell("no disk");
    EXPECT_EQ(notices_.message.title, "") << "it is told twice";
    tell("");
    tell("no disk");
    EXPECT_EQ(notices_.message.text, "no disk") << "it has failed again";
}

TEST_F(NoticesTest, aPanelInSightTellsItsProblemItself) {
    workspace_.panels[static_cast<std::size_t>(PanelId::Sweep)].shown = true;
    workspace_
        .inFront[static_cast<std::size_t>(workspace_.panels[static_cast<std::size_t>(PanelId::Sweep)].dock)] =
        PanelId::Sweep;
    tellOnce(notices_, workspace_, PanelId::Sweep, "The sweep has no result", "no disk");
    EXPECT_EQ(notices_.message.title, "");
}

class Alerts : public NoticesTest {
protected:
    // Returns the texts of the alerts after the new lines of the log.
    std::vector<std::string> alerts() {
        const std::size_t count = log_.moveNewLines(lines_);
        alertOf(notices_, lines_, count);
        std::vector<std::string> texts;
        for (const ui::Alert& alert : notices_.alerts) texts.push_back(alert.text);
        return texts;
    }
};

TEST_F(Alerts, showWarningsAndErrorsThatNobodyTold) {
    log_.info("a planet is open");
    log_.warn("colours are unreadable");
    log_.error("no disk");
    EXPECT_THAT(alerts(), ElementsAre("colours are unreadable", "no disk"));
    EXPECT_EQ(notices_.alerts[0].level, LogLevel::Warning);
    EXPECT_EQ(notices_.alerts[1].level, LogLevel::Error);
    log_.info("an hour later");
    EXPECT_EQ(alerts().size(), 2u) << "old lines are shown again";
}

TEST_F(Alerts, doNotRepeatAMessageBox) {
    tellError(notices_, {"The first failed", "no disk", ""});
    EXPECT_THAT(alerts(), IsEmpty());
    workspace_.panels[static_cast<std::size_t>(PanelId::Sweep)].shown = false;
    log_.error("no chunk");
    tellOnce(notices_, workspace_, PanelId::Sweep, "The sweep has no result", "no chunk");
    EXPECT_THAT(alerts(), IsEmpty());
}

TEST_F(Alerts, aRepeatedProblemIsCountedAndStaysLonger) {
    log_.warn("Settings cannot be changed during a replay");
    alerts();
    const double firstUntilS = notices_.alerts[0].untilS;
    notices_.timeS += 3;
    log_.warn("Settings cannot be changed during a replay");
    log_.warn("Settings cannot be changed during a replay");
    EXPECT_EQ(alerts().size(), 1u);
    EXPECT_EQ(notices_.alerts[0].count, 3);
    EXPECT_DOUBLE_EQ(notices_.alerts[0].untilS, firstUntilS + 3);
}

class RestoredResults : public NoticesTest {
protected:
    KeptResults resultsOf(const std::filesystem::path& chunks) const {
        const MeasuredFile file = measuredFileOf(chunks);
        KeptResults kept;
        SweepTable table;
        table.flight = "andes";
        table.points.resize(2);
        kept.sweep = KeptSweep{table, {65}, {file}};
        kept.suggestions = KeptSuggestions{std::vector<SweepSuggestion>(1), {file}};
        kept.flight = KeptFlight{"andes, 12 sample frames.", {}, {file, file}};
        return kept;
    }

    tests::TemporaryFolder folder_;
    const std::filesystem::path chunks_ = folder_ / "a.chk";
    SweepController sweep_;
    ComparedFlight flight_;
};

TEST_F(RestoredResults, areShownAndKeptAgain) {
    std::ofstream(chunks_) << "chunks";
    const KeptResults kept = resultsOf(chunks_);
    restoreResults(sweep_, kept, log_);
    restoreResults(flight_, kept, log_);
    ASSERT_TRUE(sweep_.table && flight_.last);
    EXPECT_EQ(sweep_.table->points.size(), 2u);
    EXPECT_EQ(sweep_.swept.files.at(0).chunkSize, 65);
    EXPECT_EQ(sweep_.suggestions.size(), 1u);
    EXPECT_EQ(flight_.name, "andes, 12 sample frames.");
    EXPECT_EQ(sweep_.problem + flight_.problem, "");
    KeptResults again;
    keepResults(sweep_, again);
    keepResults(flight_, again);
    EXPECT_EQ(again.sweep->files, kept.sweep->files);
    EXPECT_EQ(again.sweep->chunkSizes, kept.sweep->chunkSizes);
    EXPECT_TRUE(again.suggestions && again.flight);
}

TEST_F(RestoredResults, ofAFileThatHasChangedAreLeftOutAndSaySo) {
    std::ofstream(chunks_) << "chunks";
    const KeptResults kept = resultsOf(chunks_);
    std::ofstream(chunks_) << "other chunks";
    restoreResults(sweep_, kept, log_);
    restoreResults(flight_, kept, log_);
    EXPECT_FALSE(sweep_.table || flight_.last);
    EXPECT_TRUE(sweep_.suggestions.empty());
    EXPECT_THAT(sweep_.problem, HasSubstr("a.chk has changed"));
    EXPECT_THAT(flight_.problem, HasSubstr("a.chk has changed; the comparison over a flight"));
    EXPECT_EQ(logged("a.chk has changed; the sweep of the last session is not shown"), 1u);
}

}  // namespace
}  // namespace worldy
