#include "app/report/session_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/planet_fixture.h"
#include "tests/support/temporary_folder.h"
#include "ui/model/figures.h"

namespace worldy {
namespace {

using testing::HasSubstr;
using testing::Not;
using tests::contentOf;

class SessionReport : public testing::Test {
protected:
    std::string report() const { return sessionReport(view_, settings_, facts_); }
    // Returns the part below a heading.
    std::string section(const std::string& heading) const {
        const std::string text = report();
        const std::size_t start = text.find("\n" + heading + "\n");
        if (start == std::string::npos) return "no " + heading;
        return text.substr(start + 1, text.find("\n#", start + heading.size()) - start);
    }

    std::unique_ptr<planet::Planet> planet_ = planet::openFake();
    FrameStats stats_;
    std::deque<ui::FrameSample> history_;
    planet::LodChanges changes_;
    std::deque<LogLine> log_;
    ui::EditorView view_{.planet = planet_.get(),
                         .frames = {.stats = stats_, .history = history_},
                         .log = log_,
                         .instruments = {.changes = changes_}};
    Settings settings_;
    ReportFacts facts_{.writtenAt = "2026-11-26 17:05",
                       .version = "0.1",
                       .openGl = "OpenGL 4.5",
                       .commandLine = "worldy shot x"};
};

TEST_F(SessionReport, whatWasNotMeasuredSaysSo) {
    for (const char* heading : {"### True error", "### Cracks", "### Pops", "### Precision", "### Ruler",
                                "### Costs of features", "### Sweep", "### Comparison"})
        EXPECT_THAT(section(heading), HasSubstr("Not measured.")) << heading;
    EXPECT_THAT(section("## Settings that differ from the defaults"),
                HasSubstr("All settings have their defaults."));
    EXPECT_THAT(section("## Notes"), HasSubstr("There are no notes"));
}

TEST_F(SessionReport, settingsThatDifferAreListedWithBothValues) {
    settings_.view.lod.tauPx = 3.25;
    const std::string text = section("## Settings that differ from the defaults");
    EXPECT_THAT(text, HasSubstr("lod.tau\\_px"));
    EXPECT_THAT(text, HasSubstr("| 3.25 |"));
}

TEST_F(SessionReport, figuresAreThoseOfThePanels) {
    CrackMeasurement measured;
    measured.required = {42.5, 0.75};
    measured.levelPairs = 17;
    const SmallestSkirts smallest{30, 0.021};
    view_.instruments.cracks = {&measured, false, &smallest};
    const std::string text = section("### Cracks");
    EXPECT_THAT(text, HasSubstr("Out of date"));
    for (const ui::Figure& figure : ui::crackFigures(measured))
        EXPECT_THAT(text, HasSubstr("| " + figure.name + " | " + figure.value + " |"));
    for (const ui::Figure& figure : ui::skirtFigures(measured, &smallest))
        EXPECT_THAT(text, HasSubstr("| " + figure.name + " | " + figure.value + " |"));
    EXPECT_THAT(text, HasSubstr("| Smallest factor | 0.021 |"));
}

TEST_F(SessionReport, theRulerIsToldWithItsProfile) {
    const double radiusM = planet_->tree().shape.radiusM;
    const std::vector<glm::dvec3> ends = {{radiusM, 0, 0}, {0, radiusM, 0}};
    view_.instruments.ruler.ends = ends;
    EXPECT_THAT(section("### Ruler"), HasSubstr("not measured yet"));
    MeasuredGround ground;
    for (int i = 0; i <= 512; ++i)  // rises from 100 m to 612 m, and is drawn 3 m too high but for the end
        ground.profile.points.push_back(
            {ends[0] / radiusM, 10.0 * i, 100.0 + i, i < 512 ? std::optional(103.0 + i) : std::nullopt});
    ground.summary.arcM = 5120;
    ground.summary.riseM = 512;
    ground.summary.slopeRad = std::atan(0.1);
    view_.instruments.ruler.measured = &ground;
    const std::string text = section("### Ruler");
    EXPECT_THAT(text, HasSubstr("Out of date"));
    EXPECT_THAT(text, HasSubstr("| Distance | 5120.00 m |"));
    EXPECT_THAT(text, HasSubstr("| Height difference | 512 m |"));
    EXPECT_THAT(text, HasSubstr("| Slope | 5.711° (10.000 %) |"));
    EXPECT_THAT(text, HasSubstr("| 100 m | 103 m |"));
    EXPECT_THAT(text, HasSubstr("| 612 m | - |"));
    view_.instruments.ruler.current = true;
    EXPECT_THAT(section("### Ruler"), Not(HasSubstr("Out of date")));
}

TEST_F(SessionReport, textsOfUsersCannotChangeItsLayout) {
    const std::vector<Note> notes = {{.id = 1, .text = "a | b\n# c <script>", .created = "2026-11-26 17:00"}};
    view_.notes.notes = notes;
    const std::string text = section("## Notes");
    EXPECT_THAT(text, HasSubstr("| a \\| b \\# c \\<script\\> | view |"));
}

TEST_F(SessionReport, onlyUsedAndOwnBookmarksAreListed) {
    const std::vector<ui::Bookmark> bookmarks = {
        {"Andes", {}, true}, {"Himalaya", {}, true}, {"mine", {}, false}};
    view_.camera.bookmarks = bookmarks;
    facts_.usedBookmarks = {"Himalaya"};
    const std::string text = section("### Bookmarks");
    EXPECT_THAT(text, Not(HasSubstr("Andes")));
    EXPECT_THAT(text, HasSubstr("| Himalaya |"));
    EXPECT_THAT(text, HasSubstr("| mine |"));
}

TEST_F(SessionReport, liesWithItsPicturesInANewFolder) {
    const tests::TemporaryFolder folder;
    const Picture picture{2, 1, {1, 2, 3, 4, 5, 6}};
    const auto first = writeSessionReport(folder.path(), report(), picture, picture);
    const auto second = writeSessionReport(folder.path(), "other", Picture(), picture);
    ASSERT_TRUE(first && second);
    EXPECT_NE(*first, *second);
    EXPECT_EQ(contentOf(*first / "report.md"), report());
    for (const char* name : {"planet.png", "window.png"}) {
        EXPECT_THAT(report(), HasSubstr(name));
        EXPECT_TRUE(std::filesystem::exists(*first / name));
        EXPECT_TRUE(std::filesystem::exists(*second / name));
    }
}

TEST_F(SessionReport, withoutAFolderNothingIsLeft) {
    const tests::TemporaryFolder folder;
    EXPECT_FALSE(writeSessionReport(folder / "none", "text", Picture(), Picture{1, 1, {1, 2, 3}}));
    EXPECT_EQ(tests::fileCountIn(folder.path()), 0u);
}

}  // namespace
}  // namespace worldy
