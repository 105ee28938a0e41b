// Fuzzes atlases. An input is a file or, if it does not begin as one, its records, because the checksums would stop most
// inputs: a byte with the kind, two with the size, the content, and the next record. What is read is written again, and
// tabulated, compared and continued as the command and the panel do it.
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "app/measure/atlas_table.h"
#include "planet/base/file_calls.h"
#include "planet/base/little_endian.h"
#include "planet/measure/atlas_diff.h"
#include "planet/measure/atlas_file.h"
#include "planet/measure/atlas_sampling.h"
#include "planet/measure/atlas_tree.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace planet;
using fuzz::isRead;
using fuzz::require;
using Bytes = std::vector<std::byte>;

constexpr std::string_view magic = "WORLDYAT";

Bytes sealed(std::span<const std::byte> input) {
    Bytes file;
    ByteWriter out(file);
    for (const char letter : magic) out.put(static_cast<std::uint8_t>(letter));
    out.put(std::uint32_t{1});
    out.put(std::uint32_t{0});
    while (input.size() >= 3) {
        const auto kind = readLittleEndian<std::uint8_t>(input.data());
        const std::size_t size =
            std::min<std::size_t>(readLittleEndian<std::uint16_t>(input.data() + 1), input.size() - 3);
        const auto content = input.subspan(3, size);
        out.put(std::uint32_t{kind});
        out.put(static_cast<std::uint32_t>(size));
        out.put(
            std::uint64_t{XXH3_64bits_withSeed(content.data(), size, (std::uint64_t{size} << 32) | kind)});
        file.insert(file.end(), content.begin(), content.end());
        input = input.subspan(3 + size);
    }
    return file;
}

// Returns calls that write into memory, whatever the name of the file.
FileCalls callsInto(Bytes& file) {
    FileCalls calls;
    calls.open = [](const char*, int, mode_t) { return 1000; };
    calls.close = [](int) { return 0; };
    calls.flock = [](int, int) { return 0; };
    calls.fsync = [](int) { return 0; };
    calls.rename = [](const char*, const char*) { return 0; };
    calls.ftruncate = [&file](int, off_t bytes) {
        file.resize(static_cast<std::size_t>(bytes));
        return 0;
    };
    calls.pwrite = [&file](int, const void* from, std::size_t bytes, off_t offset) {
        const auto at = static_cast<std::size_t>(offset);
        file.resize(std::max(file.size(), at + bytes));
        std::memcpy(file.data() + at, from, bytes);
        return static_cast<ssize_t>(bytes);
    };
    return calls;
}

Bytes written(const Atlas& atlas) {
    Bytes file;
    auto writer = AtlasWriter::create("written.atlas", atlas.survey, atlas.tree, callsInto(file));
    require(isRead(writer), "what is read can be written");
    const std::span<const AtlasViewpoint> all = atlas.viewpoints;
    for (std::size_t at = 0; at < all.size(); at += atlasBatch)
        require(isRead(writer->append(all.subspan(at, std::min(atlasBatch, all.size() - at)))),
                "viewpoints can be appended");
    if (atlas.isFinished) require(isRead(writer->finish()), "the survey can be finished");
    return file;
}

// NaN differs from itself.
bool areSame(const AtlasViewpoint& a, const AtlasViewpoint& b) {
    return a.place == b.place && a.eyeM == b.eyeM &&
           std::memcmp(a.figures.data(), b.figures.data(), sizeof a.figures) == 0;
}

void checkWritten(const Atlas& atlas) {
    const auto again = atlasFromBytes(written(atlas), "written.atlas");
    require(isRead(again), "what is written can be read");
    require(again->survey == atlas.survey && again->isFinished == atlas.isFinished,
            "what is read again is the same survey");
    require(std::ranges::equal(again->viewpoints, atlas.viewpoints, areSame),
            "what is read again has the same viewpoints");
    require(changesBetween(again->tree, atlas.tree).empty(), "what is read again has the same tree");
}

