#include "app/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/app.h"
#include "app/audit_command.h"
#include "app/bake_command.h"
#include "app/bench_command.h"
#include "app/compare_command.h"
#include "app/costs_command.h"
#include "app/cracks_command.h"
#include "app/exit_code.h"
#include "app/file_commands.h"
#include "app/fly_command.h"
#include "app/layer_materials.h"
#include "app/pops_command.h"
#include "app/replay_command.h"
#include "app/shot_command.h"
#include "app/sweep_command.h"
#include "app/write_plan.h"

namespace worldy {

namespace {

using planet::Result;

constexpr const char* flightHelp = "The flight's keys, .toml, or a recorded .flight";

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
    command.add_option("--no-data", source.noDataValue,
                       "Value that means \"no data\", instead of a GeoTIFF's own; NaN always does");
    command.add_option("--fill", source.fillM, "Height of samples without data, metres (0)")
        ->check(number(-1e9, 1e9));
    command.add_option("--raw-size", source.rawSize, "Raw faces: samples a side")
        ->check(CLI::Range(2, (1 << 22) + 1));
    command.add_option("--raw-bits", source.rawBits, "Raw faces: 8 or 16")->check(CLI::IsMember({8, 16}));
    command.add_flag("--raw-signed", source.rawSigned, "Raw faces: 16-bit values are signed");
    command.add_flag("--raw-big-endian", source.rawBigEndian, "Raw faces: the high byte comes first");
}

void addBake(CLI::App& app, BakeOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "bake", "Bake an elevation image, six cube faces or made terrain into a chunk file");
    planet::BakeSettings& settings = options.settings;
    command.add_option("SOURCE", options.source,
                       "Elevation image, one of six cube faces or their common stem, a terrain as "
                       "noise:ridged,seed=7, or a preset as preset:moon");
    command.add_option("-o,--output", options.output, "Chunk file to write");
    command.add_flag("--list-presets", options.listPresets,
                     "Instead: list the presets, and the settings of all kinds of terrain");
    command
        .add_flag("--detail", options.detail,
                  "Add detail below the source's own resolution; --detail=strength=0.8,octaves=4 sets its "
                  "knobs")
        ->type_name("KNOBS");
    command.add_option("--face-size", settings.faceSize, "Samples a face's side, 2^n + 1 (the source's own)");
    command.add_option("--chunk-size", settings.chunkSize, "Vertices a chunk's side: 17, 33, 65 or 129 (33)")
        ->check(CLI::IsMember(std::vector<int>(planet::chunkSizes.begin(), planet::chunkSizes.end())));
    command.add_option("--radius", options.radiusM, "The planet's radius, metres (the preset's, or 6371000)")
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
    command.add_option("--colour", options.colour,
                       "Colour image, of the whole planet or of six faces, to be baked in too");
    command.add_option("--colour-face-size", settings.colour.faceSize,
                       "Colours a face's side, 2^n + 1 from 257 on (the image's own)");
    const std::map<std::string, planet::ColourFormat> formats = {
        {"bc1", planet::ColourFormat::Bc1}, {"lossless", planet::ColourFormat::Lossless}};
    command
        .add_option("--colour-format", settings.colour.format, "bc1: half a byte a texel; or lossless (bc1)")
        ->transform(CLI::CheckedTransformer(formats, CLI::ignore_case))
        ->option_text("bc1|lossless");
    command.add_flag("--json", options.json, "Report as JSON");
    addSourceOptions(command, options.sourceSettings);
}

void addMakeLayers(CLI::App& app, MakeLayersOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "make-layers",
        "Make the six materials of the texture layers, and the sets that use them, from noise");
    command.add_option("FOLDER", options.folder, "Where to write them")->required();
    command.add_option("--size", options.size, "Texels a side, a power of two (512)")
        ->check(CLI::IsMember(std::vector<int>{16, 32, 64, 128, 256, 512, 1024, 2048, 4096}));
    command.add_option("--seed", options.seed, "The same seed makes the same textures (1)");
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
    command.add_option(
        "--layers", view.layerSet,
        "A set of texture layers, .toml; draw them where the CPU draws with --set surface.layer_use=on");
    command.add_option("--size", view.size, "Picture size, WIDTHxHEIGHT (1280x720)");
    command.add_option("--tau", view.tauPx, "Tolerance on screen, pixels (2)")->check(number(1e-6, 1000));
    command.add_option("--budget", view.budgetMB, "Memory for resident chunks, MiB (256)")
        ->check(CLI::Range(16, 65536));
    command.add_flag("--no-culling", view.noCulling, "Also draw and load what is out of sight");
}

