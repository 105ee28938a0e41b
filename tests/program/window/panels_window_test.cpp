// Each panel of the window, driven by its own controls: what they change is seen in the picture, in what is
// counted, or in the settings that are kept.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "app/base/picture_file.h"
#include "app/settings/screenshot.h"
#include "tests/program/small_planet.h"
#include "tests/program/window/editor_window.h"

namespace worldy {
namespace {

using testing::HasSubstr;

class PanelsWindowTest : public PlanetWindowFixture {
protected:
    // Steps print what is wrong.
    Ran drive(const std::string& steps, const Screen& screen = {}) {
        Ran ran = runInWindow(folder, "planet.chk", steps, screen);
        expectQuiet(ran);
        return ran;
    }
};

TEST_F(PanelsWindowTest, EveryPanelOpensAndHidesByItsKeyAndFromTheViewMenu) {
    drive(R"sh(
hidden tab/Presets || echo "Presets is shown at first"
key ctrl+p; expect shown tab/Presets
while read -r title keys item; do
    tab $title; expect shown "$item"
    key $keys; expect hidden tab/$title; expect hidden "$item"
    key $keys; expect shown tab/$title; expect shown "$item"
done <<'END'
LOD ctrl+1 lod/Hysteresis
Quadtree ctrl+2 quadtree/Net
Paging ctrl+3 paging/Budget
Overlay ctrl+4 overlay/Colour by
Chunk ctrl+5 chunk/Id
Seams ctrl+6 seams/Seams
Surface ctrl+7 surface/Colour
Bake ctrl+8 bake/Source
Frame ctrl+9 frame/Pause
Camera ctrl+0 camera/Mode
Presets ctrl+p presets/Name
Log ctrl+l log/Filter
END
# Another set of panels has the same digits with Shift.
for panel in "True error:1" Cracks:2 Pops:3 Precision:4 Compare:6 Sweep:7; do
    title=${panel%:*}
    key ctrl+shift+${panel#*:}; expect shown "tab/$title"; shown tab/LOD || echo "$title hides LOD"
    key ctrl+shift+${panel#*:}; expect hidden "tab/$title"
done
tab LOD
key ctrl+6; expect shown seams/Seams
key ctrl+6; expect hidden tab/Seams
for title in Seams Frame Chunk; do
    shown tab/$title && { click menu/View && click "menu item/$title" && expect hidden tab/$title; }
    click menu/View && click "menu item/$title" && expect shown tab/$title
done
expect shown seams/Seams
click menu/View; expect shown "menu item/Log"; key Escape; expect hidden "menu item/Log"
key F11; expect hidden tab/LOD; hidden tab/Paging || echo "F11 leaves Paging"
key F11; expect shown tab/LOD
key ctrl+shift+7; expect shown tab/Sweep
key F11; expect hidden tab/Sweep; key F11; expect shown tab/Sweep || echo "F11 brings back other panels"
)sh");
}

TEST_F(PanelsWindowTest, LodControlsChangeWhatIsDrawnAndUndoTakesThemBack) {
    drive(R"sh(
tau="lod/Tolerance τ"
slide "$tau" 0; expect counts triangles -gt 20000; settle
fine=$(counter triangles); picture=$(viewport)
slide "$tau" 1; expect counts triangles -lt 5000; expect differs "$picture"
[ "$(counter deepest)" = 0 ] || echo "at the coarsest, level $(counter deepest) is drawn"
key ctrl+z; expect counts triangles -eq $fine; expect same "$picture"
key ctrl+shift+z; expect counts triangles -lt 5000
key ctrl+z; expect counts triangles -eq $fine

slide "lod/Max LOD level" 0; expect counts deepest -eq 0
point "lod/Max LOD level"; xdotool click 3; frames; click lod/reset; expect counts triangles -eq $fine
drawn=$(counter drawn)
click "lod/Horizon culling"; expect counts drawn -gt $drawn; key ctrl+z; expect counts drawn -eq $drawn

click "lod/Freeze"; near=$(counter camera)
point viewport/picture; for i in 1 2 3 4 5 6; do xdotool click 4; done; frames 20
[ "$(counter camera)" != "$near" ] || echo "the wheel does not move the camera"
counts drawn -eq $drawn || echo "frozen, but $(counter drawn) are drawn"
click "lod/Freeze"; settle; [ $(counter drawn) -ne $drawn ] || echo "it stays frozen"

point "$tau"; xdotool keydown ctrl; frames; xdotool click 1; frames; xdotool keyup ctrl; frames
type_over 5.25
)sh");
    EXPECT_THAT(settingsOf(folder), HasSubstr("tau_px = 5.25"));
}

TEST_F(PanelsWindowTest, SeamsChangeSkirts) {
    drive(R"sh(
slide "lod/Tolerance τ" 0.2; settle
skirts=$(counter triangles)
tab Seams
choose seams/Seams none; expect counts triangles -lt $skirts; none=$(counter triangles)
choose seams/Seams stitched; settle
counts triangles -lt $skirts || echo "stitched, there are $(counter triangles) triangles, with skirts $skirts"
choose seams/Seams skirts; expect counts triangles -eq $skirts; settle
plain=$(viewport)
click "seams/Highlight LOD seams"; expect differs "$plain"
click "seams/Highlight LOD seams"; expect same "$plain"
tab Overlay; choose overlay/Skirts "only skirts"; expect differs "$plain"; loud=$(viewport)
tab Seams; choose "seams/Skirt depth" fixed; slide seams/Depth 1; expect differs "$loud"
)sh");
}

TEST_F(PanelsWindowTest, AClickInTheQuadtreeSelectsAndTheChunkPanelTakesAnId) {
    drive(R"sh(
[ "$(counter selected)" = none ] || echo "$(counter selected) is selected at first"
is_selected() { [ "$(counter selected)" = "$1" ]; }
# The net is four faces wide and three high, as large as fits: the middle of +x is at 3/8, 1/2.
set -- $(place quadtree/Net)
share=$(awk -v w=$3 -v h=$4 'BEGIN {side = w / 4 < h / 3 ? w / 4 : h / 3; print 0.5 - side / 2 / w}')
click quadtree/Net $share 0.5
case "$(counter selected)" in x_pos/*) ;; *) echo "the net selects $(counter selected)";; esac
tab Chunk; enter chunk/Id z_pos/1/1/0; expect is_selected z_pos/1/1/0
enter chunk/Id z_pos/9/1/0; frames; is_selected z_pos/1/1/0 || echo "a wrong id selects $(counter selected)"
click chunk/Parent; expect is_selected z_pos/0/0/0
rests() { local was="$(counter camera)"; frames 3; [ "$was" = "$(counter camera)" ]; }
before=$(counter camera); click "chunk/Look at"; expect rests
[ "$(counter camera)" != "$before" ] || echo "Look at does not move the camera"
case "$(counter camera)" in 90,* | 89.*) ;; *) echo "Look at leads to $(counter camera)";; esac
key Escape; expect is_selected none
settle; click viewport/picture; expect is_selected z_pos/0/0/0
)sh");
}

TEST_F(PanelsWindowTest, PagingDropsHoldsAndFailsAsItIsTold) {
    // Most of the panel is in sight.
    writeWindowSettings(folder, "[window]\nbottom_height = 520\n");
    drive(R"sh(
slide "lod/Tolerance τ" 0; settle
all=$(counter resident); requested=$(counter requested); triangles=$(counter triangles)
[ $all -gt 100 ] || echo "$all chunks are resident"
click "paging/Evict all"; expect counts requested -gt $requested; settle
counts triangles -eq $triangles || echo "$(counter triangles) triangles come back, not $triangles"

click paging/Pause; click "paging/Evict all"
expect counts resident -eq 6; expect counts queued -gt 0
held=$(counter queued); frames 10
counts resident -eq 6 && counts queued -eq $held || echo "paused, but it loads"
loaded=$(counter loaded_heights)
click "paging/Load one"; expect counts loaded_heights -eq $((loaded + 1))
click paging/Pause; expect counts triangles -eq $triangles

slide "paging/Retry delay" 0; reach "paging/Retry delay" "paging/Read timing"; slide "paging/Failure rate" 1
reach "paging/Failure rate" "paging/Evict all" 4; click "paging/Evict all"; expect counts failed_for_good -gt 0; expect counts awaiting_retry -eq 0; settle
counts failed_heights -eq $((5 * $(counter failed_for_good))) || echo "$(counter failed_heights) reads failed in all"
counts resident -eq 6 || echo "on a disk that fails, $(counter resident) chunks are resident"
expect says 'injected read failure'
reach "paging/Retry delay" paging/Off; click paging/Off; expect hidden paging/Off; click "paging/Failed blocks"
reach "paging/Retry delay" "paging/Retry failed" 4; click "paging/Retry failed"
expect counts triangles -eq $triangles; expect counts failed_for_good -eq 0
)sh",
          usualScreen);
}

TEST_F(PanelsWindowTest, OverlayAndSurfaceChangeThePictureAndBack) {
    drive(R"sh(
plain=$(viewport)
tab Overlay
choose "overlay/Colour by" level; expect differs "$plain"; tinted=$(viewport)
choose overlay/Labels level; expect differs "$tinted"
choose overlay/Labels none; expect same "$tinted"
slide overlay/Opacity 0.3; expect differs "$tinted"; key ctrl+z
choose "overlay/Colour by" δc; expect differs "$tinted"
choose "overlay/Colour by" none; expect same "$plain"
for box in Outlines Bounds Wireframe; do
    click overlay/$box; expect differs "$plain"; click overlay/$box; expect same "$plain"
done

tab Surface
slide "surface/Sea level" 0.55; expect differs "$plain"
point "surface/Sea level"; xdotool click 3; frames; click surface/reset; expect same "$plain"
click surface/Grey; choose surface/Colour "height ramp"; expect differs "$plain"; grey=$(viewport)
click surface/Hypsometric; expect differs "$grey"
click surface/Built-in; choose surface/Colour image; expect same "$plain"
tab Light
click light/Lighting; expect differs "$plain"; click light/Lighting; expect same "$plain"
choose light/Sun "by date"; expect differs "$plain"; dated=$(viewport)
slide light/Hour 0.9; expect differs "$dated"
choose light/Sun fixed; expect differs "$dated"
choose light/Sun follow; expect same "$plain"
tab Surface
slide surface/Exaggeration 0.7; expect differs "$plain"
)sh");
    const std::string settings = settingsOf(folder);
    const std::size_t at = settings.find("exaggeration = ");
    ASSERT_NE(at, std::string::npos) << settings;
    EXPECT_GT(std::strtod(settings.c_str() + at + 15, nullptr), 4);
}

TEST_F(PanelsWindowTest, CameraFrameAndLogDoAsTheyAreTold) {
    drive(R"sh(
tab Camera; start=$(counter camera)
# A pose that was kept comes back but for rounding.
rounded() { echo "$1" | tr , "\n" | xargs printf "%.3f " | sed "s,-\(0\.000\),\1,g"; }
is_at() { [ "$(rounded "$(counter camera)")" = "$(rounded "$1")" ]; }
# It glides there.
rests() { local was="$(counter camera)"; frames 3; [ "$was" = "$(counter camera)" ]; }
click camera/Himalaya; expect rests; place=$(counter camera)
[ "$place" != "$start" ] || echo "a bookmark does not move the camera"
enter camera/Name "A place"; expect shown "camera/A place"
click camera/Andes; frames; ! is_at "$place" || echo "another bookmark does not move the camera"
click "camera/A place"; expect is_at "$place"
click camera/Reset; expect is_at "$start"
reach camera/Mode camera/View
choose camera/View split; expect shown observer/picture; settle
[ "$(picture observer/picture)" != "$(viewport)" ] || echo "the observer sees the same"
observed=$(picture observer/picture)
click camera/Frustum; frames; [ "$(picture observer/picture)" != "$observed" ] || echo "no frustum is drawn"
choose camera/View off; expect hidden observer/picture

# What is typed goes into the field that is active: none now.
tab Frame; click frame/Pause; before=$(counter camera)
xdotool keydown w; frames 6
[ "$(counter camera)" = "$before" ] || echo "paused, the camera moves"
click frame/Step; stepped=$(counter camera)
[ "$stepped" != "$before" ] || echo "a step does not move the camera"
frames 6; [ "$(counter camera)" = "$stepped" ] || echo "after a step it goes on"
xdotool keyup w; frames
# Paused, what moves the camera by name still does, and a second selection that was never made is not drawn.
key F3; expect is_at "$start"; expect counts triangles -gt 0
tab Camera; choose camera/View split; click "camera/Own LOD"; expect shown observer/picture
click "camera/Own LOD"; choose camera/View off; expect hidden observer/picture
tab Frame; stepped=$(counter camera); click frame/Pause
xdotool keydown w; frames 6; xdotool keyup w; [ "$(counter camera)" != "$stepped" ] || echo "it stays paused"

tab Log; expect shown "log/line 1"
enter log/Filter "no line holds this"; expect hidden "log/line 0"; hidden "log/line 1" || echo "a line passes"
enter log/Filter planet.chk; expect shown "log/line 1"
)sh");
    EXPECT_THAT(contentOf(folder.path() / "config" / "worldy" / "bookmarks.toml"), HasSubstr("A place"));
}

TEST_F(PanelsWindowTest, APresetBringsSettingsBack) {
    drive(R"sh(
slide "lod/Tolerance τ" 0; expect counts triangles -gt 20000; settle; fine=$(counter triangles)
key ctrl+p; enter presets/Name "My own"; expect shown "presets/My own"; expect says 'Preset saved: /.*/My own.toml'
tab LOD; slide "lod/Tolerance τ" 1; expect counts triangles -lt 5000
tab Presets; click "presets/My own"; click presets/Load; expect counts triangles -eq $fine
key ctrl+z; expect counts triangles -lt 5000
click presets/Load; expect counts triangles -eq $fine
click "presets/Reset all settings"; expect counts triangles -lt 10000
)sh");
    EXPECT_THAT(contentOf(folder.path() / "config" / "worldy" / "presets" / "My own.toml"),
                HasSubstr("tau_px = 0.1"));
}

double meanDifference(const Picture& a, const Picture& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(a.rgb[i] - b.rgb[i]);
    return sum / static_cast<double>(a.rgb.size());
}

std::vector<std::filesystem::path> screenshotsIn(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().filename().string().starts_with("worldy 2")) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
        return std::filesystem::last_write_time(a) < std::filesystem::last_write_time(b);
    });
    return files;
}

TEST_F(PanelsWindowTest, TheCopiedLineDrawsTheScreenshotsPicture) {
    const Ran ran = drive(R"sh(
slide "lod/Tolerance τ" 0; tab Surface; slide surface/Exaggeration 0.6
tab Camera; click "camera/Grand Canyon"; settle
key F12; expect times_said 'Screenshot: ' 1
key shift+F12; expect times_said 'Screenshot: ' 2
key ctrl+shift+c; expect says 'Copied: worldy shot '
)sh");
    const std::vector<std::filesystem::path> files = screenshotsIn(folder.path());
    ASSERT_EQ(files.size(), 2u) << ran.errors;
    const planet::Result<Picture> picture = readPicture(files[0]);
    const planet::Result<Picture> window = readPicture(files[1]);
    ASSERT_TRUE(picture && window);
    EXPECT_EQ(window->width, 800);
    EXPECT_EQ(window->height, 500);
    EXPECT_LT(picture->width, 600);

    const std::size_t at = ran.errors.find("Copied: worldy ") + 15;
    const std::string line = ran.errors.substr(at, ran.errors.find('\n', at) - at);
    const planet::Result<ScreenshotNote> note = readScreenshotNote(files[0]);
    ASSERT_TRUE(note) << note.error().message;
    EXPECT_EQ(note->shotLine, "worldy " + line);
    EXPECT_THAT(note->settings, HasSubstr("tau_px = 0.1"));
    EXPECT_EQ(note->shotLine.find("--camera=20,10,"), std::string::npos);

    const Ran shot = runWorldy(folder, line + " --samples 1");
    ASSERT_EQ(shot.exitCode, 0) << shot.errors;
    const planet::Result<Picture> same = readPicture(folder.path() / "shot.png");
    ASSERT_TRUE(same) << same.error().message;
    ASSERT_EQ(same->rgb.size(), picture->rgb.size());
    EXPECT_LT(meanDifference(*picture, *same), 0.2);

    // And other settings draw another one.
    ASSERT_EQ(runWorldy(folder, line + " --samples 1 --set surface.exaggeration=1").exitCode, 0);
    EXPECT_GT(meanDifference(*picture, *readPicture(folder.path() / "shot.png")), 1);
}

TEST_F(PanelsWindowTest, ASweepRunsBesideTheWindowAndItsSettingsAreTakenOverAndSaved) {
    const Ran ran = runInWindow(folder, "planet.chk", R"sh(
slide "lod/Tolerance τ" 0.2; settle
key ctrl+shift+7; tab Sweep
enter sweep/Tolerances "2 none"; click sweep/Run; frames; counts swept -eq 0 || echo "it runs on wrong tolerances"
enter sweep/Tolerances "1 32"
choose sweep/Picture "640 x 400"
slide "sweep/Sample frames" 0.01
click sweep/Run; expect counts swept -eq 4; expect counts sweeping -eq 0
fine=$(counter triangles)
click "sweep/Row 3"; click "sweep/Use these settings"
expect counts triangles -lt $fine
key ctrl+z; expect counts triangles -eq $fine
click "sweep/Save table and plot"; expect says "with its table"
# One that takes minutes is cancelled, and is no whole table.
enter sweep/Tolerances "0.5 0.6 0.7 0.8 0.9 1 1.2 1.4 1.6 1.8 2 2.2 2.4 2.6 2.8 3"; choose sweep/Picture "1920 x 1080"
slide "sweep/Sample frames" 0.99; click sweep/Run; expect counts sweeping -eq 1
click sweep/Cancel; expect counts sweeping -eq 0; expect says "The sweep was cancelled"
slide "sweep/Sample frames" 0.01; choose sweep/Picture "640 x 400"
enter sweep/Limit 20
click sweep/Suggest; expect counts suggested -eq 2; expect counts sweeping -eq 0
reach sweep/Suggest "sweep/Apply: additive"
click "sweep/Apply: additive"; expect counts triangles -lt $fine
)sh",
                                {"1000x625"});
    expectQuiet(ran);
    std::size_t tables = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        if (entry.path().extension() != ".csv") continue;
        ++tables;
        const std::string csv = contentOf(entry.path());
        EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5) << csv;
        std::filesystem::path beside = entry.path();
        EXPECT_TRUE(std::filesystem::exists(beside.replace_extension(".json")));
        EXPECT_TRUE(readPicture(beside.replace_extension(".png")));
    }
    EXPECT_EQ(tables, 1u);
}

