#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <sstream>

#include "app/base/picture_file.h"
#include "planet/gl/device/offscreen_context.h"
#include "tests/program/small_planet.h"

namespace worldy {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

std::set<std::string> filesIn(const std::filesystem::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name != ".stdout" && name != ".stderr") names.insert(name);
    }
    return names;
}

double meanOf(const Picture& picture) {
    return std::accumulate(picture.rgb.begin(), picture.rgb.end(), 0.0) /
           static_cast<double>(picture.rgb.size());
}

// Drawing needs EGL; a machine without it can still run the rest.
bool canDraw() {
    return planet::gl::OffscreenContext::create().has_value();
}

TEST(Program, InfoTellsWhatWasBaked) {
    const TemporaryFolder folder;
    writeHills(folder);
    const Ran baked = runWorldy(
        folder, "bake hills.pgm -o planet.chk --chunk-size 17 --face-size 129 --radius 100000 --json");
    ASSERT_EQ(baked.exitCode, 0) << baked.errors;
    const json bake = json::parse(baked.output);
    EXPECT_EQ(bake["face_size"], 129);
    EXPECT_EQ(bake["chunks"], 6 * (1 + 4 + 16 + 64));
    EXPECT_EQ(bake["level_count"], 4);
    EXPECT_EQ(bake["file_bytes"], std::filesystem::file_size(folder.path() / "planet.chk"));

    const Ran told = runWorldy(folder, "info planet.chk --json");
    ASSERT_EQ(told.exitCode, 0) << told.errors;
    const json info = json::parse(told.output);
    EXPECT_EQ(info["radius_m"], 100000);
    EXPECT_EQ(info["chunk_size"], 17);
    EXPECT_EQ(info["levels"].size(), 4u);
    EXPECT_EQ(info["levels"][3]["chunks"], 6 * 64);
    EXPECT_EQ(info["levels"][3]["leaves"], 6 * 64);
    EXPECT_EQ(info["levels"][2]["leaves"], 0);
    EXPECT_EQ(info["chunks"], 6 * (1 + 4 + 16 + 64));
    EXPECT_EQ(info["leaves"], 6 * 64);
    EXPECT_EQ(info["coarsest_leaf_level"], 3);
    EXPECT_EQ(info["levels"][3]["max_delta_m"], 0);
    EXPECT_THAT(info["source"].get<std::string>(), HasSubstr("hills.pgm"));
    EXPECT_THAT(runWorldy(folder, "info planet.chk").output, HasSubstr("hills.pgm"));
}

TEST(Program, VerifyPassesAGoodFileAndFindsDamage) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    const Ran good = runWorldy(folder, "verify planet.chk --source hills.pgm --metres-per-unit 20 --json");
    EXPECT_EQ(good.exitCode, 0) << good.output << good.errors;
    EXPECT_EQ(json::parse(good.output)["problem_count"], 0);
    EXPECT_GT(json::parse(good.output)["leaf_samples"], 0);

    std::fstream file(folder.path() / "planet.chk", std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(700);
    file.put('\x5A').put('\x5A').put('\x5A').put('\x5A');
    file.close();
    const Ran bad = runWorldy(folder, "verify planet.chk");
    EXPECT_EQ(bad.exitCode, 1);
    EXPECT_THAT(bad.output, HasSubstr("shared edges checked, 1 problem\n"));
    EXPECT_EQ(bad.errors, "worldy: planet.chk: 1 problem found, 0 expected; bake the file again\n");
}

TEST(Program, VerifyAgainstAnotherSourceDoesNotBlameTheFileAlone) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    const Ran other = runWorldy(folder, "verify planet.chk --source hills.pgm --metres-per-unit 19");
    EXPECT_EQ(other.exitCode, 1);
    EXPECT_THAT(other.output, HasSubstr(" samples compared with the source, "));
    EXPECT_THAT(other.errors,
                HasSubstr("the file is consistent but differs from the given source: bake it again, or "
                          "name the source and the options that it was baked with"));
}

TEST(Program, ProbeTellsTheHeightOfTheImage) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    // The middle of a pixel, on a slope; the baked surface is smooth and in steps of the image's.
    const int column = 40, row = 70;
    const double latitude = 90 - 180.0 * (row + 0.5) / hillsHeight;
    const double longitude = -180 + 360.0 * (column + 0.5) / hillsWidth;
    const Ran ran = runWorldy(
        folder, "probe planet.chk " + std::to_string(latitude) + " " + std::to_string(longitude) + " --json");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    const json probe = json::parse(ran.output);
    EXPECT_NEAR(probe["height_m"].get<double>(), 20 * hillAt(column, row), 60);
    EXPECT_EQ(probe["levels_here"][0]["id"].get<std::string>().find("/0/0/0"), 5u);
}