void addWorst(CLI::App& command, int& worst, const char* help) {
    command.add_option("--worst", worst, help)->check(CLI::Range(0, 1000000));
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
    command.add_option("--path", options.path, flightHelp)->required();
    command.add_option("--frames", options.frames, "Frames, evenly over the flight (300)")
        ->check(CLI::Range(1, 1000000));
    addViewOptions(command, view);
    command.add_option("--shaders", options.shaderFolder, "Read the shaders from this folder");
    command.add_option("--json", options.jsonOutput, "Write every frame's figures there");
}

void addBench(CLI::App& app, BenchOptions& options, ViewTexts& view) {
    CLI::App& command = *app.add_subcommand(
        "bench", "Measure LOD, streaming and the file's format, each beside a plain way to do the same");
    command.add_option("SOURCE", options.source, "Elevation image or cube faces (the Earth)");
    command
        .add_option("--faces", options.faceSizes,
                    "Samples a side, 2^n + 1, of the planets to bake (513 4097)")
        ->check(CLI::Range(33, 32769));
    command.add_option("--tau", options.tausPx, "Tolerances, pixels (1 2 4)")->check(number(0.1, 64));
    command.add_option("--rounds", options.rounds, "How often each is measured, in turn (5)")
        ->check(CLI::Range(1, 1000));
    command.add_option("--size", view.size, "Picture, WIDTHxHEIGHT (1280x720)");
    command
        .add_option("--parts", options.parts,
                    fmt::format("What is measured, of {} (all)", fmt::join(benchParts, ", ")))
        ->check(oneOf(benchParts));
    command.add_option("-o,--output", options.jsonOutput, "Write the figures there as JSON");
    addSourceOptions(command, options.sourceSettings);
}

// What a sweep's options are before they are understood.
struct SweepTexts {
    ViewTexts view;
    std::string cost = "triangles";
    std::string goal;
    std::vector<std::string> metrics;
};
constexpr std::array<std::string_view, 3> sweepCostNames = {"triangles", "frame_ms", "memory_mib"};

void addSweep(CLI::App& app, SweepOptions& options, SweepTexts& texts) {
    CLI::App& command =
        *app.add_subcommand("sweep", "Fly at many tolerances, and set what each costs beside its true error");
    command.add_option("FILE", options.file, "Chunk file, or what is baked for each chunk size")->required();
    command.add_option("--flight", options.flight, flightHelp)->required();
    command.add_option("--tau", options.tausPx, "Tolerances, pixels (0.5,1,2,4,8)")
        ->delimiter(',')
        ->check(number(0.1, 64));
    command.add_option("--chunk", options.chunkSizes, "Vertices a side of a chunk (33)")
        ->delimiter(',')
        ->check(CLI::IsMember(std::vector<int>(planet::chunkSizes.begin(), planet::chunkSizes.end())));
    command.add_option("--metric", texts.metrics, "Error metrics: additive, tight (both)")
        ->delimiter(',')
        ->check(oneOf(errorMetricNames));
    command.add_option("--frames", options.frames, "Moments of the flight, evenly spread (12)")
        ->check(CLI::Range(1, 100000));
    command.add_option("--cost", texts.cost, "What is paid: triangles, frame_ms or memory_mib (triangles)")
        ->check(oneOf(sweepCostNames));
    command.add_option("--suggest", texts.goal,
                       "Instead: the tau for triangles=N, frame_ms=N, memory_mib=N or error_px=N");
    command.add_option("--size", texts.view.size, "Picture, WIDTHxHEIGHT (1280x720)");
    command.add_option("--settings", texts.view.settingsFile, "Settings to fly with");
    command.add_option("--set", texts.view.assignments, "A setting to fly with, as lod.morph=false");
    command.add_option("--csv", options.csvOutput, "Write the table there");
    command.add_option("--json", options.jsonOutput, "Write the table there, as JSON");
    command.add_option("--plot", options.plotOutput, "Draw it there, .png");
    addSourceOptions(command, options.sourceSettings);
}

