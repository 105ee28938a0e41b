#include "app/bench/bench_command.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string_view>
#include <thread>
#include <utility>

#include "app/base/exit_code.h"
#include "app/base/output_file.h"
#include "app/base/places.h"
#include "app/base/report.h"
#include "app/bench/bench_comparison.h"
#include "app/bench/bench_parts.h"
#include "app/data/bake_progress.h"
#include "app/data/own_colour.h"
#include "planet/gl/device/offscreen_context.h"

namespace worldy {

namespace {

using Json = nlohmann::ordered_json;
using planet::Result;

class ScratchFolder {
public:
    static Result<ScratchFolder> create() {
        std::error_code problem;
        std::string name = (std::filesystem::temp_directory_path(problem) / "worldy-bench-XXXXXX").string();
        if (problem || mkdtemp(name.data()) == nullptr)
            return planet::ioError(
                fmt::format("{}: cannot create this folder; expected a writable temporary folder", name));
        return ScratchFolder(name);
    }
    ScratchFolder(ScratchFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
    ScratchFolder& operator=(ScratchFolder&&) = delete;
    ~ScratchFolder() {
        std::error_code ignored;
        if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
    }
    const std::filesystem::path& path() const { return path_; }

private:
    explicit ScratchFolder(std::filesystem::path path) : path_(std::move(path)) {}
    std::filesystem::path path_;
};

// The machine that was measured.
struct Machine {
    std::string processor;
    unsigned threads = 0;
    std::string renderer;
};

std::string processorName() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        constexpr std::string_view key = "model name\t: ";
        if (line.starts_with(key)) return line.substr(key.size());
    }
    return "unknown";
}

Result<Machine> lookAtMachine() {
    const auto context = planet::gl::OffscreenContext::create();
    if (!context) return tl::unexpected(context.error());
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return Machine{processorName(), std::thread::hardware_concurrency(), renderer ? renderer : "unknown"};
}

struct Section {
    const char* name;   // in JSON
    const char* title;  // of the table
    std::vector<BenchRow> rows;
};

// Returns a number with enough digits for comparison.
std::string figure(double value) {
    if (value >= 1000) return fmt::format("{:.0f}", value);
    if (value >= 100) return fmt::format("{:.1f}", value);
    return fmt::format("{:.3f}", value);
}

std::string spreadText(const Spread& spread) {
    if (spread.minimum == spread.maximum) return figure(spread.median);
    return fmt::format("{} ({}..{})", figure(spread.median), figure(spread.minimum), figure(spread.maximum));
}

// Returns the aim and whether it is missed; empty if there is none.
std::string aimText(const BenchRow& row) {
    if (!row.aim) return "";
    const double reached = row.aim->isOfRatio ? row.ratio.median : row.value.median;
    const bool isMet = row.aim->isUpperBound ? reached <= row.aim->bound : reached >= row.aim->bound;
    return fmt::format("{}(aim: at {} {:g}{}{})", row.yardstick.empty() ? "" : " ",
                       row.aim->isUpperBound ? "most" : "least", row.aim->bound,
                       row.aim->isOfRatio ? "" : " " + row.unit, isMet ? "" : "; missed");
}

void print(const Section& section) {
    fmt::print("\n{}\n", section.title);
    std::size_t widest = 46;
    for (const BenchRow& row : section.rows) widest = std::max(widest, row.subject.size());
    for (const BenchRow& row : section.rows) {
        const std::string ratio =
            row.yardstick.empty() ? "" : fmt::format("{} x {}", spreadText(row.ratio), row.yardstick);
        fmt::print("  {:<{}}  {:<16}{:>28} {:<11}{}{}\n", row.subject, widest, row.quantity,
                   spreadText(row.value), row.unit, ratio, aimText(row));
    }
    flushStandardOutput();
}

Json jsonOf(const Spread& spread, bool isCount = false) {
    const auto number = [&](double value) { return isCount ? Json(std::llround(value)) : Json(value); };
    return {{"median", number(spread.median)},
            {"minimum", number(spread.minimum)},
            {"maximum", number(spread.maximum)}};
}

Json jsonOf(const Section& section) {
    Json rows = Json::array();
    for (const BenchRow& row : section.rows) {
        Json entry = {{"subject", row.subject}, {"quantity", row.quantity}, {"unit", row.unit}};
        entry.update(jsonOf(row.value, row.unit.empty()));
        if (!row.yardstick.empty()) {
            entry["times"] = jsonOf(row.ratio);
            entry["times"]["of"] = row.yardstick;
        }
        if (row.aim) {
            Json& aimed = row.aim->isOfRatio ? entry["times"] : entry;
            aimed["aim"] = {{row.aim->isUpperBound ? "at_most" : "at_least", row.aim->bound}};
        }
        rows.push_back(std::move(entry));
    }
    return rows;
}

Json jsonOf(const BenchOptions& options, const std::string& source, const Machine& machine,
            const std::vector<Section>& sections) {
    Json report = {{"source", source},
                   {"rounds", options.rounds},
                   {"width_px", options.size.widthPx},
                   {"height_px", options.size.heightPx},
                   {"machine",
                    {{"processor", machine.processor},
                     {"threads", machine.threads},
                     {"gl_renderer", machine.renderer}}}};
    for (const Section& section : sections) report["parts"][section.name] = jsonOf(section);
    return report;
}

std::string csvQuoted(const std::string& text) {
    std::string inside;
    for (const char c : text) inside += c == '"' ? std::string("\"\"") : std::string(1, c);
    return '"' + inside + '"';
}

// Returns a table with one line for each row; fields that a row lacks are empty.
std::string csvOf(const std::vector<Section>& sections) {
    std::string csv =
        "schema_version,part,subject,quantity,unit,median,minimum,maximum,times_median,times_minimum,"
        "times_maximum,times_of,aim_at_most,aim_at_least,aim_of\n";
    for (const Section& section : sections) {
        for (const BenchRow& row : section.rows) {
            csv += fmt::format("{},{},{},{},{},{},{},{},", schemaVersion, section.name,
                               csvQuoted(row.subject), csvQuoted(row.quantity), csvQuoted(row.unit),
                               row.value.median, row.value.minimum, row.value.maximum);
            csv += row.yardstick.empty() ? ",,,,"
                                         : fmt::format("{},{},{},{},", row.ratio.median, row.ratio.minimum,
                                                       row.ratio.maximum, csvQuoted(row.yardstick));
            if (row.aim) {
                const std::string bound = fmt::format("{}", row.aim->bound);
                csv +=
                    fmt::format("{},{},{}", row.aim->isUpperBound ? bound : "",
                                row.aim->isUpperBound ? "" : bound, row.aim->isOfRatio ? "times" : "value");
            } else {
                csv += ",,";
            }
            csv += '\n';
        }
    }
    return csv;
}

Result<std::vector<BenchPlanet>> bakePlanets(const planet::HeightSource& source, const BenchOptions& options,
                                             const std::filesystem::path& folder) {
    std::vector<BenchPlanet> planets;
    for (const int faceSize : options.faceSizes) {
        planet::BakeSettings settings;
        settings.faceSize = faceSize;
        const BenchPlanet planet{faceSize, folder / fmt::format("faces{}.chk", faceSize)};
        const auto report = bakeOnTerminal(source, settings, planet.chunkFile);
        if (!report) return tl::unexpected(report.error());
        planets.push_back(planet);
    }
    return planets;
}

bool isWanted(const BenchOptions& options, std::string_view part) {
    return options.parts.empty() ||
           std::find(options.parts.begin(), options.parts.end(), part) != options.parts.end();
}

BenchRows benchLod(const std::vector<BenchPlanet>& planets, const BenchOptions& options) {
    std::vector<BenchRow> all;
    for (const BenchPlanet& planet : planets) {
        BenchRows rows = benchLodAgainstLeaves(planet, options);
        if (!rows) return rows;
        all.insert(all.end(), rows->begin(), rows->end());
    }
    return all;
}

struct Part {
    const char* name;  // one of benchParts
    const char* title;
    std::function<BenchRows()> measure;
};

// Returns all parts. The arguments must outlive them.
std::vector<Part> partsOf(const BenchOptions& options, const planet::HeightSource& source,
                          const std::vector<BenchPlanet>& planets, const std::filesystem::path& folder) {
    const auto largest = [&]() -> const BenchPlanet& { return planets.back(); };
    return {
        {"lod", "LOD against drawing every leaf, the same camera",
         [&] { return benchLod(planets, options); }},
        {"frame", "Frames against a plain mesh of the same triangles",
         [&, largest] {
             return benchFrame(largest(), source,
                               ownColourImage(options.source.empty() ? earthElevation() : options.source),
                               options, folder);
         }},
        {"dynamic", "Selection and draw against one static draw of the same triangles",
         [&, largest] { return benchDynamicAgainstStatic(largest(), options); }},
        {"selection", "Selection", [&, largest] { return benchSelection(largest(), options); }},
        {"page_in", "Load against a plain loop", [&, largest] { return benchPageIn(largest(), options); }},
        {"bake", "Bake against reading the source and zstd -1",
         [&] { return benchBake(source, planets.front().faceSize, options, folder); }},
        {"verify", "Verification on all threads against one",
         [&, largest] { return benchVerify(largest(), options); }},
        {"file_size", "File size against the finest heights alone",
         [&, largest] { return benchFileSize(largest(), options, folder); }},
        {"colours", "Load of colours against a plain loop",
         [&] {
             return benchColours(ownColourImage(options.source.empty() ? earthElevation() : options.source),
                                 options, folder);
         }},
        {"start", "Start of the program", [&] { return benchStart(planets.front(), options, folder); }},
    };
}

const char* nameOf(BenchVerdict verdict) {
    switch (verdict) {
        case BenchVerdict::WithinNoise:
            return "within_noise";
        case BenchVerdict::Better:
            return "better";
        case BenchVerdict::Worse:
            return "worse";
        case BenchVerdict::Differs:
            return "differs";
    }
    return "";
}

std::string verdictText(const BenchChange& change) {
    if (change.verdict == BenchVerdict::WithinNoise) return "";
    const char* const way = change.verdict == BenchVerdict::Differs  ? "differs"
                            : change.verdict == BenchVerdict::Better ? "better"
                                                                     : "WORSE";
    return fmt::format("{}: {:+.1f} %", way, 100 * (change.factor - 1));
}

void print(const BenchComparison& comparison) {
    std::string part;
    for (const BenchChange& change : comparison.changes) {
        if (std::exchange(part, change.of.part) != change.of.part) fmt::print("\n{}\n", part);
        const BenchRow& row = change.of.row;
        fmt::print("  {:<48}{:<16}{:>26} -> {:<26} {:<11}{}\n", row.subject, row.quantity,
                   spreadText(change.a), spreadText(change.b),
                   change.isRatio ? "x " + row.yardstick : row.unit, verdictText(change));
    }
    for (const ReportedRow& only : comparison.onlyA)
        fmt::print("only in the first: {}, {}, {}\n", only.part, only.row.subject, only.row.quantity);
    for (const ReportedRow& only : comparison.onlyB)
        fmt::print("only in the second: {}, {}, {}\n", only.part, only.row.subject, only.row.quantity);
    const auto worse = std::ranges::count(comparison.changes, BenchVerdict::Worse, &BenchChange::verdict);
    fmt::print("\n{} of {} figures got worse by more than their noise\n", worse, comparison.changes.size());
}

Json jsonOf(const BenchComparison& comparison, const std::vector<std::filesystem::path>& files) {
    Json report = {{"a", files[0].string()}, {"b", files[1].string()}, {"changes", Json::array()}};
    for (const BenchChange& change : comparison.changes) {
        const BenchRow& row = change.of.row;
        report["changes"].push_back({{"part", change.of.part},
                                     {"subject", row.subject},
                                     {"quantity", row.quantity},
                                     {"unit", change.isRatio ? "times " + row.yardstick : row.unit},
                                     {"a", jsonOf(change.a)},
                                     {"b", jsonOf(change.b)},
                                     {"factor", change.factor},
                                     {"verdict", nameOf(change.verdict)}});
    }
    const auto listed = [](const std::vector<ReportedRow>& rows) {
        Json list = Json::array();
        for (const ReportedRow& row : rows)
            list.push_back(
                {{"part", row.part}, {"subject", row.row.subject}, {"quantity", row.row.quantity}});
        return list;
    };
    report["only_in_a"] = listed(comparison.onlyA);
    report["only_in_b"] = listed(comparison.onlyB);
    return report;
}

Result<bool> compareReports(const BenchOptions& options) {
    if (isCsvTable(options.report.file)) {
        return planet::badInput(
            fmt::format("{}: a comparison is written as JSON; expected a name ending in .json",
                        options.report.file.string()));
    }
    std::array<std::vector<ReportedRow>, 2> reports;
    for (std::size_t i = 0; i < reports.size(); ++i) {
        Result<std::vector<ReportedRow>> read = readBenchReport(options.compared[i]);
        if (!read) return tl::unexpected(read.error());
        reports[i] = *std::move(read);
    }
    const BenchComparison comparison = compareBenchReports(reports[0], reports[1]);
    if (comparison.changes.empty()) {
        return planet::badInput(
            fmt::format("{}: has no figure that {} has too; expected two reports of the same parts",
                        options.compared[1].string(), options.compared[0].string()));
    }
    if (!options.report.json) print(comparison);
    const bool isWorse = std::ranges::find(comparison.changes, BenchVerdict::Worse, &BenchChange::verdict) !=
                         comparison.changes.end();
    return writeReport(options.report, jsonOf(comparison, options.compared)).map([&] { return !isWorse; });
}

}  // namespace