TEST(Program, AnInterruptedBakeEndsWith130AndLeavesNothing) {
    const TemporaryFolder folder;
    writeHills(folder);
    const Ran ran = runShell(folder, "timeout --preserve-status -s INT 1 '" WORLDY_BINARY
                                     "' bake hills.pgm -o big.chk --face-size 16385");
    EXPECT_EQ(ran.exitCode, 130) << ran.errors;
    EXPECT_EQ(filesIn(folder.path()), (std::set<std::string>{"hills.pgm"}));
}

TEST(Program, AFailedBakeLeavesTheOldFile) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    const std::string before = contentOf(folder.path() / "planet.chk");
    EXPECT_EQ(runWorldy(folder, "bake hills.pgm -o planet.chk --face-size 100").exitCode, 2);
    EXPECT_EQ(contentOf(folder.path() / "planet.chk"), before);
    EXPECT_EQ(filesIn(folder.path()), (std::set<std::string>{"hills.pgm", "planet.chk"}));
}

TEST(Program, AShotIsAPictureOfThePlanet) {
    if (!canDraw()) GTEST_SKIP() << "no EGL context";
    const TemporaryFolder folder;
    bakePlanet(folder);
    const Ran ran = runWorldy(folder, "shot planet.chk -o shot.png --size 200x120 --tau 1 --json");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    const planet::Result<Picture> picture = readPicture(folder.path() / "shot.png");
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->width, 200);
    EXPECT_EQ(picture->height, 120);
    EXPECT_GT(meanOf(*picture), 5);
    const std::size_t middle = 3 * (60 * 200 + 100);
    EXPECT_GT(picture->rgb[middle] + picture->rgb[middle + 1] + picture->rgb[middle + 2], 60);

    const json report = json::parse(ran.output);
    EXPECT_TRUE(report["settled"]);
    EXPECT_LE(report["worst_eps_px"], 1.0);
    const std::vector<int> levels = report["drawn_by_level"];
    EXPECT_EQ(std::accumulate(levels.begin(), levels.end(), 0), report["drawn_chunks"]);
    EXPECT_EQ(report["schema_version"], 2);
    EXPECT_GT(report["ground_triangles"], 0);
    EXPECT_GT(report["skirt_triangles"], 0);
    EXPECT_EQ(report["triangles"],
              report["ground_triangles"].get<int>() + report["skirt_triangles"].get<int>());
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "config"));
}

TEST(Program, ShotsOfTheSameViewAreTheSameAndOptionsChangeThem) {
    if (!canDraw()) GTEST_SKIP() << "no EGL context";
    const TemporaryFolder folder;
    bakePlanet(folder);
    const auto shot = [&](const std::string& options) {
        const Ran ran = runWorldy(
            folder, "shot planet.chk -o s.png --size 160x100 --camera 10,20,30000,0,-60 " + options);
        EXPECT_EQ(ran.exitCode, 0) << ran.errors;
        return readPicture(folder.path() / "s.png").value_or(Picture{}).rgb;
    };
    const std::vector<std::uint8_t> plain = shot("");
    EXPECT_EQ(shot(""), plain);
    for (const char* option :
         {"--wireframe", "--colour-by level", "--colour-by error", "--cube", "--fov 30"}) {
        EXPECT_NE(shot(option), plain) << option;
    }
    // Whatever is set as it is anyway changes nothing.
    EXPECT_EQ(shot("--set lod.tau_px=2 --set surface.exaggeration=1 --set overlay.outlines=false"), plain);
}