void addCracks(CLI::App& app, CracksOptions& options, ViewTexts& view) {
    CLI::App& command = *app.add_subcommand(
        "cracks", "Count crack pixels and what the skirts leave open; ends with 1 if anything leaks");
    command.add_option("FILE", options.file, "Chunk file")->required();
    command.add_option("--camera", view.camera,
                       "LAT,LON,ALT,HEADING,PITCH in degrees and metres above the radius (the whole planet)");
    command.add_option("--flight", options.flight,
                       "Views along a flight: its keys, .toml, or a recorded .flight");
    command.add_option("--step-s", options.stepS, "Seconds of the flight from view to view (1)")
        ->check(number(0.001, 86400));
    command.add_option("--seams", view.seams, "none, skirts or stitched (skirts)")
        ->check(CLI::IsMember({"none", "skirts", "stitched"}));
    addViewOptions(command, view);
    command.add_option("--fov", view.fovDeg, "Horizontal field of view, degrees (60)")->check(number(5, 150));
    addWorst(command, options.worst,
             "Crack clusters and gaps to list, the worst first; the report holds all (20)");
    command.add_flag(
        "--find-depth", options.findDepth,
        "Also find the smallest skirt depth and the smallest automatic factor that leak nothing");
    command.add_option("-o,--output", options.report, "Report to write, .json");
    command.add_option("--mark", options.markedPicture,
                       "Picture to write of the view that leaks most, cracks marked, .png");
    command.add_option("--shaders", options.shaderFolder, "Read the shaders from this folder");
}

void addCosts(CLI::App& app, CostsOptions& options, ViewTexts& view) {
    CLI::App& command = *app.add_subcommand(
        "costs", "Time a picture with each part of light and surface and without it, in turn");
    command.add_option("FILE", options.file, "Chunk file")->required();
    command.add_option("--camera", view.camera,
                       "LAT,LON,ALT,HEADING,PITCH in degrees and metres above the radius (the whole planet)");
    command.add_option("--rounds", options.rounds, "How often each is drawn (5)")->check(CLI::Range(1, 1000));
    addViewOptions(command, view);
    command.add_option("--fov", view.fovDeg, "Horizontal field of view, degrees (60)")->check(number(5, 150));
    command.add_option("--colour-image", options.colourImage,
                       "Picture laid over the planet (colour.jpg beside FILE)");
    command.add_option("-o,--output", options.jsonOutput, "Write the figures there as JSON");
}

void addPops(CLI::App& app, PopsOptions& options, ViewTexts& view) {
    CLI::App& command = *app.add_subcommand(
        "pops", "Fly a path with all loads on time, and tell how far each change of level jumps");
    command.add_option("FILE", options.file, "Chunk file")->required();
    command.add_option("--flight", options.flight, flightHelp)->required();
    command.add_option("--step-s", options.stepS, "Seconds of the flight between two frames (1/60)")
        ->check(number(1e-4, 1e4));
    addViewOptions(command, view);
    addWorst(command, options.worst, "Switches to list, the worst first; the report holds all (20)");
    command.add_option("-o,--output", options.output, "Write a report there, JSON");
}

// What a comparison's sides are told, as it is written: A and B.
using CompareTexts = std::array<ViewTexts, 2>;

void addCompare(CLI::App& app, CompareOptions& options, CompareTexts& texts) {
    CLI::App& command = *app.add_subcommand(
        "compare", "Fly with two settings or two bakes, A and B, and set their figures side by side");
    command.add_option("FILE", options.file, "Chunk file")->required();
    command.add_option("--flight", options.flight, flightHelp)->required();
    command.add_option("--with", options.fileOfB, "Chunk file of B (FILE)");
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const char letter = i == 0 ? 'a' : 'b';
        const char* const side = i == 0 ? "A" : "B";
        command.add_option(fmt::format("--settings-{}", letter), texts[i].settingsFile,
                           fmt::format("Settings of {}: a settings file, a preset, or a screenshot", side));
        command
            .add_option(fmt::format("--set-{}", letter), texts[i].assignments,
                        fmt::format("Any setting of {}, as lod.tau_px=3; may be given again and again", side))
            ->type_name("NAME=VALUE")
            ->expected(1)
            ->take_all()
            ->allow_extra_args(false);
    }
    command.add_option("--frames", options.moments, "Moments of the flight, evenly spread (12)")
        ->check(CLI::Range(1, 100000));
    command.add_option("--size", texts[0].size, "Picture size, WIDTHxHEIGHT (1280x720)");
    command.add_option("-o,--output", options.report, "Write the figures there, JSON");
    command.add_option(
        "--pictures", options.pictures,
        "Folder for pictures of the moment that differs most: side_by_side.png, difference.png");
}

// What only an audit is told, as it is written.
struct AuditTexts {
    ViewTexts view;
    std::vector<std::string> cameras;
    std::string metric;
};

