#include "app/settings/shot_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>

#include "app/cli/command_line.h"
#include "app/settings/camera_text.h"
#include "app/settings/settings_schema.h"
#include "app/settings/settings_text.h"

namespace worldy {
namespace {

using testing::HasSubstr;
using testing::Not;

// The words that a shell makes of a line.
std::vector<std::string> wordsOf(const std::string& line) {
    const std::string command = "printf '%s\\0' " + line;
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::vector<std::string> words(1);
    for (int letter = 0; pipe && (letter = std::fgetc(pipe.get())) != EOF;) {
        if (letter == 0)
            words.emplace_back();
        else
            words.back() += static_cast<char>(letter);
    }
    words.pop_back();
    return words;
}

// What `worldy shot` would draw if the line were typed.
planet::Result<ShotOptions> typed(const std::string& line) {
    const std::vector<std::string> words = wordsOf(line);
    std::vector<const char*> arguments;
    for (const std::string& word : words) arguments.push_back(word.c_str());
    return shotOptionsFrom(arguments);
}

constexpr PictureSize shotSize{1357, 911};
const planet::CameraPose shotPose{27.988123456789012, -86.92500000000001, 8848.860000000001, 359.99999999,
                                  -1e-7};

TEST(ShotLine, OfTheDefaultsIsShort) {
    EXPECT_EQ(shotLine("earth.chk", {20, 10, 2e7, 0, -90}, {1280, 720}, {}, {}),
              "worldy shot earth.chk -o shot.png --camera=20,10,20000000,0,-90 --size 1280x720");
}

TEST(ShotLine, NamesTheSourceOnlyIfItsLayersAreShown) {
    ViewSettings view;
    const auto sourceOf = [&] {
        const auto options =
            typed(shotLine("earth.chk", shotPose, shotSize, view, {}, "/data/my world.toml"));
        return options ? options->source.string() : options.error().message;
    };
    EXPECT_EQ(sourceOf(), "");
    view.overlay.colourBy = ColourBy::Source;
    EXPECT_EQ(sourceOf(), "/data/my world.toml");
    view.overlay.colourBy = ColourBy::None;
    view.overlay.sources = true;
    EXPECT_EQ(sourceOf(), "/data/my world.toml");
}

TEST(ShotLine, TypedAgainGivesTheSameViewAndSettings) {
    Settings settings;
    ViewSettings& view = settings.view;
    view.lod = {.tauPx = 0.1 + 0.2, .hysteresis = 1.0 / 3, .maxLevel = 7, .morph = false};
    view.lod.seams = planet::SeamMode::Stitched;
    view.paging.badDisk = {.latencyMs = 3, .shuffledOrder = true, .seed = 4294967295u};
    view.overlay.colourBy = ColourBy::DeltaC;
    view.overlay.skirtPaint = planet::gl::SkirtPaint::LoudAlone;
    view.surface.ramp = {{-10921.5, {0, 0, 51 / 255.0f}}, {0, {1, 0.2f, 0}}, {8848.125, {1, 1, 1}}};
    view.surface.sunFollows = false;
    view.surface.sunLongitudeDeg = -179.99999999999997;
    view.camera.flight = "a \"flight\" of 'mine' $HOME `x` \\ ä\n.toml";
    const planet::Result<ShotOptions> options =
        typed(shotLine("/data/earth.chk", shotPose, shotSize, view, "/c.jpg"));
    ASSERT_TRUE(options) << options.error().message;
    EXPECT_EQ(options->view, view);
    EXPECT_EQ(options->file, "/data/earth.chk");
    EXPECT_EQ(options->colourImage, "/c.jpg");
    EXPECT_EQ(options->size.widthPx, shotSize.widthPx);
    EXPECT_EQ(options->size.heightPx, shotSize.heightPx);
    ASSERT_TRUE(options->camera);
    EXPECT_EQ(options->camera->latitudeDeg, shotPose.latitudeDeg);
    EXPECT_EQ(options->camera->longitudeDeg, shotPose.longitudeDeg);
    EXPECT_EQ(options->camera->altitudeM, shotPose.altitudeM);
    EXPECT_EQ(options->camera->headingDeg, shotPose.headingDeg);
    EXPECT_EQ(options->camera->pitchDeg, shotPose.pitchDeg);
}

TEST(ShotLine, EachSettingByItselfComesThrough) {
    Settings counted;
    const std::size_t count = fieldsOf(counted).size();
    int seen = 0;
    for (std::size_t i = 0; i < count; ++i) {
        Settings settings;
        const Field field = fieldsOf(settings)[i];
        if (!isViewTable(field.table)) continue;
        if (const Number* number = std::get_if<Number>(&field.value)) {
            *number->value = number->range.min + (number->range.max - number->range.min) / 7;
        } else if (const Flag* flag = std::get_if<Flag>(&field.value)) {
            *flag->value = !*flag->value;
        } else if (const Choice* choice = std::get_if<Choice>(&field.value)) {
            *choice->value = static_cast<std::uint8_t>(choice->names.size() - 1 - *choice->value);
        } else {
            continue;
        }
        // A shell for each would take its time: these have no blanks in them.
        const std::vector<std::string> assignments = assignmentsFor(settings.view);
        ASSERT_LE(assignments.size(), 1u);
        std::vector<const char*> arguments = {"worldy", "shot", "a.chk", "-o", "b.png"};
        for (const std::string& assignment : assignments) {
            arguments.push_back("--set");
            arguments.push_back(assignment.c_str());
        }
        const planet::Result<ShotOptions> options = shotOptionsFrom(arguments);
        ASSERT_TRUE(options) << options.error().message;
        EXPECT_EQ(options->view, settings.view) << field.name();
        ++seen;
    }
    EXPECT_GT(seen, 40);
}

TEST(ShotLine, AnyPathIsQuotedRight) {
    for (const char* path : {"/with space/a.chk",
                             "/it's.chk",
                             "/\"double\".chk",
                             "-leading-dash.chk",
                             "$HOME/`x`.chk",
                             "/new\nline.chk",
                             "/tab\there.chk",
                             "/back\\slash.chk",
                             "~/a.chk",
                             "*.chk",
                             "bake",
                             "shot",
                             "--",
                             "/Erde ä.chk",
                             "/caf\xe9.chk",
                             "[a].chk",
                             "{a,b}.chk",
                             "#a.chk",
                             "a;b&c|d.chk",
                             "!a.chk",
                             "a=b.chk"}) {
        const planet::Result<ShotOptions> options = typed(shotLine(path, shotPose, shotSize, {}, path));
        ASSERT_TRUE(options) << path << ": " << options.error().message;
        const std::filesystem::path wanted =
            std::string(path).starts_with('-') ? std::string("./") + path : path;
        EXPECT_EQ(options->file, wanted) << path;
        EXPECT_EQ(options->colourImage, wanted) << path;
    }
}

TEST(ShotLine, WordsOfPlainLettersStayAsTheyAre) {
    EXPECT_EQ(shellWord("lod.tau_px=3"), "lod.tau_px=3");
    EXPECT_EQ(shellWord(""), "''");
    EXPECT_EQ(shellWord("a b"), "'a b'");
    EXPECT_EQ(shellWord("it's"), "'it'\\''s'");
}

TEST(ShotOptions, NamedOptionsWinOverTheSettingsFileAndAssignmentsOverBoth) {
    const std::array<const char*, 13> arguments = {"worldy",
                                                   "shot",
                                                   "a.chk",
                                                   "-o",
                                                   "b.png",
                                                   "--settings",
                                                   WORLDY_SOURCE_DIR "/data/presets/popping.toml",
                                                   "--tau",
                                                   "5",
                                                   "--set",
                                                   "overlay.outlines=true",
                                                   "--set",
                                                   "lod.hysteresis=0.25"};
    const planet::Result<ShotOptions> options = shotOptionsFrom(arguments);
    ASSERT_TRUE(options) << options.error().message;
    EXPECT_FALSE(options->view.lod.morph);
    EXPECT_EQ(options->view.lod.tauPx, 5);
    EXPECT_EQ(options->view.lod.hysteresis, 0.25);
    EXPECT_TRUE(options->view.overlay.outlines);
}

TEST(ShotOptions, TheOldOptionsStillWork) {
    const std::array<const char*, 19> arguments = {
        "worldy",       "shot",     "a.chk",       "-o",          "b.png",      "--tau",     "0.25",
        "--no-culling", "--budget", "64",          "--colour-by", "load_order", "--surface", "ramp",
        "--no-skirts",  "--cube",   "--wireframe", "--fov",       "33"};
    const planet::Result<ShotOptions> options = shotOptionsFrom(arguments);
    ASSERT_TRUE(options) << options.error().message;
    const ViewSettings& view = options->view;
    EXPECT_EQ(view.lod.tauPx, 0.25);
    EXPECT_FALSE(view.lod.frustumCulling || view.lod.horizonCulling);
    EXPECT_EQ(view.paging.budgetMB, 64);
    EXPECT_EQ(view.overlay.colourBy, ColourBy::LoadOrder);
    EXPECT_EQ(view.surface.surface, planet::gl::SurfaceColour::HeightRamp);
    EXPECT_EQ(view.lod.seams, planet::SeamMode::None);
    EXPECT_TRUE(view.overlay.cube && view.overlay.wireframe);
    EXPECT_EQ(view.camera.fovDeg, 33);
    EXPECT_FALSE(options->camera);
}

TEST(ShotOptions, WrongAssignmentsAreErrors) {
    const auto errorOf = [](const char* assignment) {
        const std::array<const char*, 7> arguments = {"worldy", "shot",  "a.chk",   "-o",
                                                      "b.png",  "--set", assignment};
        const planet::Result<ShotOptions> options = shotOptionsFrom(arguments);
        return options ? std::string("no error") : options.error().message;
    };
    EXPECT_THAT(errorOf("lod.tau_px=0"),
                HasSubstr("--set lod.tau_px=0: lod.tau_px is 0; expected a number in [0.1, 64] px"));
    EXPECT_THAT(errorOf("lod.tau=3"), HasSubstr("did you mean lod.tau_px?"));
    EXPECT_THAT(errorOf(""), Not(HasSubstr("no error")));
}

}  // namespace
}  // namespace worldy
