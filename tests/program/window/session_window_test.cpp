// A start without a file goes on with the last session.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/program/small_planet.h"
#include "tests/program/window/editor_window.h"
#include "tests/support/small_trace.h"

namespace worldy {
namespace {

using testing::HasSubstr;

class SessionWindowTest : public PlanetWindowFixture {
protected:
    Ran drive(const std::string& arguments, const std::string& steps) {
        Ran ran = runInWindow(folder, arguments, steps);
        expectQuiet(ran);
        return ran;
    }
};

TEST_F(SessionWindowTest, aStartWithoutAFileShowsTheLastPlanetFromTheLastCamera) {
    drive("planet.chk", R"sh(
first=$(counter camera); point viewport/picture 0.6 0.4
for i in 1 2 3 4 5 6; do xdotool click 4; done; frames 20; settle
[ "$(counter camera)" != "$first" ] || echo "the camera does not move"
counter camera >last_camera
key ctrl+shift+6; click "compare/Snapshot as B"; expect counts compared -eq 1
)sh");
    drive("", R"sh(
case "$(counter file)" in */planet.chk) ;; *) false ;; esac || echo "$(counter file) is shown"
rounded() { tr , "\n" | xargs printf "%.3f " | sed "s,-\(0\.000\),\1,g"; }
is_there() { [ "$(counter camera | rounded)" = "$(rounded <last_camera)" ]; }
expect is_there || echo "the camera is at $(counter camera), not at $(cat last_camera)"
expect counts compared -eq 1
)sh");
}

TEST_F(SessionWindowTest, tracesAreComparedAgain) {
    test::writeSmallTrace(folder / "flight.lodtrace");
    test::writeSmallTrace(folder / "later.lodtrace", test::smallTraceFrames,
                          {.rootFrame = 50, .rootFrames = 5});
    drive("planet.chk", R"sh(
key ctrl+o; enter open/Path flight.lodtrace; until_true shown trace/Timeline || echo "there is no trace"
click "trace/Compare with..."; enter open/Path later.lodtrace
until_true says "Compared 60 frames, 5 differ" || echo "the traces are not compared"
)sh");
    drive("", R"sh(
until_true says "Compared 60 frames, 5 differ" || echo "the comparison is forgotten"
)sh");
}

TEST_F(SessionWindowTest, theBakeOfTheLastSessionIsShownAgain) {
    drive("hills.pgm", R"sh(
tab Bake; choose "bake/Chunk size" "17 vertices"; click bake/Bake; expect counts chunk_size -eq 17; settle
)sh");
    drive("", R"sh(
expect counts chunk_size -eq 17; hidden message/Text || echo "a message is shown"
)sh");
}

// The planet that comes with Worldy is baked instead, which these steps do not wait for.
TEST_F(SessionWindowTest, aLastSessionThatCannotBeOpenedIsReportedAndKept) {
    const std::filesystem::path file = folder.path() / "config" / "worldy" / "session.toml";
    std::filesystem::create_directories(file.parent_path());
    const auto report = [&](const std::string& text) {
        std::ofstream(file) << text;
        const Ran ran =
            runShell(folder, "'" WORLDY_BINARY
                             "' & worldy=$!; for i in $(seq 600); do "
                             "grep -q 'last session' .stderr && break; sleep 0.1; done; kill -9 $worldy");
        EXPECT_EQ(contentOf(file), text);
        return ran.errors;
    };
    EXPECT_THAT(report("file = 'gone.chk'\n"),
                AllOf(HasSubstr("gone.chk"), HasSubstr("the planet of the last session is not opened")));
    EXPECT_THAT(report("file = 3\n"),
                AllOf(HasSubstr("session.toml: line 1"), HasSubstr("the last session is not opened")));
}

// A first look at the planet that comes with Worldy stands in for it.
TEST_F(SessionWindowTest, aPlanetThatIsAwayIsTriedAgainAtTheNextStart) {
    const std::filesystem::path file = folder.path() / "config" / "worldy" / "session.toml";
    std::filesystem::create_directories(file.parent_path());
    const std::string text = "file = 'away.chk'\nruler = ['46.4,6.9,410']\n";
    std::ofstream(file) << text;
    drive("", R"sh(
expect shown message/Text; key Escape
patience=600; expect counts triangles -gt 0; settle
)sh");
    EXPECT_EQ(contentOf(file), text);
}

}  // namespace
}  // namespace worldy