void addAudit(CLI::App& app, AuditOptions& options, AuditTexts& texts) {
    CLI::App& command = *app.add_subcommand(
        "audit",
        "Measure the true error of what is drawn beside its bound; ends with 1 where that "
        "was too little");
    command.add_option("FILE", options.file, "Chunk file")->required();
    CLI::Option& cameras =
        *command.add_option("--camera", texts.cameras,
                            "LAT,LON,ALT,HEADING,PITCH in degrees and metres above the radius; may be given "
                            "again and again (the whole planet, and low over its most rugged ground)");
    cameras.expected(1)->take_all()->allow_extra_args(false);
    CLI::Option& flight = *command
                               .add_option("--flight", options.flight,
                                           "Views along a flight: its keys, .toml, or a recorded .flight")
                               ->excludes(&cameras);
    command.add_option("--step-s", options.stepS, "Seconds of the flight between its views (1)")
        ->check(number(1e-6, 1e9))
        ->needs(&flight);
    addViewOptions(command, texts.view);
    command.add_option("--fov", texts.view.fovDeg, "Horizontal field of view, degrees (60)")
        ->check(number(5, 150));
    command.add_option("--metric", texts.metric, "Which bound chooses and predicts: additive or tight")
        ->check(oneOf(errorMetricNames));
    command.add_option("-o,--output", options.jsonOutput, "Write every chunk of every view there, as JSON");
    addWorst(command, options.worst, "Chunks to list, the worst first; the report holds all (20)");
}

void addReplay(CLI::App& app, ReplayOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "replay", "Make a recorded flight again without a display, and tell whether every frame is the same");
    command.add_option("FLIGHT", options.flight, "Recorded flight, .flight")->required();
    command.add_option("FILE", options.file, "Chunk file (the one it was recorded over)");
    const auto set = [&options](ReplayPaging paging) {
        return [&options, paging](std::int64_t) { options.paging = paging; };
    };
    CLI::Option* simulated =
        command.add_flag_function("--simulated", set(ReplayPaging::Simulated),
                                  "Blocks arrive when the recorded bad disk and seed say, by simulated time");
    command
        .add_flag_function("--as-recorded", set(ReplayPaging::AsRecorded),
                           "Blocks arrive in the frames in which they did (this is what it does by itself)")
        ->excludes(simulated);
    command.add_option("-o,--output", options.output, "Write a report there, JSON");
    command
        .add_option("--set", options.assignments,
                    "A setting to hold at another value than the recorded one, as lod.tau_px=3; frames that "
                    "differ are then told, but are no failure")
        ->type_name("NAME=VALUE")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false);
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
    verify.add_option("--colour", options.colour,
                      "Also compare its colours with the image that they were baked from");
    addSourceOptions(verify, options.sourceSettings);
    CLI::App& probe = add("probe", "Tell the height at a place, and which chunks hold it");
    probe.add_option("LATITUDE", options.latitudeDeg, "Degrees north")->required()->check(number(-90, 90));
    probe.add_option("LONGITUDE", options.longitudeDeg, "Degrees east")->required()->check(number(-360, 360));
}

bool sameFile(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code status;
    return a == b || std::filesystem::equivalent(a, b, status);
}

// What all commands that look at a planet are told: the picture's size, and the settings, which are given
// back for what else a command wants of them.
template <typename Options>
Result<Settings> takeView(const ViewTexts& texts, Options& options) {
    const Result<PictureSize> size = pictureSizeFromText(texts.size);
    if (!size) return tl::unexpected(size.error());
    Result<Settings> settings = settingsFrom(texts);
    if (!settings) return settings;
    options.size = *size;
    options.view = settings->view;
    return settings;
}

// The same for those of one view.
template <typename Options>
Result<Settings> takeViewAndCamera(const ViewTexts& texts, Options& options) {
    Result<Settings> settings = takeView(texts, options);
    if (!settings) return settings;
    options.start = settings->camera;
    if (texts.camera.empty()) return settings;
    const Result<planet::CameraPose> pose = poseFromText(texts.camera);
    if (!pose) return tl::unexpected(pose.error());
    options.camera = *pose;
    return settings;
}

planet::ErrorMetric metricOf(const std::string& name) {
    return name == errorMetricNames[0] ? planet::ErrorMetric::Additive : planet::ErrorMetric::Tight;
}

