#include "app/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <filesystem>
#include <string>
#include <vector>

#include "app/app.h"
#include "app/bake_command.h"
#include "app/exit_code.h"
#include "app/file_commands.h"
#include "app/fly_command.h"
#include "app/shot_command.h"
#include "planet/chunk_file.h"

namespace worldy {

namespace {

using planet::Result;

template <std::size_t count>
CLI::IsMember oneOf(const std::array<std::string_view, count>& names) {
    return CLI::IsMember(std::vector<std::string>(names.begin(), names.end()));
}

// CLI11's own range lets "nan" through.
CLI::Validator number(double min, double max, bool zeroToo = true) {
    const std::string wanted = fmt::format("a number from {} to {}{}", min, max, zeroToo ? "" : " but 0");
    const auto check = [=](const std::string& text) {
        double value = 0;
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool good =
            problem == std::errc{} && end == text.data() + text.size() && value >= min && value <= max;
        return good && (zeroToo || value != 0) ? std::string() : fmt::format("{} is not {}", text, wanted);
    };
    return CLI::Validator(check, "");
}

void addSourceOptions(CLI::App& command, planet::HeightSourceSettings& source) {
    command.add_option("--metres-per-unit", source.metresPerUnit, "Metres a unit of the source's values (1)")
        ->check(number(-1e9, 1e9, false));
    command.add_option("--offset", source.offsetM, "Metres added to every height (0)")
        ->check(number(-1e9, 1e9));
    command.add_option("--no-data", source.noDataValue, "Value that means \"no data\"; NaN always does");
    command.add_option("--fill", source.fillM, "Height of samples without data, metres (0)")
        ->check(number(-1e9, 1e9));
    command.add_option("--raw-size", source.rawSize, "Raw faces: samples a side")
        ->check(CLI::Range(2, (1 << 22) + 1));
    command.add_option("--raw-bits", source.rawBits, "Raw faces: 8 or 16")->check(CLI::IsMember({8, 16}));
    command.add_flag("--raw-signed", source.rawSigned, "Raw faces: 16-bit values are signed");
    command.add_flag("--raw-big-endian", source.rawBigEndian, "Raw faces: the high byte comes first");
}

void addBake(CLI::App& app, BakeOptions& options) {
    CLI::App& command =
        *app.add_subcommand("bake", "Bake an elevation image or six cube faces into a chunk file");
    planet::BakeSettings& settings = options.settings;
    command
        .add_option("SOURCE", options.source,
                    "Elevation image, or one of six cube faces or their common stem")
        ->required();
    command.add_option("-o,--output", options.output, "Chunk file to write")->required();
    command.add_option("--face-size", settings.faceSize, "Samples a face's side, 2^n + 1 (the source's own)");
    command.add_option("--chunk-size", settings.chunkSize, "Vertices a chunk's side: 17, 33, 65 or 129 (33)")
        ->check(CLI::IsMember(std::vector<int>(planet::chunkSizes.begin(), planet::chunkSizes.end())));
    command.add_option("--radius", settings.radiusM, "The planet's radius, metres (6371000)")
        ->check(number(1e-3, 1e9));
    command.add_option("--quantum", settings.quantumM, "Metres a stored step (the source's own)")
        ->check(number(1e-9, 1e6));
    command.add_option("--threads", settings.threads, "Threads; 0: one a core (0)")
        ->check(CLI::Range(0, 1024));
    command
        .add_option("--compression-level", settings.compressionLevel,
                    fmt::format("{} largest file, {} slowest bake ({})", planet::minCompressionLevel,
                                planet::maxCompressionLevel, planet::defaultCompressionLevel))
        ->check(CLI::Range(planet::minCompressionLevel, planet::maxCompressionLevel));
    command.add_option("--debug-levels", settings.debugLevelsFolder,
                       "Also write each level of each face there as PNG");
    command.add_flag("--json", options.json, "Report as JSON");
    addSourceOptions(command, options.sourceSettings);
}

void addViewOptions(CLI::App& command, ViewTexts& view) {
    command.add_option("--settings", view.settingsFile,
                       "Settings to start from: a settings file, a preset, or a screenshot by Worldy");
    command
        .add_option("--set", view.assignments,
                    "Any setting, as lod.tau_px=3; may be given again and again, and wins over the others")
        ->type_name("NAME=VALUE")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false);
    command.add_option("--size", view.size, "Picture size, WIDTHxHEIGHT (1280x720)");
    command.add_option("--tau", view.tauPx, "Tolerance on screen, pixels (2)")->check(number(1e-6, 1000));
    command.add_option("--budget", view.budgetMB, "Memory for resident chunks, MiB (256)")
        ->check(CLI::Range(16, 65536));
    command.add_flag("--no-culling", view.noCulling, "Also draw and load what is out of sight");
}

void addShot(CLI::App& app, ShotOptions& options, ViewTexts& view) {
    CLI::App& command = *app.add_subcommand("shot", "Draw one picture of a chunk file, without a display");
    command.add_option("FILE", options.file, "Chunk file")->required();
    command.add_option("-o,--output", options.output, "Picture to write, .png")->required();
    command.add_option("--camera", view.camera,
                       "LAT,LON,ALT,HEADING,PITCH in degrees and metres above the radius (the whole planet)");
    addViewOptions(command, view);
    command.add_option("--fov", view.fovDeg, "Horizontal field of view, degrees (60)")->check(number(5, 150));
    command.add_option("--samples", options.samples, "Multisampling, samples a pixel (4)")
        ->check(CLI::Range(1, 16));
    command.add_flag("--wireframe", view.wireframe, "Draw the triangles' edges");
    command.add_flag("--no-skirts", view.noSkirts,
                     "Leave out the skirts that hide cracks: short for --set seams.mode=none");
    command.add_flag("--cube", view.cube, "Draw the cube before it is blown up to the sphere");
    command
        .add_option("--colour-by", view.colourBy,
                    fmt::format("What a chunk's tint shows: {} (none)", fmt::join(colourByNames, ", ")))
        ->check(oneOf(colourByNames));
    command.add_option("--surface", view.surface, "Colour of the ground: image or ramp (image)")
        ->check(oneOf(surfaceNames));
    command.add_option("--colour-image", options.colourImage,
                       "Picture laid over the planet (colour.jpg beside FILE)");
    command.add_option("--shaders", options.shaderFolder, "Read the shaders from this folder");
    command.add_flag("--json", options.json, "Print what was drawn as JSON");
}

void addFly(CLI::App& app, FlyOptions& options, ViewTexts& view) {
    CLI::App& command =
        *app.add_subcommand("fly", "Fly a recorded path without a display, and measure each frame");
    command.add_option("FILE", options.file, "Chunk file")->required();
    command.add_option("--path", options.path, "The flight's keys, .toml")->required();
    command.add_option("--frames", options.frames, "Frames, evenly over the flight (300)")
        ->check(CLI::Range(1, 1000000));
    addViewOptions(command, view);
    command.add_option("--shaders", options.shaderFolder, "Read the shaders from this folder");
    command.add_option("--json", options.jsonOutput, "Write every frame's figures there");
}

void addFileCommands(CLI::App& app, FileCommandOptions& options) {
    const auto add = [&](const char* name, const char* about) -> CLI::App& {
        CLI::App& command = *app.add_subcommand(name, about);
        command.add_option("FILE", options.file, "Chunk file")->required();
        command.add_flag("--json", options.json, "Report as JSON");
        return command;
    };
    add("info", "Tell what a chunk file holds");
    CLI::App& verify = add("verify", "Read the whole of a chunk file and check it");
    verify.add_option("--source", options.source,
                      "Also compare it with the source that it was baked from, given with the same options");
    addSourceOptions(verify, options.sourceSettings);
    CLI::App& probe = add("probe", "Tell the height at a place, and which chunks hold it");
    probe.add_option("LATITUDE", options.latitudeDeg, "Degrees north")->required()->check(number(-90, 90));
    probe.add_option("LONGITUDE", options.longitudeDeg, "Degrees east")->required()->check(number(-360, 360));
}

bool sameFile(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code status;
    return a == b || std::filesystem::equivalent(a, b, status);
}

Result<ShotOptions> withView(ShotOptions options, const ViewTexts& texts) {
    const Result<PictureSize> size = pictureSizeFromText(texts.size);
    if (!size) return tl::unexpected(size.error());
    options.size = *size;
    if (!texts.camera.empty()) {
        const Result<planet::CameraPose> pose = poseFromText(texts.camera);
        if (!pose) return tl::unexpected(pose.error());
        options.camera = *pose;
    }
    const Result<Settings> settings = settingsFrom(texts);
    if (!settings) return tl::unexpected(settings.error());
    options.view = settings->view;
    options.start = settings->camera;
    // The settings' picture belongs to the settings' data set.
    const bool sameData = settings->dataSet.empty() || sameFile(settings->dataSet, options.file);
    if (options.colourImage.empty() && sameData) options.colourImage = settings->colourImage;
    return options;
}

Result<void> runFly(FlyOptions options, const ViewTexts& texts) {
    const Result<PictureSize> size = pictureSizeFromText(texts.size);
    if (!size) return tl::unexpected(size.error());
    const Result<Settings> settings = settingsFrom(texts);
    if (!settings) return tl::unexpected(settings.error());
    options.size = *size;
    options.view = settings->view;
    return flyPath(options);
}

int exitCodeOf(const Result<void>& result) {
    return result ? exitOk : reportError(result.error());
}

// All options, and where what was given goes. The parser points into it, so it stays where it is.
struct CommandLine {
    CLI::App app{
        "Worldy: shows, tunes and measures planets drawn by chunked level of detail.\n"
        "Without a command it opens a window on FILE, or on the Earth.",
        "worldy"};
    AppOptions window;
    BakeOptions bake;
    FileCommandOptions file;
    ShotOptions shot;
    ViewTexts shotView;
    FlyOptions fly;
    ViewTexts flyView;

