#include "app/cli/prefetch_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <variant>

#include "app/base/exit_code.h"
#include "app/base/glossary.h"
#include "app/base/interrupt.h"
#include "app/base/output_file.h"
#include "app/flight/flight_path_file.h"
#include "app/measure/prefetch_flight.h"
#include "app/scene/scene_settings.h"
#include "app/settings/settings.h"

namespace worldy {

namespace {

using Json = nlohmann::ordered_json;
using planet::PrefetchMode;
using planet::Result;

// One flight, beside the one over the same disk at the same speed without prefetching.
struct PrefetchRow {
    PrefetchLeg leg;
    PrefetchFigures figures;
    PrefetchFigures off;
};

double prefetchRatio(double value, double of) {
    return of > 0 ? value / of : value > 0 ? INFINITY : 1;
}
double lateRatio(const PrefetchRow& row) {
    return prefetchRatio(row.figures.lateChunkS, row.off.lateChunkS);
}
double bytesRatio(const PrefetchRow& row) {
    return prefetchRatio(static_cast<double>(row.figures.bytesRead), static_cast<double>(row.off.bytesRead));
}
std::string_view prefetchModeName(const PrefetchRow& row) {
    return prefetchModeNames[static_cast<std::size_t>(row.leg.prefetch.mode)];
}

struct PrefetchColumn {
    const char* name;
    std::variant<double, std::uint64_t, std::string_view> (*of)(const PrefetchRow&);
};
using PrefetchCell = std::variant<double, std::uint64_t, std::string_view>;
constexpr std::array<PrefetchColumn, 16> prefetchColumns = {{
    {"prefetch", [](const PrefetchRow& r) -> PrefetchCell { return prefetchModeName(r); }},
    {"horizon_s", [](const PrefetchRow& r) -> PrefetchCell { return r.leg.prefetch.horizonS; }},
    {"share", [](const PrefetchRow& r) -> PrefetchCell { return r.leg.prefetch.share; }},
    {"disk_latency_ms", [](const PrefetchRow& r) -> PrefetchCell { return r.leg.disk.latencyMs; }},
    {"disk_mb_s", [](const PrefetchRow& r) -> PrefetchCell { return r.leg.disk.bandwidthMBs; }},
    {"speed", [](const PrefetchRow& r) -> PrefetchCell { return r.leg.speed; }},
    {"drawn_chunk_s", [](const PrefetchRow& r) -> PrefetchCell { return r.figures.drawnChunkS; }},
    {terms::lateChunkS.key, [](const PrefetchRow& r) -> PrefetchCell { return r.figures.lateChunkS; }},
    {"late_ratio", [](const PrefetchRow& r) -> PrefetchCell { return lateRatio(r); }},
    {"bytes_read", [](const PrefetchRow& r) -> PrefetchCell { return r.figures.bytesRead; }},
    {"bytes_ratio", [](const PrefetchRow& r) -> PrefetchCell { return bytesRatio(r); }},
    {terms::prefetchedBlocks.key,
     [](const PrefetchRow& r) -> PrefetchCell { return r.figures.prefetch.blocks; }},
    {"prefetched_bytes", [](const PrefetchRow& r) -> PrefetchCell { return r.figures.prefetch.bytes; }},
    {terms::prefetchHits.key, [](const PrefetchRow& r) -> PrefetchCell { return r.figures.prefetch.hits; }},
    {terms::prefetchWaste.key,
     [](const PrefetchRow& r) -> PrefetchCell { return r.figures.prefetch.wasted; }},
    {terms::prefetchUnused.key,
     [](const PrefetchRow& r) -> PrefetchCell { return r.figures.prefetch.unused(); }},
}};

std::string prefetchCsv(const std::vector<PrefetchRow>& rows) {
    std::string text = "schema_version";
    for (const PrefetchColumn& column : prefetchColumns) text += fmt::format(",{}", column.name);
    for (const PrefetchRow& row : rows) {
        text += fmt::format("\n{}", schemaVersion);
        for (const PrefetchColumn& column : prefetchColumns)
            text += std::visit([](auto value) { return fmt::format(",{}", value); }, column.of(row));
    }
    return text + "\n";
}

Json prefetchJson(const PrefetchOptions& options, const FlightPath& path,
                  const std::vector<PrefetchRow>& rows) {
    Json report = {{"flight", path.name},
                   {"file", options.file.string()},
                   {"width_px", options.size.widthPx},
                   {"height_px", options.size.heightPx},
                   {"tau_px", options.view.lod.tauPx},
                   {"flights", Json::array()}};
    for (const PrefetchRow& row : rows) {
        Json entry = Json::object();
        for (const PrefetchColumn& column : prefetchColumns)
            std::visit([&](auto value) { entry[column.name] = value; }, column.of(row));
        report["flights"].push_back(std::move(entry));
    }
    return report;
}

void printPrefetchHead() {
    fmt::print("{:<10}{:>10}{:>9}{:>7}{:>7}{:>12}{:>7}{:>11}{:>7}{:>12}{:>7}{:>7}{:>8}\n", "prefetch",
               "horizon s", "disk ms", "MB/s", "speed", "late chunk s", "ratio", "MB read", "ratio",
               "prefetched", "hits", "waste", "unused");
}

void print(const PrefetchRow& row) {
    const PrefetchFigures& f = row.figures;
    const bool isOff = row.leg.prefetch.mode == PrefetchMode::Off;
    fmt::print("{:<10}{:>10}{:>9g}{:>7g}{:>7g}{:>12.1f}{:>7.2f}{:>11.3f}{:>7.2f}{:>12}{:>7}{:>7}{:>8}\n",
               prefetchModeName(row), isOff ? "" : fmt::format("{:g}", row.leg.prefetch.horizonS),
               row.leg.disk.latencyMs, row.leg.disk.bandwidthMBs, row.leg.speed, f.lateChunkS, lateRatio(row),
               static_cast<double>(f.bytesRead) / 1e6, bytesRatio(row), f.prefetch.blocks, f.prefetch.hits,
               f.prefetch.wasted, f.prefetch.unused());
    flushStandardOutput();
}

// The flights of one disk at one speed, after the one without prefetching.
std::vector<planet::PrefetchSettings> prefetchesOf(const PrefetchOptions& options) {
    std::vector<planet::PrefetchSettings> all;
    const planet::PrefetchSettings& usual = options.view.paging.prefetch;
    for (const PrefetchMode mode : options.modes) {
        if (mode == PrefetchMode::Off) continue;
        planet::PrefetchSettings prefetch = usual;
        prefetch.mode = mode;
        if (options.horizonsS.empty()) all.push_back(prefetch);
        for (const double horizonS : options.horizonsS) {
            prefetch.horizonS = horizonS;
            all.push_back(prefetch);
        }
    }
    return all;
}

// A planet that a sweep has been given, with the flight.
struct PrefetchPlane {
    planet::Planet& planet;
    const FlightPath& path;
    const PrefetchOptions& options;
    double stepS;
    const InterruptWatch& watch;

