#include "app/cli/command_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <functional>

#include "app/settings/setting_value.h"
#include "app/settings/view_options.h"

namespace worldy {

namespace {

using planet::Result;

constexpr unsigned pictureOptions = takes::json | takes::size | takes::tau | takes::set | takes::view;
constexpr FlightSampling byFrames(int count) {
    return {.frames = count, .stepS = std::nullopt};
}
constexpr FlightSampling everySeconds(double seconds) {
    return {.frames = std::nullopt, .stepS = seconds};
}
constexpr const char* reportHelp = "Report to write, JSON";

constexpr std::array<CommandSpec, 22> commandTable = {{
    {.name = "bake",
     .about = "Bake elevation images or rasters, a world file, six cube faces or procedural terrain into a "
              "chunk file",
     .takes = takes::json | takes::output | takes::source,
     .output = "Chunk file to write"},
    {.name = "schedule",
     .about = "Predict how long a bake takes on more ranks, from the report of one",
     .takes = takes::json | takes::output,
     .output = reportHelp},
    {.name = "info", .about = "Describe the content of a chunk file", .takes = takes::json},
    {.name = "verify", .about = "Read a whole chunk file and check it", .takes = takes::json | takes::source},
    {.name = "probe",
     .about = "Print the height at a place and the chunks that contain it",
     .takes = takes::json},
    {.name = "shot",
     .about = "Render one picture of a chunk file, without a display",
     .takes = pictureOptions | takes::mustOutput | takes::camera,
     .output = "Picture to write, .png"},
    {.name = "fly",
     .about = "Fly along a path without a display and measure each frame",
     .takes = pictureOptions | takes::output | takes::mustFlight,
     .output = reportHelp,
     .sampling = byFrames(300)},
    {.name = "bench",
     .about = "Benchmark LOD, streaming and the file format against simple alternatives",
     .takes = takes::json | takes::output | takes::size | takes::taus | takes::source,
     .output = reportHelp,
     .defaultTaus = "1,2,4"},
    {.name = "sweep",
     .about = "Fly with many tolerances and compare the cost and the true error of each",
     .takes =
         (pictureOptions & ~takes::tau) | takes::taus | takes::output | takes::mustFlight | takes::source,
     .output = "Table to write, .csv or .json",
     .sampling = byFrames(12),
     .defaultTaus = "0.5,1,2,4,8"},
    {.name = "cracks",
     .about =
         "Count crack pixels and those that skirts do not cover; exits with 1 if there are uncovered pixels",
     .takes = pictureOptions | takes::output | takes::camera | takes::flight | takes::worst,
     .output = reportHelp,
     .sampling = everySeconds(1),
     .worst = "Crack clusters and gaps"},
    {.name = "costs",
     .about = "Measure the frame time with and without each light and surface feature",
     .takes = pictureOptions | takes::output | takes::camera,
     .output = reportHelp},
    {.name = "pops",
     .about = "Fly along a path with all loads on time and measure the jump of each level change",
     .takes = pictureOptions | takes::output | takes::mustFlight | takes::worst,
     .output = reportHelp,
     .sampling = everySeconds(1.0 / 60),
     .worst = "Level changes"},
    {.name = "prefetch",
     .about = "Fly over simulated disks with each way of prefetching, and compare late data and bytes read",
     .takes = pictureOptions | takes::output | takes::mustFlight,
     .output = "Table to write, .csv or .json",
     .sampling = everySeconds(1.0 / 30)},
    {.name = "audit",
     .about =
         "Compare the true error of the drawn surface with its bound; exits with 1 if it exceeds the bound",
     .takes = pictureOptions | takes::output | takes::cameras | takes::flight | takes::worst,
     .output = reportHelp,
     .sampling = everySeconds(1),
     .worst = "Chunks"},
    {.name = "atlas",
     .about =
         "Survey the whole planet from many viewpoints: errors, costs, the time until it is sharp, pops; or "
         "compare it with an earlier survey, and exit with 1 if a limit is exceeded",
     .takes = pictureOptions | takes::output,
     .output = "Atlas to write, .atlas"},
    {.name = "suggest",
     .about = "Find settings that meet a budget on flights, recordings or the whole planet, and write them "
              "with a report; "
              "exits with 1 if the budget cannot be met",
     .takes = pictureOptions | takes::mustOutput | takes::ownBudget | takes::source,
     .output = "Folder to write to: NAME.toml, NAME.regions.toml, NAME.md and NAME.png"},
    {.name = "replay",
     .about = "Replay a recorded flight without a display and check that every frame matches; with other "
              "settings, differences are reported but are no failure",
     .takes = takes::json | takes::output | takes::tau | takes::set,
     .output = reportHelp},
    {.name = "compare",
     .about = "Fly with two settings or two bakes, A and B, and compare their measurements",
     .takes = pictureOptions | takes::output | takes::mustFlight,
     .output = reportHelp,
     .sampling = byFrames(12)},
    {.name = "trace",
     .about =
         "Sum up the trace of any engine's level of detail, and find its faults; exits with 1 if a limit is "
         "exceeded",
     .takes = takes::json | takes::output | takes::worst,
     .output = reportHelp,
     .worst = "Faults"},
    {.name = "attach",
     .about = "Attach to a running engine that traces itself, and write its trace into a file until Ctrl+C; "
              "exits with 1 if no trace came",
     .takes = takes::json},
    {.name = "settings",
     .about = "Print all settings with their defaults as a settings file, as a Markdown table, or as JSON",
     .takes = takes::json},
    {.name = "make-layers",
     .about = "Generate the six materials of the texture layers and the sets that use them",
     .takes = takes::json | takes::mustOutput,
     .output = "Output folder"},
}};

// Spellings of earlier versions: an option followed by a value that ends in `value`.
struct OldSpelling {
    std::string_view command;
    std::string_view option;
    std::string_view value;
    std::string_view now;
};
constexpr std::array<OldSpelling, 5> oldSpellings = {{
    {"fly", "--path", "", "--flight"},
    {"fly", "--json", ".json", "-o FILE; --json alone prints the report"},
    {"sweep", "--csv", "", "-o TABLE.csv"},
    {"sweep", "--json", ".json", "-o TABLE.json; --json alone prints the table"},
    {"make-layers", "--size", "", "--texels"},
}};

void addSourceOptions(CLI::App& command, planet::HeightSourceSettings& source) {
    command
        .add_option("--metres-per-unit", source.metresPerUnit,
                    "Metres per unit of the source's values; overrides the file's own scale, offset and unit "
                    "(the file's, else 1)")
        ->check(number(-1e9, 1e9, false));
    command
        .add_option("--offset", source.offsetM,
                    "Metres added to every height; overrides the file's own offset (the file's, else 0)")
        ->check(number(-1e9, 1e9));
    command.add_option("--no-data", source.noDataValue,
                       "Value that means \"no data\", instead of a GeoTIFF's own; NaN is always no data");
    command.add_option("--fill", source.fillM, "Height of samples without data, metres (0)")
        ->check(number(-1e9, 1e9));
    command.add_flag("--skip-broken", source.skipBroken,
                     "Leaves out rasters that cannot be opened or read, and warns of each");
    command.add_option("--raw-size", source.rawSize, "Raw faces: samples per side")
        ->check(CLI::Range(2, (1 << 22) + 1));
    command.add_option("--raw-bits", source.rawBits, "Raw faces: 8 or 16")->check(CLI::IsMember({8, 16}));
    command.add_flag("--raw-signed", source.rawSigned, "Raw faces: 16-bit values are signed");
    command.add_flag("--raw-big-endian", source.rawBigEndian, "Raw faces: big-endian values");
}

void addFlightOptions(CLI::App& command, const CommandSpec& spec, SharedTexts& texts) {
    const bool required = (spec.takes & takes::mustFlight) != 0;
    CLI::Option& flight = *command.add_option("--flight", texts.flight,
                                              "Views along a flight: keys (.toml) or a recording (.flight)");
    flight.required(required);
    const FlightSampling& usual = spec.sampling;
    CLI::Option& count =
        *command
             .add_option("--frames", texts.sampling.frames,
                         fmt::format("Frames, evenly spread over the flight{}",
                                     usual.frames ? fmt::format(" ({})", *usual.frames) : ""))
             ->check(CLI::Range(1, 1000000));
    CLI::Option& step =
        *command
             .add_option("--step-s", texts.sampling.stepS,
                         fmt::format("Seconds of the flight between frames, instead of --frames{}",
                                     usual.stepS ? fmt::format(" ({:.3g})", *usual.stepS) : ""))
             ->check(number(1e-4, 86400));
    step.excludes(&count);
    if (required) return;
    for (CLI::Option* option : {&count, &step}) option->needs(&flight);
    if (CLI::Option* camera = command.get_option_no_throw("--camera")) flight.excludes(camera);
}

void addViewOptions(CLI::App& command, bool takesBudget, ViewTexts& view) {
    command.add_option("--settings", view.settingsFile,
                       "Settings to start from: a settings file, a preset, or a Worldy screenshot");
    command.add_option(
        "--layers", view.layerSet,
        "Texture layer set, .toml; with software rendering also give --set surface.layer_use=on");
    command.add_option(
        "--regions", view.regions,
        "Regions with detail of their own, .regions.toml (the file beside FILE, if there is one)");
    if (takesBudget) addSettingOption(command, "--budget", defaultField("paging.budget_mb"), view);
    addSettingFlag(command, "--no-culling", {"lod.frustum_culling=false", "lod.horizon_culling=false"},
                   "Turn off frustum and horizon culling", view);
    addSettingOption(command, "--fov", defaultField("view.fov_deg"), view);
}

void addCamera(CLI::App& command, const CommandSpec& spec, SharedTexts& texts) {
    const char* const help = "LAT,LON,ALT,HEADING,PITCH in degrees and metres above the radius";
    const bool many = (spec.takes & takes::cameras) != 0;
    CLI::Option& option = *command.add_option(
        "--camera", texts.cameras,
        fmt::format(
            "{} ({})", help,
            many ? "may be repeated; default: views of the whole planet and low above its most rugged ground"
                 : "the whole planet"));
    option.expected(1)->allow_extra_args(false);
    if (many) option.take_all();
}

}  // namespace

CLI::Validator valueOf(const Field& field) {
    const auto check = [field](const std::string& text) {
        Settings settings;
        const planet::Result<void> set = setField("", movedTo(field, settings), text);
        // The parser adds the option's name.
        return set ? std::string() : set.error().message.substr(std::string_view(": ").size());
    };
    return CLI::Validator(check, "");
}

CLI::Option& addSettingOption(CLI::App& command, const char* option, const Field& field, ViewTexts& view) {
    const std::function<void(const std::string&)> take = [&view,
                                                          name = field.name()](const std::string& text) {
        view.options.push_back(fmt::format("{}={}", name, text));
    };
    return *command
                .add_option_function(
                    option, take,
                    fmt::format("{} Sets {}: {}", firstSentence(field), field.name(), summaryOf(field)))
                ->check(valueOf(field));
}

CLI::Option& addSettingFlag(CLI::App& command, const char* flag, std::vector<std::string> assignments,
                            const char* help, ViewTexts& view) {
    const std::function<void(std::int64_t)> take = [&view, assignments](std::int64_t) {
        view.options.insert(view.options.end(), assignments.begin(), assignments.end());
    };
    return *command.add_flag_function(
        flag, take, fmt::format("{}; short for --set {}", help, fmt::join(assignments, " --set ")));
}

CLI::Validator number(double min, double max, bool zeroToo) {
    const std::string wanted = fmt::format("a number in [{}, {}]{}", min, max, zeroToo ? "" : ", not 0");
    const auto check = [=](const std::string& text) {
        double value = 0;
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool good =
            problem == std::errc{} && end == text.data() + text.size() && value >= min && value <= max;
        return good && (zeroToo || value != 0) ? std::string() : fmt::format("{} is not {}", text, wanted);
    };
    return CLI::Validator(check, "");
}

CLI::Validator wholeNumber(std::uint32_t min, std::uint32_t max) {
    const auto check = [=](const std::string& text) {
        std::uint32_t value = 0;
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool good =
            problem == std::errc{} && end == text.data() + text.size() && value >= min && value <= max;
        return good ? std::string()
                    : fmt::format("{} is not valid; expected a whole number in [{}, {}]", text, min, max);
    };
    return CLI::Validator(check, "");
}

CLI::Validator faceSize() {
    const auto check = [](const std::string& text) {
        std::uint32_t value = 0;
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool good = problem == std::errc{} && end == text.data() + text.size() && value > 2;
        return good && std::has_single_bit(value - 1)
                   ? std::string()
                   : fmt::format("{} is not valid; expected 2^n + 1, for example 1025, 2049 or 4097", text);
    };
    return CLI::Validator(check, "");
}

std::span<const CommandSpec> commandSpecs() {
    return commandTable;
}

const CommandSpec& commandSpec(std::string_view name) {
    return *std::find_if(commandTable.begin(), commandTable.end(),
                         [&](const CommandSpec& spec) { return name == spec.name; });
}

CLI::App& addCommand(CLI::App& app, const CommandSpec& spec, SharedTexts& texts) {
    CLI::App& command = *app.add_subcommand(spec.name, spec.about);
    const auto takesAny = [&](unsigned options) { return (spec.takes & options) != 0; };
    if (takesAny(takes::output | takes::mustOutput)) {
        command.add_option("-o,--output", texts.output, spec.output)->required(takesAny(takes::mustOutput));
        command.add_flag("--overwrite", texts.overwrite,
                         "Allow outputs to replace existing files of another kind");
    }
    if (takesAny(takes::json))
        command.add_flag("--json", texts.json, "Print the report as JSON on standard output");
    if (takesAny(takes::camera | takes::cameras)) addCamera(command, spec, texts);
    if (takesAny(takes::flight | takes::mustFlight)) addFlightOptions(command, spec, texts);
    if (takesAny(takes::size))
        command.add_option("--size", texts.view.size, "Picture size, WIDTHxHEIGHT (1280x720)");
    if (takesAny(takes::tau)) addSettingOption(command, "--tau", defaultField("lod.tau_px"), texts.view);
    if (takesAny(takes::taus)) {
        const Field& tau = defaultField("lod.tau_px");
        command
            .add_option(
                "--tau", texts.tausPx,
                fmt::format("{} Each is a {} ({})", firstSentence(tau), allowedText(tau), spec.defaultTaus))
            ->delimiter(',')
            ->check(valueOf(tau));
    }
    if (takesAny(takes::set)) {
        command
            .add_option(
                "--set", texts.view.assignments,
                "Any setting, for example lod.tau_px=3; may be repeated, and overrides the other options")
            ->type_name("NAME=VALUE")
            ->expected(1)
            ->take_all()
            ->allow_extra_args(false);
    }
    if (takesAny(takes::view)) addViewOptions(command, !takesAny(takes::ownBudget), texts.view);
    if (takesAny(takes::worst)) {
        command
            .add_option("--worst", texts.worst,
                        fmt::format("{} to list, largest first; the JSON report contains all ({})",
                                    spec.worst, texts.worst))
            ->check(CLI::Range(0, 1000000));
    }
    if (takesAny(takes::source)) addSourceOptions(command, texts.source);
    return command;
}

namespace {

// The parser ignores an empty entry between two commas.
Result<void> checkList(std::string_view option, std::string_view value) {
    constexpr std::array<std::string_view, 3> lists = {"--tau", "--chunk", "--metric"};
    if (std::find(lists.begin(), lists.end(), option) == lists.end()) return {};
    const bool gap = value.starts_with(',') || value.ends_with(',') || value.find(",,") != value.npos;
    if (!gap) return {};
    return planet::badInput(
        fmt::format("{}: {} has an empty entry; expected values with one comma between them", option, value));
}

}  // namespace

Result<void> checkSpellings(std::span<const char* const> arguments) {
    if (arguments.size() < 2) return {};
    const std::string_view command = arguments[1];
    for (std::size_t i = 2; i < arguments.size(); ++i) {
        const std::string_view argument = arguments[i];
        const std::string_view option = argument.substr(0, argument.find('='));
        const std::string_view value = option.size() < argument.size() ? argument.substr(option.size() + 1)
                                       : i + 1 < arguments.size()      ? std::string_view(arguments[i + 1])
                                                                       : std::string_view();
        if (Result<void> whole = checkList(option, value); !whole) return whole;
        for (const OldSpelling& old : oldSpellings) {
            if (old.command == command && old.option == option && value.ends_with(old.value)) {
                return planet::badInput(
                    fmt::format("{} {}: removed; expected {}", command, old.option, old.now));
            }
        }
    }
    return {};
}

}  // namespace worldy