TEST_F(PanelsWindowTest, TheWholePlanetIsSurveyedAndAViewpointBringsTheSettingsOfTheSurvey) {
    const Ran ran = runInWindow(folder, "planet.chk", R"sh(
slide "lod/Tolerance τ" 0.2; settle
key ctrl+shift+a; tab Atlas
slide atlas/Viewpoints 0.01; click atlas/Survey; expect says "Surveyed"
expect shown "atlas/Go 0"
slide "lod/Tolerance τ" 0.9; settle
coarse=$(counter triangles)
click "atlas/Go 0"; settle
expect counts triangles -gt $coarse
key ctrl+z; click "atlas/Tint planet"; frames
click "atlas/Survey again"; expect shown "atlas/Show"; choose "atlas/Show" survey; expect shown "atlas/Go 0"
)sh",
                                {"1400x900"});
    expectQuiet(ran);
    std::filesystem::path atlas;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        if (entry.path().extension() == ".atlas") atlas = entry.path().filename();
    ASSERT_FALSE(atlas.empty());
    const Ran check = runWorldy(folder, "atlas planet.chk --diff '" + atlas.string() + "' --limit eps_px=+0");
    EXPECT_EQ(check.exitCode, 0) << check.output << check.errors;
}

// The first part may have any number of viewpoints; the command continues where the window was cancelled.
TEST_F(PanelsWindowTest, ACancelledSurveyIsKeptAndContinued) {
    const Ran ran = runInWindow(folder, "planet.chk", R"sh(
key ctrl+shift+a; tab Atlas
some_surveyed() { local part="$(ls *.atlas.part 2>/dev/null)"; [ -n "$part" ] && [ "$(stat -c %s "$part")" -gt 20000 ]; }
slide atlas/Viewpoints 0.7; click atlas/Survey; expect some_surveyed; click atlas/Cancel
expect says "Resume continues it"; expect shown atlas/Resume; expect shown "atlas/Go 0"
slide "lod/Tolerance τ" 0.9; settle
click atlas/Resume; expect says "Surveyed"
expect shown "atlas/Compare with..."
)sh",
                                {"1400x900"});
    expectQuiet(ran);
    std::size_t atlases = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        EXPECT_NE(entry.path().extension(), ".part");
        atlases += entry.path().extension() == ".atlas";
    }
    EXPECT_EQ(atlases, 1u);
}