Result<ShotOptions> understand(ShotOptions options, const ViewTexts& texts) {
    const Result<Settings> settings = takeViewAndCamera(texts, options);
    if (!settings) return tl::unexpected(settings.error());
    // The settings' picture belongs to the settings' data set.
    const bool sameData = settings->dataSet.empty() || sameFile(settings->dataSet, options.file);
    if (options.colourImage.empty() && sameData) options.colourImage = settings->colourImage;
    return options;
}

Result<CostsOptions> understand(CostsOptions options, const ViewTexts& texts) {
    return takeViewAndCamera(texts, options).map([&](const Settings&) { return options; });
}

Result<CracksOptions> understand(CracksOptions options, const ViewTexts& texts) {
    return takeViewAndCamera(texts, options).map([&](const Settings&) { return options; });
}

Result<BakeOptions> understand(BakeOptions options) {
    // A flag without a value reads "true".
    if (options.detail == "true") options.detail->clear();
    if (options.listPresets) return options;
    if (options.source.empty()) return planet::badInput("SOURCE is required; see worldy bake --help");
    if (options.output.empty()) return planet::badInput("--output is required; see worldy bake --help");
    return options;
}

Result<FlyOptions> understand(FlyOptions options, const ViewTexts& texts) {
    return takeView(texts, options).map([&](const Settings&) { return options; });
}

Result<PopsOptions> understand(PopsOptions options, const ViewTexts& texts) {
    return takeView(texts, options).map([&](const Settings&) { return options; });
}

Result<SweepOptions> understand(SweepOptions options, const SweepTexts& texts) {
    if (const Result<Settings> settings = takeView(texts.view, options); !settings)
        return tl::unexpected(settings.error());
    options.cost = static_cast<SweepCost>(
        std::find(sweepCostNames.begin(), sweepCostNames.end(), texts.cost) - sweepCostNames.begin());
    if (!texts.metrics.empty()) options.metrics.clear();
    for (const std::string& name : texts.metrics) options.metrics.push_back(metricOf(name));
    if (texts.goal.empty()) return options;
    const Result<TauGoal> goal = tauGoalFromText(texts.goal);
    if (!goal) return tl::unexpected(goal.error());
    options.goal = *goal;
    return options;
}

Result<BenchOptions> understand(BenchOptions options, const ViewTexts& texts) {
    const Result<PictureSize> size = pictureSizeFromText(texts.size);
    if (!size) return tl::unexpected(size.error());
    options.size = *size;
    return options;
}

Result<CompareOptions> understand(CompareOptions options, const CompareTexts& texts) {
    const Result<PictureSize> size = pictureSizeFromText(texts[0].size);
    if (!size) return tl::unexpected(size.error());
    options.size = *size;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const Result<Settings> settings = settingsFrom(texts[i]);
        if (!settings) return tl::unexpected(settings.error());
        options.settings[i] = settings->view;
    }
    return options;
}

Result<AuditOptions> understand(AuditOptions options, const AuditTexts& texts) {
    if (const Result<Settings> settings = takeView(texts.view, options); !settings)
        return tl::unexpected(settings.error());
    for (const std::string& text : texts.cameras) {
        const Result<planet::CameraPose> pose = poseFromText(text);
        if (!pose) return tl::unexpected(pose.error());
        options.cameras.push_back(*pose);
    }
    if (!texts.metric.empty()) options.metric = metricOf(texts.metric);
    return options;
}

// What a command reads besides what its options name.
void addInputs(CommandFiles& files, const SweepTexts& texts) {
    addInputs(files, texts.view);
}
void addInputs(CommandFiles& files, const AuditTexts& texts) {
    addInputs(files, texts.view);
}
void addInputs(CommandFiles& files, const CompareTexts& texts) {
    for (const ViewTexts& side : texts) addInputs(files, side);
}

// Runs a command whose outputs leave its inputs, and files of other kinds, as they are.
template <typename Options, typename Run>
auto runIfSafe(const Options& options, CommandFiles files, bool overwrite, const Run& run)
    -> decltype(run(options)) {
    if (const Result<void> safe = checkOutputs(files, overwrite); !safe) return tl::unexpected(safe.error());
    return run(options);
}