    CommandLine() {
        app.set_version_flag("--version", "worldy " WORLDY_VERSION);
        app.add_option("FILE", window.file, "Chunk file (.chk), elevation image or cube faces to show");
        app.add_option("--settings", window.settingsFile, "Settings to use instead of the user's own");
        app.add_option("--shaders", window.shaderFolder,
                       "Read the shaders from this folder, and again when they change");
        app.add_option(
            "--item-map", window.itemMapFile,
            "Keep writing there where each control is on the screen, and what is counted, for scripts");
        addBake(app, bake);
        addFileCommands(app, file);
        addShot(app, shot, shotView);
        addFly(app, fly, flyView);
        app.require_subcommand(0, 1);
    }
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;
};

planet::Error errorOf(const CLI::ParseError& error) {
    return {planet::ErrorKind::BadInput,
            fmt::format("{}; worldy --help tells what would be right", error.what())};
}

}  // namespace

Result<ShotOptions> shotOptionsFrom(std::span<const char* const> arguments) {
    CommandLine line;
    try {
        line.app.parse(static_cast<int>(arguments.size()), arguments.data());
    } catch (const CLI::ParseError& error) {
        return tl::unexpected(errorOf(error));
    }
    if (!line.app.got_subcommand("shot"))
        return planet::badInput("this is no `worldy shot`; worldy shot FILE -o PICTURE would be right");
    return withView(line.shot, line.shotView);
}

int runCommandLine(int argumentCount, const char* const* arguments) {
    CommandLine line;
    const CLI::App& app = line.app;
    try {
        line.app.parse(argumentCount, arguments);
    } catch (const CLI::ParseError& error) {
        return error.get_exit_code() == 0 ? app.exit(error) : reportError(errorOf(error));
    }
    if (app.got_subcommand("bake")) return exitCodeOf(runBake(line.bake));
    if (app.got_subcommand("info")) return exitCodeOf(runInfo(line.file));
    if (app.got_subcommand("verify")) return exitCodeOf(runVerify(line.file));
    if (app.got_subcommand("probe")) return exitCodeOf(runProbe(line.file));
    if (app.got_subcommand("shot")) return exitCodeOf(withView(line.shot, line.shotView).and_then(takeShot));
    if (app.got_subcommand("fly")) return exitCodeOf(runFly(line.fly, line.flyView));
    return runApp(line.window);
}

}  // namespace worldy