    Result<PrefetchFigures> fly(const PrefetchLeg& leg) const {
        return flyForPrefetch(planet, path, options.view, options.size, leg, stepS,
                              [this] { return !watch.interrupted(); });
    }
};

Result<void> flyOverDisk(const PrefetchPlane& flown, PrefetchLeg leg, std::vector<PrefetchRow>& rows) {
    const auto add = [&](const PrefetchRow& row) {
        if (!flown.options.report.json && rows.empty()) printPrefetchHead();
        rows.push_back(row);
        if (!flown.options.report.json) print(row);
    };
    leg.prefetch.mode = PrefetchMode::Off;
    const Result<PrefetchFigures> off = flown.fly(leg);
    if (!off) return tl::unexpected(off.error());
    if (std::find(flown.options.modes.begin(), flown.options.modes.end(), PrefetchMode::Off) !=
        flown.options.modes.end())
        add({leg, *off, *off});
    for (const planet::PrefetchSettings& prefetch : prefetchesOf(flown.options)) {
        leg.prefetch = prefetch;
        const Result<PrefetchFigures> figures = flown.fly(leg);
        if (!figures) return tl::unexpected(figures.error());
        add({leg, *figures, *off});
    }
    return {};
}

}  // namespace

Result<void> runPrefetch(const PrefetchOptions& options) {
    const std::filesystem::path& file = options.report.file;
    if (!file.empty() && file.extension() != ".json" && !isCsvTable(file))
        return planet::badInput(
            fmt::format("{}: unknown table format; expected .csv or .json", file.string()));
    const Result<FlightPath> path = loadFlightPath(options.flight);
    if (!path) return tl::unexpected(path.error());
    const Result<FlightFrames> frames = framesOf(*path, options.sampling, mostFlightViews);
    if (!frames) return tl::unexpected(frames.error());
    auto planet = planet::Planet::open(options.file,
                                       pagingSettingsOf(options.view, false, planet::PagingTime::Simulated));
    if (!planet) return tl::unexpected(planet.error());
    (*planet)->setExaggeration(options.view.surface.exaggeration);

    const InterruptWatch watch;
    const PrefetchPlane flown{**planet, *path, options, std::max(frames->stepS, 1e-3), watch};
    std::vector<double> latenciesMs = options.latenciesMs;
    if (latenciesMs.empty()) latenciesMs.push_back(options.view.paging.badDisk.latencyMs);
    std::vector<PrefetchRow> rows;
    for (const double latencyMs : latenciesMs) {
        for (const double diskMBs : options.disksMBs) {
            for (const double speed : options.speeds) {
                PrefetchLeg leg{options.view.paging.prefetch, options.view.paging.badDisk, speed};
                leg.disk.latencyMs = latencyMs;
                leg.disk.bandwidthMBs = diskMBs;
                if (Result<void> done = flyOverDisk(flown, leg, rows); !done) return done;
            }
        }
    }
    const std::string json = jsonText(prefetchJson(options, *path, rows));
    if (options.report.json) fmt::print("{}", json);
    if (file.empty()) return {};
    return writeTextFile(file, isCsvTable(file) ? prefetchCsv(rows) : json);
}

}  // namespace worldy