// Of a check: whether all is well.
int exitCodeOf(const Result<bool>& result) {
    if (!result) return reportError(result.error());
    return *result ? exitOk : exitCheckFailed;
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
    BenchOptions bench;
    ViewTexts benchView;
    SweepOptions sweep;
    SweepTexts sweepTexts;
    CracksOptions cracks;
    ViewTexts cracksView;
    CostsOptions costs;
    ViewTexts costsView;
    PopsOptions pops;
    ViewTexts popsView;
    AuditOptions audit;
    AuditTexts auditTexts;
    ReplayOptions replay;
    CompareOptions compare;
    CompareTexts compareTexts;
    MakeLayersOptions makeLayers;
    bool overwrite = false;  // outputs may replace files of other kinds

    CommandLine() {
        app.set_version_flag("--version", "worldy " WORLDY_VERSION);
        app.add_option("FILE", window.file,
                       "Chunk file (.chk), elevation image, cube faces, terrain (noise:ridged) or preset "
                       "(preset:moon) to show");
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
        addBench(app, bench, benchView);
        addSweep(app, sweep, sweepTexts);
        addCracks(app, cracks, cracksView);
        addCosts(app, costs, costsView);
        addPops(app, pops, popsView);
        addAudit(app, audit, auditTexts);
        addReplay(app, replay);
        addCompare(app, compare, compareTexts);
        addMakeLayers(app, makeLayers);
        for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
            const std::string name = command->get_name();
            if (name == "info" || name == "verify" || name == "probe") continue;  // write no files
            command->add_flag("--overwrite", overwrite, "Let outputs replace files of other kinds too");
        }
        app.require_subcommand(0, 1);
    }
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;
};

planet::Error errorOf(const CLI::ParseError& error) {
    return {planet::ErrorKind::BadInput, fmt::format("{}; see worldy --help", error.what())};
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
        return planet::badInput("not a worldy shot command; expected worldy shot FILE -o PICTURE");
    return understand(line.shot, line.shotView);
}

namespace {

int runCommand(int argumentCount, const char* const* arguments) {
    CommandLine line;
    const CLI::App& app = line.app;
    try {
        line.app.parse(argumentCount, arguments);
    } catch (const CLI::ParseError& error) {
        return error.get_exit_code() == 0 ? app.exit(error) : reportError(errorOf(error));
    }
    // Checks what would be written, and runs the command.
    const auto safely = [&line](const auto& options, auto run) {
        return runIfSafe(options, filesOf(options), line.overwrite, run);
    };
    const auto view = [&line](auto& options, const auto& texts, auto run) {
        return [&line, &options, &texts, run] {
            return exitCodeOf(understand(options, texts).and_then([&](const auto& understood) {
                CommandFiles files = filesOf(understood);
                addInputs(files, texts);
                return runIfSafe(understood, std::move(files), line.overwrite, run);
            }));
        };
    };
    const std::vector<std::pair<const char*, std::function<int()>>> commands = {
        {"bake",
         [&] {
             return exitCodeOf(understand(line.bake).and_then(
                 [&](const BakeOptions& options) { return safely(options, runBake); }));
         }},
        {"info", [&] { return exitCodeOf(runInfo(line.file)); }},
        {"verify", [&] { return exitCodeOf(runVerify(line.file)); }},
        {"probe", [&] { return exitCodeOf(runProbe(line.file)); }},
        {"replay", [&] { return exitCodeOf(safely(line.replay, replayFlight)); }},
        {"shot", view(line.shot, line.shotView, takeShot)},
        {"fly", view(line.fly, line.flyView, flyPath)},
        {"sweep", view(line.sweep, line.sweepTexts, runSweep)},
        {"bench", view(line.bench, line.benchView, runBench)},
        {"cracks", view(line.cracks, line.cracksView, runCracks)},
        {"costs", view(line.costs, line.costsView, runCosts)},
        {"pops", view(line.pops, line.popsView, runPops)},
        {"audit", view(line.audit, line.auditTexts, runAudit)},
        {"compare", view(line.compare, line.compareTexts, runCompare)},
        {"make-layers", [&] { return exitCodeOf(safely(line.makeLayers, makeLayers)); }},
    };
    for (const auto& [name, run] : commands) {
        if (app.got_subcommand(name)) return run();
    }
    const CommandFiles files = filesOf(line.window);
    const Result<void> safe = checkNotInputs(files).and_then([&] { return checkKinds(files.outputs); });
    if (!safe) return reportError(safe.error());
    return runApp(line.window);
}

}  // namespace

int runCommandLine(int argumentCount, const char* const* arguments) {
    occupyStandardStreams();
    try {
        return afterStandardOutput(runCommand(argumentCount, arguments));
    } catch (const std::system_error&) {
        // fmt::print throws where standard output takes no more.
        if (std::ferror(stdout) == 0) throw;
        return afterStandardOutput(exitBadInput);
    }
}

}  // namespace worldy