TEST_F(PanelsWindowTest, SettingsForABudgetAreSearchedAppliedAndSaved) {
    const Ran ran = runInWindow(folder, "planet.chk", R"sh(
slide "lod/Tolerance τ" 0.05; settle
key ctrl+shift+g; tab Suggest
fine=$(counter triangles)
click "suggest/Limit Drawn error"; enter suggest/Triangles 8000
reach suggest/Triangles "suggest/Vary regions"
click "suggest/Vary metric"; click "suggest/Vary morph range"; click "suggest/Vary regions"
reach "suggest/Vary regions" suggest/Suggest 4
click suggest/Suggest; expect says "The suggested settings meet the budget of 8000 triangles"
click suggest/Apply; settle
expect counts triangles -lt $fine
key ctrl+z; settle
expect counts triangles -eq $fine
click "suggest/Save report"; expect says "Suggestion saved"
)sh",
                                {"1700x1000"});
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_EQ(ran.output, "") << ran.errors;
    std::filesystem::path report;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        if (entry.path().extension() == ".md") report = entry.path();
    ASSERT_FALSE(report.empty());
    EXPECT_NE(contentOf(report).find("8000 triangles"), std::string::npos);
    std::filesystem::path preset = report;
    preset.replace_extension(".toml");
    const Ran shot =
        runWorldy(folder, "shot planet.chk -o shot.png --settings '" + preset.filename().string() + "'");
    EXPECT_EQ(shot.exitCode, 0) << shot.errors;
    EXPECT_TRUE(readPicture(report.replace_extension(".png")));
}