TEST(Program, ARegionsFileIsFoundBesideThePlanetOrNamed) {
    if (!canDraw()) GTEST_SKIP() << "no EGL context";
    const TemporaryFolder folder;
    bakePlanet(folder);
    const auto write = [&](const std::string& name, double factor) {
        std::ofstream(folder.path() / name)
            << "[[region]]\nname = \"spot\"\ncircles = [[10, 20, 20000]]\ntau_factor = " << factor << "\n";
    };
    json regions;
    const auto drawn = [&](const std::string& options) {
        const Ran ran =
            runWorldy(folder,
                      "shot planet.chk -o s.png --overwrite --json --size 160x100 --tau 4 --camera "
                      "10,20,60000,0,-60 " +
                          options);
        EXPECT_EQ(ran.exitCode, 0) << ran.errors;
        const json report = json::parse(ran.output);
        regions = report["regions"];
        return report["drawn_chunks"].get<int>();
    };
    const int plain = drawn("");
    EXPECT_TRUE(regions.empty());
    write("planet.regions.toml", 0.25);
    const int finer = drawn("");
    EXPECT_GT(finer, plain);
    ASSERT_EQ(regions.size(), 1U);
    EXPECT_EQ(regions[0]["name"], "spot");
    EXPECT_GT(regions[0]["drawn_chunks"], 0);
    EXPECT_LE(regions[0]["drawn_chunks"], finer);
    EXPECT_EQ(regions[0]["decided_chunks"], regions[0]["drawn_chunks"]) << "no other region is there";
    EXPECT_EQ(drawn("--set regions.on=false"), plain);
    EXPECT_TRUE(regions.empty());
    write("other.regions.toml", 16);
    EXPECT_LE(drawn("--regions other.regions.toml"), plain);
    EXPECT_EQ(drawn("--regions planet.regions.toml"), finer);
    std::ofstream(folder.path() / "planet.regions.toml") << "[[region]]\nname = 3\n";
    const Ran bad = runWorldy(folder, "shot planet.chk -o s.png --overwrite");
    EXPECT_EQ(bad.exitCode, 2);
    EXPECT_THAT(bad.errors, HasSubstr("planet.regions.toml: line 2: region 1: name is 3"));
}

TEST(Program, SettingsOfThePictureChangeAShot) {
    if (!canDraw()) GTEST_SKIP() << "no EGL context";
    const TemporaryFolder folder;
    bakePlanet(folder);
    writePicture({2, 1, {250, 20, 20, 20, 20, 250}}, folder.path() / "colour.png");
    // Ground, sea and horizon; not all is as fine as it could be, and a chunk is morphing.
    const auto shot = [&](const std::string& options) {
        const Ran ran = runWorldy(folder,
                                  "shot planet.chk -o s.png --size 128x80 --camera 10,20,60000,0,-40 "
                                  "--samples 1 --set lod.tau_px=1.5 --set surface.sea_level_m=1500 " +
                                      options);
        EXPECT_EQ(ran.exitCode, 0) << options << ": " << ran.errors;
        return readPicture(folder.path() / "s.png").value_or(Picture{}).rgb;
    };
    const std::vector<std::uint8_t> plain = shot("");
    for (const char* setting :
         {"lod.max_level=0", "lod.morph=false", "overlay.colour_by=delta_c", "overlay.outlines=true",
          "overlay.bounds=true", "surface.image_opacity=0.5", "surface.sea_level_m=3000",
          "surface.exaggeration=2", "surface.sun_follows=false"}) {
        EXPECT_TRUE(shot(std::string("--set ") + setting) != plain) << setting;
    }
    const std::string skirts = "--set overlay.skirt_paint=loud_alone ";
    EXPECT_NE(shot(skirts + "--set seams.mode=none"), shot(skirts));
    const std::string ramp = "--set 'surface.ramp=[{ height_m = 0, colour = \"#ff00ff\" }]' ";
    EXPECT_NE(shot("--surface ramp " + ramp), shot("--surface ramp"));
}

TEST(Program, AShotIsSettingsForTheNextOne) {
    if (!canDraw()) GTEST_SKIP() << "no EGL context";
    const TemporaryFolder folder;
    bakePlanet(folder);
    const std::string common = "--size 96x64 --samples 1 ";
    const Ran first = runWorldy(folder, "shot planet.chk -o first.png --camera 10,20,30000,40,-60 " + common +
                                            "--set overlay.outlines=true --set surface.exaggeration=3");
    ASSERT_EQ(first.exitCode, 0) << first.errors;
    const Ran second = runWorldy(folder, "shot planet.chk -o second.png --settings first.png " + common);
    ASSERT_EQ(second.exitCode, 0) << second.errors;
    const std::vector<std::uint8_t> picture = readPicture(folder / "first.png")->rgb;
    EXPECT_EQ(readPicture(folder / "second.png")->rgb, picture);
    // The line that it holds draws it too.
    std::string line = readPictureText(folder / "first.png", "worldy:shot").value();
    ASSERT_THAT(line, testing::StartsWith("worldy shot /"));
    line.replace(0, std::string("worldy").size(), "'" WORLDY_BINARY "'");
    const Ran third = runShell(folder, line + " --samples 1");
    ASSERT_EQ(third.exitCode, 0) << third.errors;
    EXPECT_EQ(readPicture(folder / "shot.png")->rgb, picture);
    // Settings given beside it win; a picture that holds none is refused.
    const Ran preset = runWorldy(folder,
                                 "shot planet.chk -o p.png --settings first.png --set lod.tau_px=9 "
                                 "--json " +
                                     common);
    EXPECT_EQ(json::parse(preset.output)["tau_px"], 9);
    ASSERT_TRUE(writePicture({1, 1, {0, 0, 0}}, folder / "empty.png"));
    const Ran empty = runWorldy(folder, "shot planet.chk -o e.png --settings empty.png");
    EXPECT_EQ(empty.exitCode, 2);
    EXPECT_THAT(empty.errors, HasSubstr("empty.png: contains no settings"));
}