void checkPoses(const Atlas& atlas) {
    for (const AtlasViewpoint& viewpoint : atlas.viewpoints) {
        const CameraPose pose = poseOf(atlas.survey, viewpoint);
        require(std::abs(pose.latitudeDeg) <= 90 && std::abs(pose.longitudeDeg) <= 180,
                "a viewpoint lies on the planet");
        require(pose.pitchDeg >= -90 && pose.pitchDeg <= 0 && pose.headingDeg >= 0 && pose.headingDeg < 360,
                "a view has a direction");
        require(atlas.survey.radiusM + pose.altitudeM > 0, "an eye is above the planet's centre");
        require(!worldy::viewpointText(atlas.survey, viewpoint).empty(), "a viewpoint has a name");
    }
}

// The cells that are not split do not overlap, and a survey goes on in quarters of them.
void checkCells(const Atlas& atlas) {
    const AtlasGrid& grid = atlas.survey.grid;
    const std::vector<AtlasCell> cells = cellsOf(grid, atlas.viewpoints);
    require(cells.empty() == atlas.viewpoints.empty(), "viewpoints have cells");
    std::set<AtlasPlace> places;
    for (const AtlasPlace& place : nextPlaces(grid, atlas.survey.radiusM, atlas.viewpoints)) {
        require(place.cell.level <= grid.finestLevel && place.altitude < grid.altitudesM.size() &&
                    place.heading < grid.headings,
                "the next viewpoints are of the grid");
        require(places.insert(place).second, "the next viewpoints differ");
    }
    require(atlas.viewpoints.empty() || atlas.viewpoints.size() + places.size() <=
                                            std::max<std::uint64_t>(grid.most, atlas.viewpoints.size()),
            "a survey keeps to its number of viewpoints");
}

void checkTables(const Atlas& atlas) {
    for (const worldy::AtlasSpread& one : worldy::spreadsOf(atlas.viewpoints)) {
        require(one.median <= one.p90 && one.p90 <= one.p99 && one.p99 <= one.most,
                "the percentiles are ordered");
        const std::size_t worst = worldy::worstViewpoints(atlas.viewpoints, one.measure, 1).front();
        require(figureOf(atlas.viewpoints[worst].figures, one.measure) == one.most,
                "the worst viewpoint has the maximum");
    }
    const std::string csv = worldy::atlasCsv(atlas);
    require(static_cast<std::size_t>(std::ranges::count(csv, '\n')) == atlas.viewpoints.size() + 1,
            "the table has a line for each viewpoint");
    require(worldy::atlasJson(atlas, {}, 0)["viewpoints"].size() == atlas.viewpoints.size(),
            "the report has all viewpoints");
}

void checkDiff(const Atlas& atlas) {
    const auto diff = worldy::diffOf(atlas, atlas, {});
    require(isRead(diff), "an atlas is compared with itself");
    require(diff->chunks.empty(), "an atlas has the tree of itself");
    for (const AtlasMeasureDiff& one : diff->measures)
        require(one.moves.empty(), "an atlas has no difference from itself");
    Atlas worse = atlas;
    for (AtlasViewpoint& viewpoint : worse.viewpoints) viewpoint.figures.back() += 1;
    require(isRead(worldy::diffOf(atlas, worse, {})), "a worse survey of the same viewpoints is compared");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = fuzz::bytesOf(data, size);
    const bool isFile = fuzz::textOf(data, size).starts_with(magic);
    const Bytes file = isFile ? Bytes(bytes.begin(), bytes.end()) : sealed(bytes);
    std::uint64_t kept = 0;
    const auto atlas = atlasFromBytes(file, "fuzzed.atlas", &kept);
    if (!isRead(atlas)) return 0;
    require(kept <= file.size(), "no more is kept than there is");
    const auto complete = atlasFromBytes(std::span(file).first(kept), "kept.atlas");
    require(isRead(complete) && complete->viewpoints.size() == atlas->viewpoints.size(),
            "the complete records are the same atlas");
    checkWritten(*atlas);
    checkPoses(*atlas);
    checkCells(*atlas);
    checkTables(*atlas);
    checkDiff(*atlas);
    return 0;
}
