#include "app/cli/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "app/base/exit_code.h"
#include "app/bench/bench_command.h"
#include "app/cli/app.h"
#include "app/cli/atlas_command.h"
#include "app/cli/attach_command.h"
#include "app/cli/audit_command.h"
#include "app/cli/bake_command.h"
#include "app/cli/command_options.h"
#include "app/cli/compare_command.h"
#include "app/cli/costs_command.h"
#include "app/cli/cracks_command.h"
#include "app/cli/file_commands.h"
#include "app/cli/fly_command.h"
#include "app/cli/pops_command.h"
#include "app/cli/prefetch_command.h"
#include "app/cli/replay_command.h"
#include "app/cli/schedule_command.h"
#include "app/cli/settings_command.h"
#include "app/cli/shot_command.h"
#include "app/cli/suggest_command.h"
#include "app/cli/sweep_command.h"
#include "app/cli/trace_command.h"
#include "app/cli/trace_what_if_text.h"
#include "app/cli/write_plan.h"
#include "app/data/layer_materials.h"
#include "app/data/worlds.h"
#include "app/settings/camera_text.h"
#include "app/settings/region_file.h"
#include "app/settings/settings_text.h"
#include "app/settings/view_options.h"
#include "planet/source/height_source.h"
#include "planet/source/terrain.h"