Result<bool> runBench(const BenchOptions& options) {
    if (!options.compared.empty()) return compareReports(options);
    const Result<planet::HeightSource> source = planet::openHeightSource(
        options.source.empty() ? earthElevation() : options.source, options.sourceSettings);
    if (!source) return tl::unexpected(source.error());
    const Result<Machine> machine = lookAtMachine();
    if (!machine) return tl::unexpected(machine.error());
    const Result<ScratchFolder> folder = ScratchFolder::create();
    if (!folder) return tl::unexpected(folder.error());
    // Colours are measured with their own planets.
    const bool onlyColours =
        !options.parts.empty() && std::all_of(options.parts.begin(), options.parts.end(),
                                              [](const std::string& part) { return part == "colours"; });
    const auto planets = onlyColours ? Result<std::vector<BenchPlanet>>(std::vector<BenchPlanet>{})
                                     : bakePlanets(*source, options, folder->path());
    if (!planets) return tl::unexpected(planets.error());
    if (!options.report.json)
        fmt::print("{}\n{}, {} threads; {}\n{} rounds: median (lowest..highest)\n", source->description,
                   machine->processor, machine->threads, machine->renderer, options.rounds);

    std::vector<Section> sections;
    for (const Part& part : partsOf(options, *source, *planets, folder->path())) {
        if (!isWanted(options, part.name)) continue;
        BenchRows rows = part.measure();
        if (!rows) return tl::unexpected(rows.error());
        sections.push_back({part.name, part.title, std::move(*rows)});
        if (!options.report.json) print(sections.back());
    }
    ReportTo json = options.report;
    if (isCsvTable(json.file)) {
        if (Result<void> written = writeTextFile(json.file, csvOf(sections)); !written)
            return tl::unexpected(written.error());
        json.file.clear();
    }
    return writeReport(json, jsonOf(options, source->description, *machine, sections)).map([] {
        return true;
    });
}

}  // namespace worldy