TEST(Program, ACameraBelowGroundIsLifted) {
    if (!canDraw()) GTEST_SKIP() << "no EGL context";
    const TemporaryFolder folder;
    bakePlanet(folder);
    const Ran ran = runWorldy(folder, "shot planet.chk -o s.png --size 64x64 --camera 10,20,-500,0,0 --json");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_THAT(ran.errors, HasSubstr("the camera was below the ground; lifted"));
    const Ran probe = runWorldy(folder, "probe planet.chk 10 20 --json");
    const double groundM = json::parse(probe.output)["height_m"];
    EXPECT_NEAR(json::parse(ran.output)["camera"]["altitude_m"].get<double>(), groundM + 2, 5);
}

// Down to the ground in five seconds.
void writeFlight(const TemporaryFolder& folder) {
    std::ofstream(folder.path() / "path.toml")
        << "name = \"Down\"\n[[key]]\ntime_s = 0\nlatitude_deg = 0\nlongitude_deg = 0\naltitude_m = 2e5\n"
           "heading_deg = 0\npitch_deg = -90\n[[key]]\ntime_s = 5\nlatitude_deg = 10\nlongitude_deg = 5\n"
           "altitude_m = 8000\nheading_deg = 30\npitch_deg = -20\n";
}

TEST(Program, AFlightReportsEveryFrame) {
    if (!canDraw()) GTEST_SKIP() << "no EGL context";
    const TemporaryFolder folder;
    bakePlanet(folder);
    writeFlight(folder);
    const Ran ran =
        runWorldy(folder, "fly planet.chk --flight path.toml --frames 12 --size 160x100 -o out.json");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_THAT(ran.output, HasSubstr("Down: 12 frames over 5 s"));
    EXPECT_THAT(ran.output, HasSubstr("99th percentile"));
    const json report = json::parse(contentOf(folder.path() / "out.json"));
    ASSERT_EQ(report["frame"].size(), 12u);
    double most = 0;
    for (const json& frame : report["frame"]) {
        EXPECT_GT(frame["drawn_chunks"], 0);
        EXPECT_GT(frame["frame_ms"], 0);
        most = std::max(most, frame["drawn_chunks"].get<double>());
    }
    EXPECT_EQ(report["summary"]["drawn_chunks"]["maximum"], most);
    EXPECT_NEAR(report["frame"][11]["camera"]["altitude_m"].get<double>(), 8000, 1e-3);
    EXPECT_TRUE(report["summary"]["drawn_chunks"]["median"].is_number_integer());

    const Ran printed =
        runWorldy(folder, "fly planet.chk --flight path.toml --step-s 2 --size 160x100 --json");
    ASSERT_EQ(printed.exitCode, 0) << printed.errors;
    const json steps = json::parse(printed.output);
    ASSERT_EQ(steps["frame"].size(), 3u);
    EXPECT_EQ(steps["frame"][2]["time_s"], 4);
}