namespace worldy {

namespace {

using planet::Result;

template <std::size_t count>
CLI::IsMember oneOf(const std::array<std::string_view, count>& names) {
    return CLI::IsMember(std::vector<std::string>(names.begin(), names.end()));
}

std::optional<planet::ColourFormat> colourFormatNamed(const std::string& text) {
    const std::string name = CLI::detail::to_lower(text);
    if (name == "bc1") return planet::ColourFormat::Bc1;
    return name == "lossless" ? std::optional(planet::ColourFormat::Lossless) : std::nullopt;
}

void addColourFormat(CLI::App& command, planet::ColourBakeSettings& colour) {
    const auto check = [](const std::string& text) {
        return colourFormatNamed(text)
                   ? std::string()
                   : fmt::format("{} is not a colour format; expected bc1 or lossless", text);
    };
    const std::function<void(const std::string&)> take = [&colour](const std::string& text) {
        colour.format = colourFormatNamed(text).value_or(colour.format);
    };
    command
        .add_option_function("--colour-format", take,
                             "Colour format: bc1 (0.5 bytes per texel) or lossless (bc1)")
        ->check(CLI::Validator(check, ""))
        ->option_text("bc1|lossless");
}

void addBake(CLI::App& command, BakeOptions& options) {
    planet::BakeSettings& settings = options.settings;
    command.add_option(
        "SOURCE", options.sources,
        "Elevation image, georeferenced rasters (several, or a pattern such as 'tiles/*.tif'), "
        "one of six cube faces or their common stem, a world file (.toml), procedural terrain "
        "(noise:ridged,seed=7), or a preset (preset:moon)");
    command.add_flag("--list-presets", options.listPresets,
                     "List the presets and the settings of procedural terrain instead of baking");
    command
        .add_flag("--detail", options.detail,
                  "Add fractal detail below the source's resolution; --detail=strength=0.8,octaves=4 sets "
                  "its parameters")
        ->type_name("PARAMETERS");
    command
        .add_option("--face-size", settings.faceSize,
                    "Samples per face side, 2^n + 1 (the source's resolution)")
        ->check(faceSize());
    command.add_option("--chunk-size", settings.chunkSize, "Vertices per chunk side: 17, 33, 65 or 129 (33)")
        ->check(CLI::IsMember(std::vector<int>(planet::chunkSizes.begin(), planet::chunkSizes.end())));
    command.add_option("--radius", options.radiusM, "Planet radius, metres (the preset's, or 6371000)")
        ->check(number(planet::leastRadiusM, planet::mostRadiusM));
    command
        .add_option("--quantum", settings.quantumM,
                    "Quantisation step of stored heights, metres (the source's step)")
        ->check(number(1e-9, 1e6));
    command
        .add_option("--finest-quantum", settings.finestQuantumM,
                    "Finest quantisation step of heights where the source is finer than --quantum, metres; a "
                    "power-of-two fraction of it that is as fine (what the source needs, or --quantum if "
                    "given)")
        ->check(number(1e-9, 1e6));
    command.add_option("--threads", settings.threads, "Threads; 0: one per core (0)")
        ->check(CLI::Range(0, 1024));
    command
        .add_option(
            "--compression-level", settings.compressionLevel,
            fmt::format("Compression level, from {} (largest file) to {} (smallest file, slowest bake) ({})",
                        planet::minCompressionLevel, planet::maxCompressionLevel,
                        planet::defaultCompressionLevel))
        ->check(CLI::Range(planet::minCompressionLevel, planet::maxCompressionLevel));
    command.add_option("--reuse", settings.reuse,
                       "Earlier bake, perhaps the output itself, to copy unchanged chunks from");
    command.add_flag(
        "--resume", options.resume,
        "Go on with the finished units of a bake that did not end, which lie beside the output in "
        "OUT.chk.spool; keep them in the same way");
    command.add_flag("--progress-json", options.progressJson,
                     "Write the progress to standard error as lines of JSON");
    command.add_option("--debug-levels", settings.debugLevelsFolder,
                       "Also write each level of each face as PNG to this folder");
    command.add_option("--colour", options.colour,
                       "Colour image of the whole planet, or of six cube faces, to bake into the file");
    command
        .add_option("--colour-face-size", settings.colour.faceSize,
                    "Colour texels per face side, 2^n + 1, at least 257 (the image's resolution)")
        ->check(faceSize());
    addColourFormat(command, settings.colour);
}

void addMakeLayers(CLI::App& command, MakeLayersOptions& options) {
    command.add_option("--texels", options.texels, "Texels per side, a power of two (512)")
        ->check(CLI::IsMember(std::vector<int>{16, 32, 64, 128, 256, 512, 1024, 2048, 4096}));
    command.add_option("--seed", options.seed, "Seed of the textures (1)")
        ->check(wholeNumber(0, std::numeric_limits<std::uint32_t>::max()));
}

void addShot(CLI::App& command, ShotOptions& options, ViewTexts& view) {
    command.add_option("FILE", options.file, "Chunk file")->required();
    command.add_option("--samples", options.samples, "Multisampling, samples per pixel (4)")
        ->check(CLI::Range(1, 16));
    addSettingFlag(command, "--wireframe", {"overlay.wireframe=true"}, "Draw triangle edges", view);
    addSettingFlag(command, "--no-skirts", {"seams.mode=none"}, "Draw no skirts", view);
    addSettingFlag(command, "--cube", {"overlay.cube=true"}, "Draw the unprojected cube", view);
    addSettingOption(command, "--colour-by", defaultField("overlay.colour_by"), view);
    addSettingOption(command, "--surface", defaultField("surface.colour"), view);
    command.add_option("--colour-image", options.colourImage,
                       "Colour image of the planet (colour.jpg beside FILE)");
    command.add_option(
        "--source", options.source,
        "Source of FILE, such as a world file, for --colour-by source and the outlines of its layers");
    command.add_option("--shaders", options.shaderFolder, "Folder to read the shaders from");
}

void addFly(CLI::App& command, FlyOptions& options, ViewTexts& view) {
    command.add_option("FILE", options.file, "Chunk file")->required();
    command.add_option("--shaders", options.shaderFolder, "Folder to read the shaders from");
    command.add_option("--trace", options.trace, "Trace to write of the frames, for worldy trace");
    addSettingOption(command, "--budget-cpu-ms", defaultField("budget.cpu_ms"), view);
    addSettingOption(command, "--budget-gpu-ms", defaultField("budget.gpu_ms"), view);
    addSettingOption(command, "--budget-triangles", defaultField("budget.triangles"), view);
    addSettingOption(command, "--budget-memory", defaultField("budget.memory_mb"), view);
    addSettingOption(command, "--budget-mb-per-second", defaultField("budget.read_mb_s"), view);
    addSettingOption(command, "--prefetch", defaultField("paging.prefetch"), view);
    addSettingOption(command, "--prefetch-horizon", defaultField("paging.prefetch_horizon_s"), view);
    addSettingOption(command, "--prefetch-share", defaultField("paging.prefetch_share"), view);
}

void addBench(CLI::App& command, BenchOptions& options) {
    CLI::Option* const source =
        command.add_option("SOURCE", options.source, "Elevation image or cube faces (the Earth)");
    CLI::Option* const faces =
        command
            .add_option("--faces", options.faceSizes,
                        "Samples per face side, 2^n + 1, of the planets to bake (513 4097)")
            ->check(CLI::Range(33, 32769));
    CLI::Option* const rounds =
        command.add_option("--rounds", options.rounds, "Measurements of each, in alternation (5)")
            ->check(CLI::Range(1, 1000));
    CLI::Option* const parts =
        command
            .add_option("--parts", options.parts,
                        fmt::format("Parts to measure: {} (all)", fmt::join(benchParts, ", ")))
            ->check(oneOf(benchParts));
    command
        .add_option("--compare", options.compared,
                    "Measures nothing and compares two reports: what got slower by more than its noise. Ends "
                    "with 1 if anything did")
        ->expected(2)
        ->type_name("A.json B.json")
        ->excludes(source)
        ->excludes(faces)
        ->excludes(rounds)
        ->excludes(parts);
}

// The options of a sweep, unparsed.
struct SweepTexts {
    std::string cost = "triangles";
    std::string goal;
    std::vector<std::string> metrics;
};
constexpr std::array<std::string_view, 3> sweepCostNames = {"triangles", "frame_ms", "memory_mib"};

void addSweep(CLI::App& command, SweepOptions& options, SweepTexts& texts) {
    command.add_option("FILE", options.file, "Chunk file, or a source to bake for each chunk size")
        ->required();
    command.add_option("--chunk", options.chunkSizes, "Vertices per chunk side (33)")
        ->delimiter(',')
        ->check(CLI::IsMember(std::vector<int>(planet::chunkSizes.begin(), planet::chunkSizes.end())));
    command.add_option("--metric", texts.metrics, "Error metrics: additive, tight (both)")
        ->delimiter(',')
        ->check(oneOf(errorMetricNames));
    command.add_option("--cost", texts.cost, "Cost: triangles, frame_ms or memory_mib (triangles)")
        ->check(oneOf(sweepCostNames));
    command.add_option("--suggest", texts.goal,
                       "Find the tau that meets triangles=N, frame_ms=N, memory_mib=N or error_px=N instead");
    command.add_option("--plot", options.plotOutput, "Plot to write, .png");
}

void addCracks(CLI::App& command, CracksOptions& options, ViewTexts& view) {
    command.add_option("FILE", options.file, "Chunk file")->required();
    addSettingOption(command, "--seams", defaultField("seams.mode"), view);
    command.add_flag(
        "--find-depth", options.findDepth,
        "Also find the smallest skirt depth and the smallest automatic factor that leave no uncovered pixel");
    command.add_option(
        "--mark", options.markedPicture,
        "Picture to write of the view with the most uncovered pixels, with cracks marked, .png");
    command.add_option("--shaders", options.shaderFolder, "Folder to read the shaders from");
}

void addCosts(CLI::App& command, CostsOptions& options) {
    command.add_option("FILE", options.file, "Chunk file")->required();
    command.add_option("--rounds", options.rounds, "Number of measurements of each (5)")
        ->check(CLI::Range(1, 1000));
    command.add_option("--colour-image", options.colourImage,
                       "Colour image of the planet (colour.jpg beside FILE)");
}

void addSchedule(CLI::App& command, ScheduleOptions& options) {
    command
        .add_option("FILE", options.file,
                    "What worldy bake --json has printed, run with --resume or on several ranks")
        ->required();
    command.add_option("--ranks", options.ranks, "Numbers of ranks, separated by commas (1,8,64,512)")
        ->delimiter(',')
        ->check(CLI::Range(1, 1'000'000));
    command.add_option("--threads", options.threads, "Threads of a rank (1)")->check(CLI::Range(1, 1024));
    command
        .add_option("--bandwidth", options.megabytesPerS,
                    "Bandwidth of the file system, which all ranks share, MB/s (1000)")
        ->check(number(1e-3, 1e9));
}

void addPops(CLI::App& command, PopsOptions& options) {
    command.add_option("FILE", options.file, "Chunk file")->required();
}

struct PrefetchTexts {
    std::vector<std::string> modes;
};

void addPrefetch(CLI::App& command, PrefetchOptions& options, PrefetchTexts& texts, ViewTexts& view) {
    command.add_option("FILE", options.file, "Chunk file")->required();
    command.add_option("--predict", texts.modes, "Ways of prefetching: off, motion, announced (all)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(oneOf(prefetchModeNames));
    command
        .add_option("--disk-mb-s", options.disksMBs,
                    "10^6 bytes per second of a loader, 0 is unlimited (2,8,32)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(number(0, 1e5));
    command
        .add_option("--disk-ms", options.latenciesMs,
                    "Latency of a read, ms, varied by +-50 % (bad_disk.latency_ms of the settings)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(number(0, 1e4));
    command.add_option("--speeds", options.speeds, "Speeds, as factors of the flight's own (0.5,1,2)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(number(0.01, 100));
    command
        .add_option("--horizons-s", options.horizonsS,
                    "Horizons of the prediction, s (paging.prefetch_horizon_s of the settings)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(number(0.1, 60));
    addSettingOption(command, "--prefetch-share", defaultField("paging.prefetch_share"), view);
}

// The settings of one side of a comparison, unparsed: A and B.
struct SideTexts {
    std::filesystem::path settingsFile;
    std::vector<std::string> assignments;
};
using CompareTexts = std::array<SideTexts, 2>;

void addCompare(CLI::App& command, CompareOptions& options, CompareTexts& texts) {
    command.add_option("FILE", options.file, "Chunk file")->required();
    command.add_option("--with", options.fileOfB, "Chunk file of B (FILE)");
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const char letter = i == 0 ? 'a' : 'b';
        const char* const side = i == 0 ? "A" : "B";
        command.add_option(fmt::format("--settings-{}", letter), texts[i].settingsFile,
                           fmt::format("Settings of {}: a settings file, a preset, or a screenshot", side));
        command
            .add_option(fmt::format("--set-{}", letter), texts[i].assignments,
                        fmt::format("Any setting of {}, for example lod.tau_px=3; may be repeated", side))
            ->type_name("NAME=VALUE")
            ->expected(1)
            ->take_all()
            ->allow_extra_args(false);
    }
    command.add_option(
        "--pictures", options.pictures,
        "Folder for pictures of the frame that differs most: side_by_side.png, difference.png");
}

void addAudit(CLI::App& command, AuditOptions& options, ViewTexts& view) {
    command.add_option("FILE", options.file, "Chunk file")->required();
    addSettingOption(command, "--metric", defaultField("lod.metric"), view);
}

void addReplay(CLI::App& command, ReplayOptions& options) {
    command.add_option("FLIGHT", options.flight, "Recorded flight, .flight")->required();
    command.add_option("FILE", options.file, "Chunk file (the one it was recorded over)");
    const auto set = [&options](ReplayPaging paging) {
        return [&options, paging](std::int64_t) { options.paging = paging; };
    };
    CLI::Option* simulated = command.add_flag_function(
        "--simulated", set(ReplayPaging::Simulated),
        "Blocks arrive according to the recorded fault-injection settings and seed, in simulated time");
    command
        .add_flag_function("--as-recorded", set(ReplayPaging::AsRecorded),
                           "Blocks arrive in their recorded frames (default)")
        ->excludes(simulated);
}

void addAtlas(CLI::App& command, AtlasOptions& options, std::vector<std::string>& limits) {
    planet::AtlasGrid& grid = options.grid;
    command.add_option("FILE", options.file, "Chunk file")->required();
    command
        .add_option("--altitudes", grid.altitudesM,
                    "Altitudes of the viewpoints above the ground or a drawn sea, metres (200,5000,50000)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(number(0.1, 1e9));
    command.add_option("--headings", grid.headings, "Headings at each place and altitude (4)")
        ->check(CLI::Range(1, planet::mostAtlasHeadings));
    command
        .add_option("--pitch", grid.pitchDeg,
                    "Pitch of the views from the horizon of a sphere without relief, degrees (-10)")
        ->check(number(-90, 0));
    command
        .add_option("--viewpoints", grid.most,
                    "Most viewpoints; the survey splits cells where it matters until they are used up (5000)")
        ->check(CLI::Range(std::uint64_t{6}, std::uint64_t{planet::mostAtlasViewpoints}));
    command
        .add_option("--cells", grid.coarsestLevel,
                    "Level of the first cells: 6 x 4^level of them, or fewer if the viewpoints are few (2)")
        ->check(CLI::Range(0, 8));
    command.add_flag("--true-error", options.measuresError,
                     "Also compare the drawn surface with the finest data, which takes longer");
    command.add_flag("--no-tree{false}", options.recordsTree,
                     "Leave out the list of chunks, with which --diff finds what a bake has changed");
    command.add_option("--threads", options.threads, "Threads; 0: one per core (0)")
        ->check(CLI::Range(0, 1024));
    command.add_flag("--resume", options.resumes, "Continue the unfinished survey of the output");
    command.add_option("--worst", options.listed, "Viewpoints to list of each measure, worst first (5)")
        ->check(wholeNumber(0, 1'000'000));
    command.add_option("--csv", options.csv, "Table of all viewpoints to write, .csv");
    command
        .add_option("--disk-ms", options.diskMs,
                    "Latency of a read of the simulated disk, ms (that of the settings, or 5)")
        ->check(number(0, 1e4));
    command
        .add_option("--disk-mb-s", options.diskMBs,
                    "10^6 bytes per second of a loader, 0 is unlimited (that of the settings, or 100)")
        ->check(number(0, 1e5));
    CLI::Option* const diff =
        command.add_option("--diff", options.diff,
                           "Earlier atlas: surveys its viewpoints again, with its settings, and compares");
    // The earlier atlas decides these.
    for (const char* const chosen :
         {"--altitudes", "--headings", "--pitch", "--viewpoints", "--cells", "--size", "--fov"}) {
        if (CLI::Option* const option = command.get_option_no_throw(chosen)) diff->excludes(option);
    }
    command
        .add_option("--limit", limits,
                    "With --diff: how far a measure may move, for example eps_px=+0.2, triangles=-10% or "
                    "chunks=+0; may be repeated")
        ->type_name("NAME=+X")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false)
        ->needs(diff);
}

struct SuggestTexts {
    std::string budget;
    std::string cost;
    std::vector<std::string> vary;
};

void addSuggest(CLI::App& command, SuggestOptions& options, SuggestTexts& texts) {
    const auto many = [](CLI::Option* option) { option->expected(1)->take_all()->allow_extra_args(false); };
    command.add_option("FILE", options.file, "Chunk file, or the trace of another engine")->required();
    command
        .add_option(
            "--budget", texts.budget,
            "What a frame may cost and leave, for example \"16.6 ms, 200 k triangles, 64 MiB, 1.5 px\"; one "
            "of them or more")
        ->required()
        ->option_text("BUDGET");
    many(command.add_option(
        "--flight", options.flights,
        "Flight to measure: keys (.toml) or the path of a recording (.flight); may be repeated"));
    many(command.add_option("--recording", options.recordings,
                            "Recording of FILE (.flight) to measure with its very views; may be repeated"));
    command
        .add_option(
            "--altitudes", options.altitudesM,
            "Altitudes of viewpoints of the whole planet, metres (200,5000,50000 without --flight and "
            "--recording)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(number(0.1, 1e9));
    command
        .add_option("--chunk", options.chunkSizes,
                    "Chunk sizes that may be suggested too, vertices per side; FILE's source is baked for "
                    "each into the "
                    "cache (FILE's own alone)")
        ->delimiter(',')
        ->check(CLI::IsMember(std::vector<int>(planet::chunkSizes.begin(), planet::chunkSizes.end())));
    command.add_option(
        "--source", options.source,
        "Source of FILE, for --chunk, with the options that it was baked with (the terrain that FILE names)");
    command.add_option("--viewpoints", options.viewpoints, "Most viewpoints of the whole planet (600)")
        ->check(CLI::Range(6, 100'000));
    command
        .add_option("--vary", texts.vary,
                    fmt::format("What may vary: {} (all)", fmt::join(suggestVaryNames, ", ")))
        ->delimiter(',');
    command
        .add_option(
            "--frame-cost", texts.cost,
            "Cost of a frame on the target machine, for example \"0.8 ms + 9 ms per million triangles\" "
            "(measured on this machine)")
        ->option_text("COST");
    command.add_option("--step-s", options.stepS, "Seconds of a flight between frames (0.0333)")
        ->check(number(1e-3, 3600));
    command.add_option("--name", options.name, "Name of the files (suggested)");
    command.add_flag("--no-pictures{false}", options.drawsPictures, "Draw no pictures of the worst places");
}

struct TraceTexts {
    std::string goal;
    std::string data = "all";
    std::string metric = "bounds";
    std::string match = "time";
    std::optional<double> budgetMb;
    double diskLatencyMs = 1000 * planet::TraceDiskModel{}.latencyS;
    double diskMbPerS = planet::TraceDiskModel{}.bytesPerS / 1e6;
};
constexpr std::array<std::string_view, 3> traceDataNames = {"all", "traced", "disk"};  // of TraceResidency
constexpr std::array<std::string_view, 3> traceMetricNames = {"bounds", "sphere",
                                                              "centre"};         // of TraceMetric
constexpr std::array<std::string_view, 2> traceMatchNames = {"time", "number"};  // of TraceMatch

void addTraceWhatIf(CLI::App& command, TraceWhatIfOptions& options, TraceTexts& texts) {
    command
        .add_option("--what-if", options.tausPx,
                    "Tolerances, such as 1,2,4, to select with again over the frames of the trace, pixels")
        ->delimiter(',')
        ->check(number(0, 1e6, false));
    command
        .add_option("--suggest", texts.goal,
                    "Find the tau that meets error_px=N, bytes_mb=N or triangles=N, or several with commas")
        ->option_text("LIMITS");
    command
        .add_option("--hysteresis", options.settings.hysteresis,
                    "Hysteresis to select with, a share of tau (the engine's)")
        ->check(number(0, 0.99));
    command
        .add_option("--metric", texts.metric,
                    "What the distance of an error is measured to: the bounds that the engine told, the "
                    "sphere around them, or their centre (bounds)")
        ->check(oneOf(traceMetricNames));
    command
        .add_option("--budget-mb", texts.budgetMb, "Most data to select, 10^6 bytes for each view (no limit)")
        ->check(number(0, 1e9, false));
    command
        .add_option(
            "--data", texts.data,
            "Data that is there: all, as traced, or as a disk delivers it from the first frame on (all)")
        ->check(oneOf(traceDataNames));
    command.add_option("--disk-ms", texts.diskLatencyMs, "For --data disk: latency of a request, ms (10)")
        ->check(number(0, 1e6));
    command
        .add_option("--disk-mb-s", texts.diskMbPerS,
                    "For --data disk: 10^6 bytes per second of a loader (100)")
        ->check(number(0, 1e9, false));
    command.add_option("--loaders", options.settings.disk.loaders, "For --data disk: loaders at work (1)")
        ->check(number(1, 64));
}

void addTrace(CLI::App& command, TraceCommandOptions& options, TraceTexts& texts) {
    command.add_option("FILE", options.file, "Trace, as planet/trace/lod_trace.h writes it")->required();
    command.add_option("OTHER", options.other,
                       "A later trace of the same flight, to compare frame by frame; limits apply to it");
    command.add_option("--match", texts.match, "Frames are the same by time or number (time)")
        ->check(oneOf(traceMatchNames));
    addTraceWhatIf(command, options.whatIf, texts);
    const auto limit = [&command](const char* name, auto& value, double most, const char* help) {
        command.add_option(name, value, help)->check(number(0, most));
    };
    limit("--max-faults", options.limits.faults, 1e9, "Limit: number of faults");
    limit("--max-error-px", options.limits.errorPx, 1e9,
          "Limit: largest error on screen of a drawn node, pixels");
    limit("--max-latency-ms", options.limits.latencyMs, 1e9,
          "Limit: 99th percentile of the time from request to arrival, ms");
    limit("--max-thrashes", options.limits.thrashes, 1e9,
          "Limit: number of level changes that undo another one within 1 s");
    limit("--max-over-budget", options.limits.overBudget, 100, "Limit: percentage of frames over --frame-ms");
    limit("--max-dropped", options.limits.dropped, 1e9, "Limit: number of events that the trace lost");
    limit("--max-differing", options.limits.differing, 1e9,
          "Limit: number of frames in which OTHER draws other nodes");
    limit("--max-disagreeing", options.limits.disagreeing, 1e9,
          "Limit: number of frames in which the engine's choice is not what its own errors and tau say");
    command.add_option("--frame-ms", options.budgetMs, "Budget of a frame, CPU and GPU each, ms (16.7)")
        ->check(number(1e-3, 1e6));
    command
        .add_option("--late-s", options.faults.lateAfterS,
                    "Data that takes longer from request to arrival is a fault, s (0.5)")
        ->check(number(0, 1e6));
    command
        .add_option(
            "--starved-s", options.faults.starvedAfterS,
            "A node that is drawn too coarse for longer, because data is missing, is a fault, s (0.5)")
        ->check(number(0, 1e6));
}

void addAttach(CLI::App& command, AttachOptions& options) {
    command.add_option("PORT", options.port, "Port of this machine at which the engine listens")
        ->required()
        ->check(CLI::Range(1, 65535));
    command.add_option(
        "-o,--output,--out", options.out,
        "New file to write, .lodtrace, or folder for engine-PORT.lodtrace (the current folder)");
    command.add_option("--seconds", options.seconds, "End after this time, s (never)")
        ->check(number(0, 1e9, false));
    command.add_flag("--once", options.isOnce, "End when the engine leaves");
}

void addSettings(CLI::App& command, SettingsCommandOptions& options) {
    command.add_flag("--table", options.table, "Print a Markdown table")->excludes("--json");
}

void addFile(CLI::App& command, FileCommandOptions& options) {
    command.add_option("FILE", options.file, "Chunk file")->required();
}

void addVerify(CLI::App& command, FileCommandOptions& options) {
    addFile(command, options);
    command.add_option("--source", options.source,
                       "Also compare it with the source it was baked from, given with the same options");
    command.add_option("--colour", options.colour,
                       "Also compare its colours with the image they were baked from");
}

void addProbe(CLI::App& command, FileCommandOptions& options) {
    addFile(command, options);
    command.add_option("LATITUDE", options.latitudeDeg, "Latitude, degrees north")
        ->required()
        ->check(number(-90, 90));
    command.add_option("LONGITUDE", options.longitudeDeg, "Longitude, degrees east")
        ->required()
        ->check(number(-360, 360));
    command.add_option(
        "--source", options.source,
        "Also print which layer of this source made the height, and what lies under it: a world "
        "file or any other source");
}

bool sameFile(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code status;
    return a == b || std::filesystem::equivalent(a, b, status);
}

planet::ErrorMetric metricOf(const std::string& name) {
    return name == errorMetricNames[0] ? planet::ErrorMetric::Additive : planet::ErrorMetric::Tight;
}

template <typename Value>
Result<void> checkOnce(std::string_view option, std::vector<Value> values) {
    std::sort(values.begin(), values.end());
    const auto twice = std::adjacent_find(values.begin(), values.end());
    if (twice == values.end()) return {};
    return planet::badInput(fmt::format("{}: {} is given twice; expected each value once", option, *twice));
}

// Copies the shared options into the members that the command's options have. Returns the settings, for other
// uses by the command.
template <typename Options>
Result<Settings> takeShared(const CommandSpec& spec, const SharedTexts& texts, Options& options) {
    if constexpr (requires { options.report; }) options.report = {texts.json, texts.output};
    if constexpr (requires { options.json; }) options.json = texts.json;
    if constexpr (requires { options.output; }) options.output = texts.output;
    if constexpr (requires { options.worst; }) options.worst = texts.worst;
    if constexpr (requires { options.sourceSettings; }) options.sourceSettings = texts.source;
    if constexpr (requires { options.sampling; }) {
        options.flight = texts.flight;
        const bool given = texts.sampling.frames || texts.sampling.stepS;
        options.sampling = given ? texts.sampling : spec.sampling;
    }
    if constexpr (requires { options.tausPx; }) {
        if (!texts.tausPx.empty()) options.tausPx = texts.tausPx;
        if (Result<void> once = checkOnce("--tau", texts.tausPx); !once)
            return tl::unexpected(std::move(once.error()));
    }
    if constexpr (requires { options.size; }) {
        const Result<PictureSize> size = pictureSizeFromText(texts.view.size);
        if (!size) return tl::unexpected(size.error());
        options.size = *size;
    }
    Result<Settings> settings = settingsFrom(texts.view);
    if (!settings) return settings;
    if constexpr (requires {
                      options.view;
                      options.file;
                  }) {
        Result<RegionSettings> regions = regionsFor(texts.view.regions, options.file);
        if (!regions) return tl::unexpected(std::move(regions.error()));
        regions->on = settings->view.regions.on;
        settings->view.regions = std::move(*regions);
    }
    if constexpr (requires { options.view; }) options.view = settings->view;
    if constexpr (requires { options.start; }) options.start = settings->camera;
    for (const std::string& text : texts.cameras) {
        const Result<planet::CameraPose> pose = poseFromText(text);
        if (!pose) return tl::unexpected(pose.error());
        if constexpr (requires { options.cameras; })
            options.cameras.push_back(*pose);
        else if constexpr (requires { options.camera; })
            options.camera = *pose;
    }
    return settings;
}

Result<void> finish(ShotOptions& options, const Settings& settings) {
    // The image in the settings belongs to the data set in the settings.
    const bool sameData = settings.dataSet.empty() || sameFile(settings.dataSet, options.file);
    if (options.colourImage.empty() && sameData) options.colourImage = settings.colourImage;
    return {};
}

// Makes one source of the rasters that are named one by one; the finest lies on top.
Result<void> joinSources(BakeOptions& options) {
    for (const std::filesystem::path& source : options.sources) {
        const bool isOther =
            planet::isTerrainText(source) || isWorldName(source) || planet::isWorldFile(source);
        if (options.sources.size() > 1 && isOther) {
            return planet::badInput(
                fmt::format("{}: cannot be one of several sources; expected georeferenced rasters, or a "
                            "world file that lists its layers",
                            source.string()));
        }
        if (options.sources.size() > 1 && planet::heightSourceFiles(source).files.empty())
            return planet::ioError(fmt::format("{}: no such file", source.string()));
        options.source += options.source.empty() ? source.string() : '|' + source.string();
    }
    return {};
}

Result<void> finish(BakeOptions& options) {
    if (const auto joined = joinSources(options); !joined) return joined;
    // The parser gives a flag without a value as "true".
    if (options.detail == "true") options.detail->clear();
    if (options.listPresets) return {};
    if (options.source.empty()) return planet::badInput("SOURCE is required; see worldy bake --help");
    if (options.output.empty()) return planet::badInput("--output is required; see worldy bake --help");
    return {};
}

Result<void> finish(SweepOptions& options, const SweepTexts& texts) {
    options.cost = static_cast<SweepCost>(
        std::find(sweepCostNames.begin(), sweepCostNames.end(), texts.cost) - sweepCostNames.begin());
    const Result<void> once = checkOnce("--chunk", options.chunkSizes).and_then([&] {
        return checkOnce("--metric", texts.metrics);
    });
    if (!once) return once;
    if (!texts.metrics.empty()) options.metrics.clear();
    for (const std::string& name : texts.metrics) options.metrics.push_back(metricOf(name));
    if (texts.goal.empty()) return {};
    return tauGoalFromText(texts.goal).map([&](const TauGoal& goal) { options.goal = goal; });
}

Result<void> finish(PrefetchOptions& options, const PrefetchTexts& texts) {
    const Result<void> once = checkOnce("--predict", texts.modes)
                                  .and_then([&] { return checkOnce("--disk-mb-s", options.disksMBs); })
                                  .and_then([&] { return checkOnce("--disk-ms", options.latenciesMs); })
                                  .and_then([&] { return checkOnce("--speeds", options.speeds); })
                                  .and_then([&] { return checkOnce("--horizons-s", options.horizonsS); });
    if (!once) return once;
    if (!texts.modes.empty()) options.modes.clear();
    for (const std::string& name : texts.modes)
        options.modes.push_back(static_cast<planet::PrefetchMode>(
            std::find(prefetchModeNames.begin(), prefetchModeNames.end(), name) - prefetchModeNames.begin()));
    return {};
}

Result<void> finish(AtlasOptions& options, const SharedTexts& shared,
                    const std::vector<std::string>& limits) {
    std::sort(options.grid.altitudesM.begin(), options.grid.altitudesM.end());
    if (Result<void> once = checkOnce("--altitudes", options.grid.altitudesM); !once) return once;
    if (options.grid.altitudesM.size() > planet::mostAtlasAltitudes) {
        return planet::badInput(fmt::format("--altitudes: {} are too many; expected at most {}",
                                            options.grid.altitudesM.size(), planet::mostAtlasAltitudes));
    }
    const std::uint64_t least = planet::faceCount * options.grid.altitudesM.size() *
                                static_cast<std::uint64_t>(options.grid.headings);
    if (options.grid.most < least) {
        return planet::badInput(
            fmt::format("--viewpoints: {} are too few for {} altitudes and {} headings of six "
                        "cells; expected at least {}",
                        options.grid.most, options.grid.altitudesM.size(), options.grid.headings, least));
    }
    if (options.output.empty() && options.diff.empty())
        return planet::badInput("--output is required without --diff; see worldy atlas --help");
    if (options.output.empty() && options.resumes)
        return planet::badInput("--resume continues the survey of --output; expected an --output");
    options.changes = shared.view;
    for (const std::string& text : limits) {
        const Result<planet::AtlasLimit> limit = planet::atlasLimitFromText(text);
        if (!limit) return planet::badInput(fmt::format("--limit {}", limit.error().message));
        options.limits.push_back(*limit);
    }
    return {};
}

Result<void> finish(TraceCommandOptions& options, const TraceTexts& texts) {
    planet::TraceSelectorSettings& settings = options.whatIf.settings;
    const auto placeOf = [](const auto& names, const std::string& name) {
        return std::find(names.begin(), names.end(), name) - names.begin();
    };
    settings.residency = static_cast<planet::TraceResidency>(placeOf(traceDataNames, texts.data));
    settings.metric = static_cast<planet::TraceMetric>(placeOf(traceMetricNames, texts.metric));
    options.match = static_cast<planet::TraceMatch>(placeOf(traceMatchNames, texts.match));
    if (texts.budgetMb) settings.budgetBytes = static_cast<std::uint64_t>(*texts.budgetMb * 1e6);
    settings.disk.latencyS = texts.diskLatencyMs / 1000;
    settings.disk.bytesPerS = texts.diskMbPerS * 1e6;
    const bool asksWhatIf = !options.whatIf.tausPx.empty() || !texts.goal.empty();
    if (!options.other.empty() && (asksWhatIf || options.limits.disagreeing))
        return planet::badInput(
            "--what-if, --suggest and --max-disagreeing take one trace; expected no second FILE with them");
    if (options.other.empty() && options.limits.differing)
        return planet::badInput("--max-differing compares two traces; expected a second FILE");
    if (texts.goal.empty()) return {};
    return traceTauGoalFromText(texts.goal).map([&](const planet::TraceTauGoal& goal) {
        options.whatIf.goal = goal;
    });
}

Result<void> finish(SuggestOptions& options, const SuggestTexts& texts) {
    auto budget = suggestBudgetFromText(texts.budget);
    if (!budget) return planet::badInput("--" + budget.error().message);
    options.budget = *budget;
    if (!texts.cost.empty()) {
        auto cost = frameCostFromText(texts.cost);
        if (!cost) return planet::badInput("--frame-cost: " + cost.error().message);
        options.cost = *std::move(cost);
    }
    if (!texts.vary.empty()) {
        const auto vary = suggestVaryFromTexts(texts.vary);
        if (!vary) return tl::unexpected(vary.error());
        options.vary = *vary;
    }
    const bool isName = !options.name.empty() && options.name.find('/') == std::string::npos &&
                        options.name != "." && options.name != "..";
    if (!isName)
        return planet::badInput(
            fmt::format("--name: \"{}\" is no name of a file; expected one without /", options.name));
    const std::size_t altitudes =
        options.altitudesM.empty() ? planet::AtlasGrid{}.altitudesM.size() : options.altitudesM.size();
    std::ranges::sort(options.altitudesM);
    if (altitudes > planet::mostAtlasAltitudes)
        return planet::badInput(fmt::format("--altitudes: {} are too many; expected at most {}", altitudes,
                                            planet::mostAtlasAltitudes));
    if (Result<void> once = checkOnce("--altitudes", options.altitudesM); !once) return once;
    const std::size_t least =
        planet::faceCount * altitudes * static_cast<std::size_t>(planet::AtlasGrid{}.headings);
    if (static_cast<std::size_t>(options.viewpoints) < least) {
        return planet::badInput(
            fmt::format("--viewpoints: {} are too few for {} altitudes; expected at least {}",
                        options.viewpoints, altitudes, least));
    }
    return {};
}

// Sets both sides from the shared options. A side's own settings file replaces the shared one.
Result<void> finish(CompareOptions& options, const SharedTexts& shared, const CompareTexts& sides) {
    for (std::size_t i = 0; i < sides.size(); ++i) {
        ViewTexts texts = shared.view;
        if (!sides[i].settingsFile.empty()) texts.settingsFile = sides[i].settingsFile;
        Result<Settings> settings = settingsFrom(texts);
        if (!settings) return tl::unexpected(settings.error());
        for (const std::string& assignment : sides[i].assignments) {
            if (const Result<void> set = setSetting(*settings, assignment); !set)
                return planet::badInput(fmt::format("--set-{} {}", i == 0 ? 'a' : 'b', set.error().message));
        }
        Result<RegionSettings> regions =
            regionsFor(texts.regions, i == 0 || options.fileOfB.empty() ? options.file : options.fileOfB);
        if (!regions) return tl::unexpected(std::move(regions.error()));
        regions->on = settings->view.regions.on;
        settings->view.regions = std::move(*regions);
        options.settings[i] = settings->view;
    }
    return {};
}

Result<void> finish(ReplayOptions& options, const SharedTexts& texts) {
    for (const auto* given : {&texts.view.options, &texts.view.assignments})
        options.assignments.insert(options.assignments.end(), given->begin(), given->end());
    return {};
}

// Returns the exit code of a check; a false result means that it found problems.
int exitCodeOf(const Result<bool>& result) {
    if (!result) return reportError(result.error());
    return *result ? exitOk : exitCheckFailed;
}

int exitCodeOf(const Result<void>& result) {
    return result ? exitOk : reportError(result.error());
}

// All options and their parsed values. The parser keeps pointers to the members, so the object cannot move.
struct CommandLine {
    CLI::App app{
        "Worldy shows, tunes and measures planets drawn with chunked level of detail.\nWithout a command it "
        "opens a window with FILE, or with the Earth.",
        "worldy"};
    AppOptions window;
    BakeOptions bake;
    FileCommandOptions file;
    ShotOptions shot;
    FlyOptions fly;
    BenchOptions bench;
    SweepOptions sweep;
    SweepTexts sweepTexts;
    CracksOptions cracks;
    CostsOptions costs;
    ScheduleOptions schedule;
    PopsOptions pops;
    PrefetchOptions prefetch;
    PrefetchTexts prefetchTexts;
    AuditOptions audit;
    AtlasOptions atlas;
    std::vector<std::string> atlasLimits;
    SuggestOptions suggest;
    SuggestTexts suggestTexts;
    ReplayOptions replay;
    CompareOptions compare;
    CompareTexts compareTexts;
    MakeLayersOptions makeLayers;
    SettingsCommandOptions settings;
    TraceCommandOptions trace;
    TraceTexts traceTexts;
    AttachOptions attach;
    std::map<std::string_view, SharedTexts> shared;  // by command; map nodes do not move
    std::vector<std::filesystem::path> moreInputs;   // files read besides those in the options

    CommandLine() {
        app.set_version_flag("--version", "worldy " WORLDY_VERSION);
        app.add_option("FILE", window.file,
                       "Chunk file (.chk), elevation image or raster, world file (.toml), cube faces, "
                       "procedural terrain (noise:ridged) or "
                       "preset (preset:moon) to show");
        app.add_option("--settings", window.settingsFile, "Settings file to use instead of the user's");
        app.add_option(
            "--regions", window.regionsFile,
            "Regions with detail of their own, .regions.toml (the file beside FILE, if there is one)");
        app.add_option("--shaders", window.shaderFolder,
                       "Folder to read the shaders from; changes are reloaded");
        app.add_option(
            "--item-map", window.itemMapFile,
            "Keep writing the positions of all controls and the counters to this file, for scripts");
        std::map<std::string_view, CLI::App*> commands;
        for (const CommandSpec& spec : commandSpecs())
            commands[spec.name] = &addCommand(app, spec, shared[spec.name]);
        const auto at = [&](std::string_view name) -> CLI::App& { return *commands.at(name); };
        addBake(at("bake"), bake);
        addFile(at("info"), file);
        addVerify(at("verify"), file);
        addProbe(at("probe"), file);
        addShot(at("shot"), shot, shared["shot"].view);
        addFly(at("fly"), fly, shared["fly"].view);
        addBench(at("bench"), bench);
        addSweep(at("sweep"), sweep, sweepTexts);
        addCracks(at("cracks"), cracks, shared["cracks"].view);
        addCosts(at("costs"), costs);
        addSchedule(at("schedule"), schedule);
        addPops(at("pops"), pops);
        addPrefetch(at("prefetch"), prefetch, prefetchTexts, shared["prefetch"].view);
        addAudit(at("audit"), audit, shared["audit"].view);
        addAtlas(at("atlas"), atlas, atlasLimits);
        addSuggest(at("suggest"), suggest, suggestTexts);
        addReplay(at("replay"), replay);
        addCompare(at("compare"), compare, compareTexts);
        addMakeLayers(at("make-layers"), makeLayers);
        addSettings(at("settings"), settings);
        addTrace(at("trace"), trace, traceTexts);
        addAttach(at("attach"), attach);
        app.require_subcommand(0, 1);
    }
    // Copies the shared options of a command into its own. Returns the settings.
    template <typename Options>
    Result<Settings> take(std::string_view name, Options& options) const {
        return takeShared(commandSpec(name), shared.at(name), options);
    }

    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;
};

// Returns the parser's message, except for extra arguments, which it lists in reverse.
std::string problemOf(const CLI::App& app, const CLI::ParseError& error) {
    if (error.get_exit_code() != static_cast<int>(CLI::ExitCodes::ExtrasError)) return error.what();
    const std::vector<std::string> extras = app.remaining(true);
    return fmt::format("{}: {} not expected", fmt::join(extras, " "), extras.size() == 1 ? "is" : "are");
}

planet::Error errorOf(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<CLI::App*> commands = app.get_subcommands();
    const std::string help =
        commands.empty() ? "worldy --help" : fmt::format("worldy {} --help", commands.front()->get_name());
    return {planet::ErrorKind::BadInput, fmt::format("{}; see {}", problemOf(app, error), help)};
}

// Prints through standard output, whose failures are reported (exit_code.h).
int printHelp(const CLI::App& app, const CLI::ParseError& error) {
    std::ostringstream text;
    const int code = app.exit(error, text, text);
    fmt::print("{}", text.str());
    return code;
}

}  // namespace

Result<ShotOptions> shotOptionsFrom(std::span<const char* const> arguments) {
    CommandLine line;
    try {
        line.app.parse(static_cast<int>(arguments.size()), arguments.data());
    } catch (const CLI::ParseError& error) {
        return tl::unexpected(errorOf(line.app, error));
    }
    if (!line.app.got_subcommand("shot"))
        return planet::badInput("not a worldy shot command; expected worldy shot FILE -o PICTURE");
    return line.take("shot", line.shot)
        .and_then([&](const Settings& settings) { return finish(line.shot, settings); })
        .map([&] { return line.shot; });
}

namespace {

int runCommand(int argumentCount, const char* const* arguments) {
    if (const Result<void> good = checkSpellings({arguments, static_cast<std::size_t>(argumentCount)}); !good)
        return reportError(good.error());
    CommandLine line;
    const CLI::App& app = line.app;
    try {
        line.app.parse(argumentCount, arguments);
    } catch (const CLI::ParseError& error) {
        return error.get_exit_code() == 0 ? printHelp(app, error) : reportError(errorOf(app, error));
    }
    // Returns a function that completes a command's options, checks its outputs, and runs it.
    const auto command = [&line](std::string_view name, auto& options, auto run, auto prepare) {
        return [&line, name, &options, run, prepare] {
            return exitCodeOf(line.take(name, options).and_then(prepare).and_then([&] {
                using Ran = decltype(run(options));
                if constexpr (requires { filesOf(options); }) {
                    const SharedTexts& texts = line.shared.at(name);
                    CommandFiles files = filesOf(options);
                    addInputs(files, texts.view);
                    files.inputs.insert(files.inputs.end(), line.moreInputs.begin(), line.moreInputs.end());
                    if (const Result<void> safe = checkOutputs(files, texts.overwrite); !safe)
                        return Ran(tl::unexpected(safe.error()));
                }
                return run(options);
            }));
        };
    };
    const auto ready = [](const Settings&) { return Result<void>(); };
    const std::vector<std::pair<const char*, std::function<int()>>> commands = {
        {"bake", command("bake", line.bake, runBake, [&](const Settings&) { return finish(line.bake); })},
        {"info", command("info", line.file, runInfo, ready)},
        {"verify", command("verify", line.file, runVerify, ready)},
        {"probe", command("probe", line.file, runProbe, ready)},
        {"replay", command("replay", line.replay, replayFlight,
                           [&](const Settings&) { return finish(line.replay, line.shared.at("replay")); })},
        {"shot", command("shot", line.shot, takeShot,
                         [&](const Settings& settings) { return finish(line.shot, settings); })},
        {"fly", command("fly", line.fly, flyPath, ready)},
        {"sweep", command("sweep", line.sweep, runSweep,
                          [&](const Settings&) { return finish(line.sweep, line.sweepTexts); })},
        {"bench", command("bench", line.bench, runBench, ready)},
        {"cracks", command("cracks", line.cracks, runCracks, ready)},
        {"costs", command("costs", line.costs, runCosts, ready)},
        {"schedule", command("schedule", line.schedule, runSchedule, ready)},
        {"pops", command("pops", line.pops, runPops, ready)},
        {"prefetch", command("prefetch", line.prefetch, runPrefetch,
                             [&](const Settings&) { return finish(line.prefetch, line.prefetchTexts); })},
        {"audit", command("audit", line.audit, runAudit, ready)},
        {"atlas", command("atlas", line.atlas, runAtlasCommand,
                          [&](const Settings&) {
                              return finish(line.atlas, line.shared.at("atlas"), line.atlasLimits);
                          })},
        {"suggest", command("suggest", line.suggest, runSuggestCommand,
                            [&](const Settings&) { return finish(line.suggest, line.suggestTexts); })},
        {"settings", command("settings", line.settings, runSettings, ready)},
        {"trace", command("trace", line.trace, runTrace,
                          [&](const Settings&) { return finish(line.trace, line.traceTexts); })},
        {"attach", command("attach", line.attach, runAttach, ready)},
        {"compare", command("compare", line.compare, runCompare,
                            [&](const Settings&) {
                                for (const SideTexts& side : line.compareTexts)
                                    line.moreInputs.push_back(side.settingsFile);
                                return finish(line.compare, line.shared.at("compare"), line.compareTexts);
                            })},
        {"make-layers", command("make-layers", line.makeLayers, makeLayers, ready)},
    };
    for (const auto& [name, run] : commands) {
        if (app.got_subcommand(name)) return run();
    }
    const CommandFiles files = filesOf(line.window);
    const Result<void> safe =
        checkNotInputs(files).and_then([&] { return checkPlaces(files.outputs); }).and_then([&] {
            return checkKinds(files.outputs);
        });
    if (!safe) return reportError(safe.error());
    return runApp(line.window);
}

}  // namespace

int runCommandLine(int argumentCount, const char* const* arguments) {
    occupyStandardStreams();
    try {
        return afterStandardOutput(runCommand(argumentCount, arguments));
    } catch (const std::system_error& error) {
        // fmt::print throws if standard output cannot be written.
        if (std::ferror(stdout) == 0) throw;
        keepOutputError(error.code().value());
        return afterStandardOutput(exitBadInput);
    }
}

}  // namespace worldy
