#include "app/cli/replay_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/base/interrupt.h"
#include "app/base/message.h"
#include "app/base/report.h"
#include "app/data/write_check.h"

namespace worldy {

namespace {

using Json = nlohmann::ordered_json;
using planet::Result;

constexpr std::size_t idsPrinted = 10;

const char* nameOf(ReplayPaging paging) {
    return paging == ReplayPaging::AsRecorded ? "as recorded" : "simulated";
}

std::vector<std::string> textsOf(const std::vector<planet::BlockId>& ids) {
    std::vector<std::string> texts;
    for (const planet::BlockId& id : ids) texts.push_back(toString(id));
    return texts;
}

void printIds(const char* what, const std::vector<planet::BlockId>& ids) {
    if (ids.empty()) return;
    std::vector<std::string> texts = textsOf(ids);
    const std::size_t shown = std::min(texts.size(), idsPrinted);
    texts.resize(shown);
    fmt::print("  {:17}{}{}\n", what, fmt::join(texts, " "),
               ids.size() > shown ? fmt::format(" and {} more", ids.size() - shown) : "");
}

void printReport(const FlightReplay& replay) {
    fmt::print("{}: {} frames over {:.2f} s, paging {}\n", replay.record().name, replay.next(),
               replay.timeS(), nameOf(replay.paging()));
    const std::optional<ReplayDifference>& first = replay.firstDifference();
    if (!first) {
        fmt::print("exact: every frame matches the recording\n");
        return;
    }
    fmt::print("{} frames differ; first: frame {} at {:.3f} s, in the {}\n", replay.framesDifferent(),
               first->frame + 1, first->timeS, first->what);
    printIds("only replayed", first->onlyReplayed);
    printIds("only recorded", first->onlyRecorded);
    if (first->onlyReplayed.empty() && first->onlyRecorded.empty())
        fmt::print("  same chunks; order, morphs or outcomes differ\n");
}

Json jsonOf(const ReplayOptions& options, const std::string& file, const FlightReplay& replay) {
    Json report = {{"flight", replay.record().name},
                   {"flight_file", options.flight.string()},
                   {"file", file},
                   {"paging", nameOf(replay.paging())},
                   {"settings", options.assignments},
                   {"frames", replay.next()},
                   {"seconds", replay.timeS()},
                   {"exact", !replay.firstDifference()},
                   {"frames_different", replay.framesDifferent()}};
    if (const std::optional<ReplayDifference>& first = replay.firstDifference()) {
        report["first_difference"] = {{"frame", first->frame + 1},
                                      {"time_s", first->timeS},
                                      {"in", first->what},
                                      {"only_replayed", textsOf(first->onlyReplayed)},
                                      {"only_recorded", textsOf(first->onlyRecorded)}};
    }
    return report;
}

Result<planet::ChunkFile> openData(const ReplayOptions& options, const FlightData& recorded) {
    Result<planet::ChunkFile> file = planet::ChunkFile::open(
        options.file.empty() ? std::filesystem::path(recorded.chunkFile) : options.file);
    if (!file && options.file.empty())
        return planet::badInput(
            fmt::format("{}; expected the chunk file as the second argument", file.error().message));
    if (!file) return file;
    if (const Result<void> same = checkSameData(options.flight, recorded, flightDataOf(*file)); !same)
        return tl::unexpected(same.error());
    return file;
}

}  // namespace

Result<bool> replayFlight(const ReplayOptions& options) {
    Result<FlightRecord> record = loadFlightRecord(options.flight);
    if (!record) return tl::unexpected(record.error());
    Result<planet::ChunkFile> file = openData(options, record->data);
    if (!file) return tl::unexpected(file.error());
    // The chunk file may be known only from the recording.
    if (const Result<void> apart =
            checkNotInputs({{file->name()}, {{options.report.file, OutputKind::Json}}});
        !apart)
        return tl::unexpected(apart.error());
    const std::string fileName = file->name();
    Result<FlightReplay> replay = FlightReplay::create(
        std::make_shared<const FlightRecord>(std::move(*record)), options.paging, options.assignments);
    if (!replay) return tl::unexpected(replay.error());
    planet::Result<planet::PlanetSource> source = planet::planetSource(std::move(*file));
    if (!source) return tl::unexpected(source.error());
    const auto planet = planet::Planet::open(std::move(*source), replay->pagingAtStart());
    if (!planet) return tl::unexpected(planet.error());

    replay->rewind(**planet);
    const InterruptWatch watch;
    while (!replay->atEnd()) {
        if (watch.interrupted()) return planet::cancelled();
        if (const Result<void> stepped = replay->step(headless(**planet)); !stepped)
            return tl::unexpected(stepped.error());
        static_cast<void>((*planet)->takeTileChanges(planet::BlockKind::Colours));  // nothing draws them
        static_cast<void>((*planet)->takeTileChanges(planet::BlockKind::Normals));
    }
    for (const std::string& problem : (*planet)->takeProblems()) printMessage("worldy: {}\n", problem);
    if (!options.report.json) printReport(*replay);
    return writeReport(options.report, jsonOf(options, fileName, *replay)).map([&] {
        return !replay->firstDifference() || !options.assignments.empty();
    });
}

}  // namespace worldy