TEST_F(PanelsWindowTest, ComparingShowsTwoSettingsAndEnds) {
    drive(R"sh(
slide "lod/Tolerance τ" 0; settle; plain=$(viewport)
key ctrl+shift+6; click "compare/Snapshot as B"; expect counts compared -eq 1; settle
expect counts pixels_differ -eq 0
slide "lod/Tolerance τ" 1; settle
expect counts pixels_differ -gt 1000
[ $(counter triangles) -lt $(counter triangles_b) ] || echo "A has $(counter triangles) triangles, B $(counter triangles_b)"
coarse=$(counter triangles); fine=$(counter triangles_b)
choose compare/Show flip; alone=$(viewport)
key F9; expect differs "$alone"; expect same "$plain"; key F9; expect same "$alone"
choose compare/Show wipe; expect shown viewport/Wipe
# Dragged to the right all is A's, to the left B's.
drag() { point viewport/Wipe 0.5 0.3 && press && xdotool mousemove $(at viewport/picture $1 0.3) && frames && release; }
drag 0.999; xdotool mousemove 600 5; expect same "$alone"
drag 0.001; xdotool mousemove 600 5; expect same "$plain"
choose compare/Show difference; expect differs "$plain"
click "compare/Swap A and B"; expect counts triangles -eq $fine; expect counts triangles_b -eq $coarse
click "compare/End comparison"; expect counts compared -eq 0; expect hidden viewport/Wipe
xdotool mousemove 600 5; settle; expect same "$plain"
)sh");
    EXPECT_THAT(settingsOf(folder), HasSubstr("mode = \"difference\""));
}