TEST(Program, ASweepFliesAtEveryTauAndFindsOneForABudget) {
    if (!canDraw()) GTEST_SKIP() << "no EGL context";
    const TemporaryFolder folder;
    bakePlanet(folder);
    writeFlight(folder);
    const std::string common =
        "sweep planet.chk --flight path.toml --frames 3 --size 160x100 --metric additive ";
    const Ran ran = runWorldy(folder, common + "--tau 0.5,2,16 -o out.csv --json --plot out.png");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    const json points = json::parse(ran.output)["points"];
    ASSERT_EQ(points.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(points[i]["violations"], 0);
        EXPECT_LE(points[i]["worst_measured_px"], points[i]["tau_px"].get<double>() * 1.001);
        if (i == 0) continue;
        EXPECT_LT(points[i]["mean_triangles"], points[i - 1]["mean_triangles"]);
        EXPECT_GT(points[i]["worst_measured_px"], points[i - 1]["worst_measured_px"]);
    }
    EXPECT_TRUE(readPicture(folder.path() / "out.png"));
    EXPECT_THAT(contentOf(folder.path() / "out.csv"), HasSubstr("\n2,additive,17,16,"));

    const double budget = points[1]["mean_triangles"];
    const Ran found = runWorldy(folder, common + fmt::format("--suggest triangles={}", budget));
    ASSERT_EQ(found.exitCode, 0) << found.errors;
    EXPECT_THAT(found.output, HasSubstr("within"));
    const double tauPx = std::stod(found.output.substr(found.output.find("tau ") + 4));
    EXPECT_LE(tauPx, 2.05);
}

TEST(Program, ABenchSetsEachFigureBesideItsYardstick) {
    if (!canDraw()) GTEST_SKIP() << "no EGL context";
    const TemporaryFolder folder;
    writeHills(folder);
    const Ran ran =
        runShell(folder, "mkdir temporary && TMPDIR=temporary '" WORLDY_BINARY
                         "' bench hills.pgm --faces 65 --rounds 2 --tau 1 --size 64x64 -o out.json");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    const json report = json::parse(contentOf(folder.path() / "out.json"));
    EXPECT_NE(report["machine"]["gl_renderer"], "");
    for (const char* part :
         {"lod", "frame", "dynamic", "selection", "page_in", "bake", "file_size", "colours"}) {
        ASSERT_FALSE(report["parts"][part].empty()) << part;
        for (const json& row : report["parts"][part]) {
            EXPECT_GT(row["median"], 0) << row;
            EXPECT_LE(row["minimum"], row["median"]) << row;
            EXPECT_GE(row["maximum"], row["median"]) << row;
        }
    }
    std::map<std::string, double> triangles;
    for (const json& row : report["parts"]["lod"]) {
        if (row["quantity"] != "triangles") continue;
        EXPECT_TRUE(row["median"].is_number_integer()) << row;
        triangles[row["subject"]] = row["median"];
    }
    EXPECT_EQ(triangles["faces of 65, every leaf"], 6 * 64 * 64 * 2);
    EXPECT_LT(triangles["faces of 65, tau 1 px"], triangles["faces of 65, every leaf"]);
    const json& frame = report["parts"]["frame"];
    EXPECT_EQ(frame[0]["subject"], "64 x 64, default settings");
    EXPECT_EQ(frame[0]["times"]["of"], "one texture");
    std::map<std::string, double> drawn;
    for (const json& row : frame) {
        if (row["quantity"] == "triangles") drawn[row["subject"]] = row["median"];
    }
    EXPECT_GT(drawn["64 x 64, morph and one texture"], 0);
    EXPECT_EQ(drawn["64 x 64, morph and one texture"], drawn["64 x 64, without light, air and detail"]);
    const json& dynamic = report["parts"]["dynamic"];
    EXPECT_EQ(dynamic[0]["times"]["of"], "static");
    EXPECT_EQ(dynamic.back()["median"], triangles["faces of 65, tau 1 px"]) << "of the static draw";
    EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "temporary"));

    const Ran table =
        runWorldy(folder, "bench hills.pgm --faces 65 --rounds 2 --parts page_in start -o t.csv");
    ASSERT_EQ(table.exitCode, 0) << table.errors;
    const std::string csv = contentOf(folder.path() / "t.csv");
    EXPECT_THAT(csv, StartsWith("schema_version,part,subject,quantity,unit,median,minimum,maximum,"));
    EXPECT_THAT(csv, HasSubstr("\n2,page_in,\"loading, one loader\",\"rate\",\"MB/s\","));
    EXPECT_THAT(csv, HasSubstr(",\"the same blocks in a loop\",,0.9,times\n"));
    EXPECT_THAT(csv, HasSubstr(",,,,,30,,value\n"));
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
        bool isText = false;
        int commas = 0;
        for (const char c : line) isText ^= c == '"', commas += !isText && c == ',';
        EXPECT_EQ(commas, 14) << line;
    }

    const Ran same = runWorldy(folder, "bench --compare out.json out.json -o same.json");
    EXPECT_EQ(same.exitCode, 0) << same.errors;
    EXPECT_THAT(same.output, HasSubstr("\n0 of "));
    EXPECT_EQ(json::parse(contentOf(folder / "same.json"))["changes"][0]["verdict"], "within_noise");
    json slower = report;
    for (const char* key : {"minimum", "median", "maximum"})
        slower["parts"]["selection"][0][key] = 10 * slower["parts"]["selection"][0][key].get<double>();
    std::ofstream(folder / "slower.json") << slower;
    const Ran worse = runWorldy(folder, "bench --compare out.json slower.json");
    EXPECT_EQ(worse.exitCode, 1) << worse.errors;
    EXPECT_THAT(worse.output, HasSubstr("WORSE: +900.0 %"));
    EXPECT_THAT(worse.output, HasSubstr("\n1 of "));
    EXPECT_EQ(runWorldy(folder, "bench --compare out.json").exitCode, 2);
    EXPECT_EQ(runWorldy(folder, "bench --compare out.json hills.pgm").exitCode, 2);
    EXPECT_EQ(runWorldy(folder, "bench --compare out.json out.json -o out.json").exitCode, 2);
    EXPECT_EQ(runWorldy(folder, "bench --compare out.json out.json -o other.csv").exitCode, 2);
    EXPECT_EQ(runWorldy(folder, "bench --compare out.json out.json --rounds 3").exitCode, 2);
}

