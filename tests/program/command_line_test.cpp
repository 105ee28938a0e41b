#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "tests/program/run_program.h"

namespace worldy {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(CommandLine, HelpAndVersionEndWell) {
    const TemporaryFolder folder;
    const Ran help = runWorldy(folder, "--help");
    EXPECT_EQ(help.exitCode, 0);
    for (const char* command : {"bake", "info", "verify", "probe", "shot", "fly", "cracks", "pops", "sweep",
                                "bench", "audit", "compare", "make-layers", "trace", "attach", "prefetch"}) {
        EXPECT_THAT(help.output, HasSubstr(command));
        const Ran own = runWorldy(folder, std::string(command) + " --help");
        EXPECT_EQ(own.exitCode, 0) << command;
        EXPECT_THAT(own.output, HasSubstr(command));
    }
    const Ran version = runWorldy(folder, "--version");
    EXPECT_EQ(version.exitCode, 0);
    EXPECT_THAT(version.output, StartsWith("worldy "));
}

// The options that a command lists, "--json" among them.
std::set<std::string> optionsOf(const std::string& help) {
    std::set<std::string> options;
    const std::regex option("\\n  (?:-\\w,)?(--[a-z-]+)");
    for (std::sregex_iterator found(help.begin(), help.end(), option), end; found != end; ++found)
        options.insert((*found)[1]);
    return options;
}

// A row of the table of shared options in app/README.md: | `--json` | ... | bake, info |
TEST(CommandLine, TheReadmeSaysWhichCommandTakesWhichSharedOption) {
    const TemporaryFolder folder;
    const std::string readme = contentOf(std::filesystem::path(WORLDY_SOURCE_DIR) / "app/README.md");
    const std::string commands = readme.substr(readme.find("| option | means | taken by |"));
    std::map<std::string, std::set<std::string>> takers;
    const std::regex row("\\n\\| `(--[a-z-]+)[^|]*\\|[^|]*\\| ([a-z, -]+) \\|");
    const std::string table = commands.substr(0, commands.find("\n\n"));
    for (std::sregex_iterator found(table.begin(), table.end(), row), end; found != end; ++found) {
        std::istringstream names((*found)[2]);
        for (std::string name; names >> name;) takers[(*found)[1]].insert(name.substr(0, name.find(',')));
    }
    ASSERT_GE(takers.size(), 15u);
    for (const char* command :
         {"bake",    "info",     "verify",      "probe", "shot",     "fly",     "bench",
          "sweep",   "cracks",   "costs",       "pops",  "prefetch", "audit",   "replay",
          "compare", "settings", "make-layers", "trace", "attach",   "schedule"}) {
        const std::set<std::string> options =
            optionsOf(runWorldy(folder, std::string(command) + " --help").output);
        EXPECT_TRUE(options.contains("--json")) << command;
        for (const auto& [option, names] : takers)
            EXPECT_EQ(options.contains(option), names.contains(command)) << command << " " << option;
    }
}

// Each must end with 2, one line on stderr that starts so, and nothing on stdout.
struct BadCommand {
    const char* arguments;
    const char* message;
};

void PrintTo(const BadCommand& command, std::ostream* out) {
    *out << command.arguments;
}

class BadCommands : public testing::TestWithParam<BadCommand> {};

TEST_P(BadCommands, EndWithTwoAndOneLineThatSaysWhy) {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "junk.chk") << "this is no chunk file";
    std::ofstream(folder.path() / "bad.toml") << "[lod]\ntau_px = 0\n";
    const Ran ran = runWorldy(folder, GetParam().arguments);
    EXPECT_EQ(ran.exitCode, 2) << ran.errors;
    EXPECT_THAT(ran.errors, StartsWith("worldy: "));
    EXPECT_THAT(ran.errors, HasSubstr(GetParam().message));
    EXPECT_EQ(std::count(ran.errors.begin(), ran.errors.end(), '\n'), 1) << ran.errors;
    EXPECT_EQ(ran.output, "");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "o.png"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "o.chk"));
}