TEST_F(PanelsWindowTest, BothSidesAreMeasuredOverAFlightBesideTheWindow) {
    std::filesystem::create_directories(folder.path() / "config" / "worldy" / "flights");
    std::ofstream(folder.path() / "config" / "worldy" / "flights" / "aaa.toml")
        << "name = \"Short\"\n[[key]]\ntime_s = 0\nlatitude_deg = 10\nlongitude_deg = 20\n"
           "altitude_m = 200000\nheading_deg = 0\npitch_deg = -80\n[[key]]\ntime_s = 0.2\n"
           "latitude_deg = 12\nlongitude_deg = 21\naltitude_m = 50000\nheading_deg = 0\npitch_deg = -60\n";
    writeWindowSettings(folder, "[window]\nbottom_height = 60\n");
    drive(R"sh(
slide "lod/Tolerance τ" 0
key ctrl+shift+6; click "compare/Snapshot as B"; expect counts compared -eq 1
slide "lod/Tolerance τ" 1
reach "compare/Swap A and B" "compare/Measure over the flight"
choose compare/Flight aaa
click "compare/Measure over the flight"; expect shown compare/Cancel
expect counts compare_flown -eq 1
click "compare/Measure over the flight"; click compare/Cancel; expect hidden compare/Cancel
expect counts compare_flown -eq 0
)sh");
}

}  // namespace
}  // namespace worldy