TEST(Program, NoOpenGl33EndsWithTwoAndSaysWhatIsMissing) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    const Ran ran = runShell(folder, "LIBGL_ALWAYS_SOFTWARE=1 MESA_GL_VERSION_OVERRIDE=2.1 '" WORLDY_BINARY
                                     "' shot planet.chk -o o.png");
    EXPECT_EQ(ran.exitCode, 2);
    EXPECT_THAT(ran.errors, HasSubstr("no OpenGL core profile of version 3.3"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "o.png"));
}

TEST(Program, ADeviceIsNeverReplacedByAFile) {
    const TemporaryFolder folder;
    writeHills(folder);
    const Ran ran = runShell(folder, "mkfifo pipe.chk && '" WORLDY_BINARY "' bake hills.pgm -o pipe.chk");
    EXPECT_EQ(ran.exitCode, 2);
    EXPECT_THAT(ran.errors, HasSubstr("pipe.chk: is a folder or a device"));
    EXPECT_TRUE(std::filesystem::is_fifo(folder.path() / "pipe.chk"));
}

TEST(Program, WithoutADisplayItWritesAPictureOfTheFirstView) {
    if (!canDraw()) GTEST_SKIP() << "no EGL context";
    const TemporaryFolder folder;
    writeHills(folder);
    std::ofstream(folder.path() / "small.toml") << "[window]\nwidth_px = 640\nheight_px = 400\n";
    const Ran ran = runWorldy(folder, "hills.pgm --settings small.toml");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_THAT(ran.errors, HasSubstr("no display"));
    EXPECT_THAT(ran.output, HasSubstr("cache/worldy/worldy-first-view.png"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "worldy-first-view.png"));
    const planet::Result<Picture> picture =
        readPicture(folder.path() / "cache" / "worldy" / "worldy-first-view.png");
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->width, 640);
    EXPECT_GT(meanOf(*picture), 5);

    // The second time the bake is found in the cache.
    const std::set<std::string> cached = filesIn(folder.path() / "cache" / "worldy");
    EXPECT_EQ(cached.size(), 2u);  // the bake and the picture
    const Ran again = runWorldy(folder, "hills.pgm --settings small.toml");
    EXPECT_EQ(again.exitCode, 0);
    EXPECT_THAT(again.errors, testing::Not(HasSubstr("samples")));
    EXPECT_EQ(filesIn(folder.path() / "cache" / "worldy"), cached);
}

TEST(Program, BadSettingsOfTheUserAreToldAndLeftAlone) {
    if (!canDraw()) GTEST_SKIP() << "no EGL context";
    const TemporaryFolder folder;
    bakePlanet(folder);
    const std::filesystem::path file = folder.path() / "config" / "worldy" / "settings.toml";
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << "[lod]\ntau_px = 1000\n";
    const Ran ran = runWorldy(folder, "planet.chk");
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_THAT(ran.errors, HasSubstr("settings.toml: line 2: lod.tau_px is 1000"));
    EXPECT_EQ(contentOf(file), "[lod]\ntau_px = 1000\n");
}

}  // namespace
}  // namespace worldy