INSTANTIATE_TEST_SUITE_P(
    CommandLine, BadCommands,
    testing::Values(
        BadCommand{"nonsense", "nonsense: no such file"}, BadCommand{"--nonsense", "--nonsense"},
        BadCommand{"bake", "SOURCE is required"}, BadCommand{"bake a.tif", "--output is required"},
        BadCommand{"bake a.tif -o o.chk", "a.tif"}, BadCommand{"bake junk.chk -o o.chk", "junk.chk"},
        BadCommand{"bake a.tif -o o.chk --chunk-size 34", "--chunk-size"},
        BadCommand{"bake a.tif -o o.chk --radius 0", "--radius"},
        BadCommand{"bake a.tif -o o.chk --radius nan", "--radius"},
        BadCommand{"bake a.tif -o o.chk --metres-per-unit 0", "--metres-per-unit"},
        BadCommand{"bake a.tif -o o.chk --metres-per-unit x", "--metres-per-unit"},
        BadCommand{"bake a.tif -o o.chk --compression-level 10", "--compression-level"},
        BadCommand{"bake a.tif -o o.chk --raw-bits 12", "--raw-bits"}, BadCommand{"info", "FILE is required"},
        BadCommand{"info none.chk", "none.chk"}, BadCommand{"info junk.chk", "junk.chk"},
        BadCommand{"verify junk.chk", "junk.chk"}, BadCommand{"probe junk.chk 1 2", "junk.chk"},
        BadCommand{"probe junk.chk 91 0", "LATITUDE"}, BadCommand{"shot none.chk -o o.png", "none.chk"},
        BadCommand{"shot junk.chk -o o.png", "junk.chk"},
        BadCommand{"shot junk.chk -o o.png --camera 1,2", "--camera"},
        BadCommand{"shot junk.chk -o o.png --size 5x5", "--size"},
        BadCommand{"shot junk.chk -o o.png --tau 0", "--tau"},
        BadCommand{"shot junk.chk -o o.png --colour-by mood",
                   "--colour-by: overlay.colour_by is 'mood'; expected one of \"none\""},
        BadCommand{"shot junk.chk -o o.png --set lod.tua_px=3",
                   "--set lod.tua_px=3: lod.tua_px is not a setting; did you mean lod.tau_px?"},
        BadCommand{"shot junk.chk -o o.png --layers none.toml", "none.toml: no such file"},
        BadCommand{"shot junk.chk -o o.png --regions none.toml", "none.toml: no such file"},
        BadCommand{"fly junk.chk --flight none.toml --regions bad.toml",
                   "bad.toml: line 1: lod is an unknown key"},
        BadCommand{"sweep junk.chk --flight none.toml --regions bad.toml", "bad.toml: line 1: lod is"},
        BadCommand{"--regions bad.toml",
                   "bad.toml: line 1: lod is an unknown key; expected tables [[region]]"},
        BadCommand{"shot junk.chk -o o.png --layers bad.toml", "bad.toml: line 1: lod is an unknown key"},
        BadCommand{"shot junk.chk -o o.png --set surface.layers=3",
                   "surface.layers is 3; expected layers, as [[layer]]"},
        BadCommand{"shot junk.chk -o o.png --set surface.layer_use=maybe", "\"automatic\", \"on\", \"off\""},
        BadCommand{"attach", "PORT is required"}, BadCommand{"attach 0", "PORT"},
        BadCommand{"attach 65536", "PORT"}, BadCommand{"attach x", "PORT"},
        BadCommand{"attach 9910 --seconds 0", "--seconds"},
        BadCommand{"attach 9910 --out none", "none: is no folder; expected a folder, or a new file"},
        BadCommand{"attach 9910 --out none/a.lodtrace", "none: is no folder"},
        BadCommand{"attach 9910 --out junk.chk", "junk.chk: is no folder"},
        BadCommand{"make-layers", "--output is required"}, BadCommand{"make-layers -o junk.chk", "junk.chk"},
        BadCommand{"make-layers -o made --texels 100", "--texels"},
        BadCommand{"make-layers -o made --size 16", "make-layers --size: removed; expected --texels"},
        BadCommand{"fly junk.chk --path a.toml", "fly --path: removed; expected --flight"},
        BadCommand{"fly junk.chk --flight a.toml --json out.json", "fly --json: removed; expected -o FILE"},
        BadCommand{"sweep junk.chk --flight a.toml --csv=s.csv", "sweep --csv: removed; expected -o"},
        BadCommand{"sweep junk.chk --flight a.toml --json s.json", "sweep --json: removed; expected -o"},
        BadCommand{"pops junk.chk --flight a.toml --frames 3 --step-s 1", "--frames"},
        BadCommand{"cracks junk.chk --frames 3", "--flight"},
        BadCommand{"shot junk.chk -o o.png --set lod.tau_px=0", "a number in [0.1, 64] px"},
        BadCommand{"shot junk.chk -o o.png --set", "--set"},
        BadCommand{"shot junk.chk -o o.png --settings none.toml", "none.toml: no such file"},
        BadCommand{"shot junk.chk -o o.png --settings bad.toml", "bad.toml: line 2: lod.tau_px is 0"},
        BadCommand{"fly junk.chk --flight none.toml --set lod.morph=2",
                   "lod.morph is 2; expected true or false"},
        BadCommand{"fly junk.chk --flight none.toml", "none.toml"}, BadCommand{"bench none.tif", "none.tif"},
        BadCommand{"bench --rounds 0", "--rounds"}, BadCommand{"bench --parts colour", "--parts"},
        BadCommand{"sweep junk.chk --flight none.toml", "none.toml"},
        BadCommand{"sweep junk.chk --flight none.toml --suggest speed=3", "--suggest: speed=3"},
        BadCommand{"sweep junk.chk --flight none.toml --chunk 34", "--chunk"},
        BadCommand{"fly junk.chk --flight bad.toml", "bad.toml: line 1: lod is unknown"},
        BadCommand{"replay", "FLIGHT is required"},
        BadCommand{"replay none.flight", "none.flight: no such file"},
        BadCommand{"replay junk.chk", "junk.chk: not a recorded flight"},
        BadCommand{"replay junk.chk --simulated --as-recorded", "--simulated"},
        BadCommand{"fly junk.chk --flight none.flight", "none.flight: no such file"},
        BadCommand{"junk.chk", "junk.chk"}, BadCommand{"--settings none.toml", "none.toml: no such file"},
        BadCommand{"--settings bad.toml",
                   "bad.toml: line 2: lod.tau_px is 0; expected a number in [0.1, 64] px"},
        BadCommand{"info junk.chk extra", "extra"}, BadCommand{"audit", "FILE is required"},
        BadCommand{"audit junk.chk", "junk.chk"}, BadCommand{"audit none.chk", "none.chk"},
        BadCommand{"audit junk.chk --camera 1,2", "--camera"},
        BadCommand{"audit junk.chk --metric best", "--metric: lod.metric is 'best'; expected one of"},
        BadCommand{"audit junk.chk --tau 100", "--tau: lod.tau_px is 100; expected a number in [0.1, 64] px"},
        BadCommand{"audit junk.chk --tau 0.05", "see worldy audit --help"},
        BadCommand{"bake a.tif -o o.chk --face-size 100", "--face-size: 100 is not valid; expected 2^n + 1"},
        BadCommand{"bake a.tif -o o.chk --colour-face-size x",
                   "--colour-face-size: x is not valid; expected 2^n"},
        BadCommand{"bake a.tif -o o.chk --colour-format jpg",
                   "--colour-format: jpg is not a colour format; expected bc1 or lossless"},
        BadCommand{"make-layers -o made --seed x",
                   "--seed: x is not valid; expected a whole number in [0, 4294967295]"},
        BadCommand{"compare junk.chk --flight none.toml --set-b x=1", "--set-b x=1: x is not a setting"},
        BadCommand{"sweep junk.chk --flight a.toml --tau 1,,2", "--tau: 1,,2 has an empty entry"},
        BadCommand{"sweep junk.chk --flight a.toml --tau=,2", "--tau: ,2 has an empty entry"},
        BadCommand{"sweep junk.chk --flight a.toml --tau 1,2,1", "--tau: 1 is given twice"},
        BadCommand{"sweep junk.chk --flight a.toml --metric tight,tight", "--metric: tight is given twice"},
        BadCommand{"info junk.chk -x y", "-x y: are not expected; see worldy info --help"},
        BadCommand{"audit junk.chk -o nodir/x.json", "nodir/x.json: cannot be written: "},
        BadCommand{"shot junk.chk -o x.xyz", "x.xyz: the extension names no picture format"},
        BadCommand{"audit junk.chk --step-s 2", "--flight"},
        BadCommand{"audit junk.chk --flight a.toml --step-s 0", "--step-s"},
        BadCommand{"compare junk.chk", "--flight is required"},
        BadCommand{"compare junk.chk --flight none.toml", "none.toml"},
        BadCommand{"compare junk.chk --flight none.toml --set-b lod.tua_px=3", "did you mean lod.tau_px?"},
        BadCommand{"compare junk.chk --flight none.toml --settings-a bad.toml",
                   "bad.toml: line 2: lod.tau_px is 0"},
        BadCommand{"compare junk.chk --flight none.toml --frames 0", "--frames"},
        BadCommand{"compare junk.chk --flight none.toml --size 5x5", "--size"}));

}  // namespace
}  // namespace worldy
