// A real baked file changed in 5,000 ways, flown over each time: half of them as a bad disk or a bad copy
// leaves it, half with all checksums made right again, so that nonsense gets past them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <glm/trigonometric.hpp>
#include <map>
#include <memory>
#include <random>
#include <set>

#include "planet/bake/bake.h"
#include "planet/planet.h"
#include "planet/planet_tools.h"
#include "planet/source/colour_source.h"
#include "planet/source/height_source.h"
#include "tests/support/chunk_blocks.h"
#include "tests/support/sanitized.h"
#include "tests/support/sudden_lod.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using Bytes = std::vector<std::byte>;

constexpr int shards = 5;
constexpr int mutationsEach = tests::sanitized ? 100 : 1000;
constexpr int framesADive = 6;
constexpr int mostFramesToSettle = 300;
constexpr const char* fileName = "mutated.chk";

// The Earth of data/: chunks of four levels, colours of two.
struct BakedEarth {
    Bytes bytes;
    ChunkFileInfo info;
    std::vector<test::FileBlock> blocks;

    BakedEarth() {
        const std::filesystem::path earth = std::filesystem::path(WORLDY_SOURCE_DIR) / "data/earth";
        const tests::TemporaryFolder folder;
        BakeSettings settings{.faceSize = 129, .chunkSize = 17, .quantumM = 1.0};
        settings.colour.faceSize = 513;
        const ColourSource colours = openColourSource(earth / "colour.jpg").value();
        bake(openHeightSource(earth / "elevation.tif", {}).value(), settings, folder / fileName, {}, &colours)
            .value();
        const ChunkFile file = ChunkFile::open(folder / fileName).value();
        info = file.info();
        bytes.resize(static_cast<std::size_t>(file.sizeBytes()));
        std::FILE* stream = std::fopen((folder / fileName).c_str(), "rb");
        if (std::fread(bytes.data(), 1, bytes.size(), stream) != bytes.size()) bytes.clear();
        std::fclose(stream);
        test::forEachBlock(bytes, info, 10'000,
                           [&](const test::FileBlock& block) { blocks.push_back(block); });
    }
};

const BakedEarth& bakedEarth() {
    static const BakedEarth earth;
    return earth;
}

// ---- the flight ----

constexpr std::array<Geographic, 5> flownPlaces = {
    {{0.5, 1.5}, {-0.4, -1.2}, {0.8, 0.15}, {-0.6, 2.5}, {1.45, -0.7}}};

ViewInput diveView(std::size_t place, int frame) {
    constexpr std::array altitudesM = {1.2e7, 3e6, 4e5};
    const CameraPose pose{
        .latitudeDeg = glm::degrees(flownPlaces[place].latitudeRad),
        .longitudeDeg = glm::degrees(flownPlaces[place].longitudeRad),
        .altitudeM = altitudesM[static_cast<std::size_t>(std::min(frame * 3 / framesADive, 2))],
        .pitchDeg = -70};
    ViewInput view{viewFromPose(pose, 6'371'000, 1.1, 1280, 720), suddenLod()};
    view.lod.tauPx = 2;
    // Nothing is cut off, so that the whole planet must be covered.
    view.lod.frustumCulling = view.lod.horizonCulling = false;
    view.colours = {.enabled = true, .texelsPerPixel = 0.5};
    return view;
}

PagingSettings pagingSettings(bool tight) {
    PagingSettings settings;
    settings.time = PagingTime::Simulated;
    settings.budgetBytes = tight ? 900u << 10 : 16u << 20;
    if (tight) settings.colourShare = 0.9;
    settings.badDisk.latencyMs = 5;
    settings.loaderThreads = 2;
    return settings;
}

// Fills what a renderer would draw from.
struct FilledSlots {
    std::vector<std::vector<std::int32_t>> slots;

    void put(std::uint32_t slot, StepsView heights) {
        if (slots.size() <= slot) slots.resize(slot + std::size_t{1});
        slots[slot].assign(heights.begin(), heights.end());
    }
};

std::size_t residentBytes(const Planet& planet) {
    const std::size_t tileBytes = planet.colour() ? colourTileBytes(planet.colour()->format) : 0;
    return planet.paging().residentBytesCpu + planet.paging().residentBytesGpu +
           planet.tiles(BlockKind::Colours).residentTiles * tileBytes;
}

// Where a chunk begins and ends among all chunks of maxLevel, in quadtree order, which goes face by face.
struct Stretch {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
};
Stretch stretchOf(const ChunkId& id) {
    std::uint64_t place = static_cast<std::uint64_t>(id.face);
    for (int bit = id.level - 1; bit >= 0; --bit)
        place = place << 2 | ((id.y >> bit & 1u) << 1) | (id.x >> bit & 1u);
    const int below = 2 * (maxLevel - id.level);
    return {place << below, (place + 1) << below};
}

// Every place of the planet lies in just one drawn chunk.
bool coversThePlanet(const Planet& planet) {
    std::vector<Stretch> drawn;
    for (const DrawItem& item : planet.selection().draw) drawn.push_back(stretchOf(item.id));
    std::sort(drawn.begin(), drawn.end(),
              [](const Stretch& a, const Stretch& b) { return a.begin < b.begin; });
    std::uint64_t covered = 0;
    for (const Stretch& stretch : drawn) {
        if (stretch.begin != covered) return false;
        covered = stretch.end;
    }
    return covered == std::uint64_t{faceCount} << (2 * maxLevel);
}

// Its heights are resident and uploaded, and all numbers are such.
bool isDrawable(const Planet& planet, const DrawItem& item, const FilledSlots& pool) {
    const ChunkNode& node = planet.tree().nodes[item.node];
    return node.id == item.id && node.slot == item.slot &&
           item.slot < planet.paging()[BlockKind::Heights].capacity && item.slot < pool.slots.size() &&
           pool.slots[item.slot] == node.heights->view().toVector() && std::isfinite(item.epsPx) &&
           std::isfinite(item.skirtDepthM) && item.morph >= 0 && item.morph <= 1;
}

bool keepsItsExtremes(const ChunkNode& node) {
    const auto [low, high] = std::minmax_element(node.heights->begin(), node.heights->end());
    return *low >= node.minStep && *high <= node.maxStep;
}

// What a flight came to.
struct Flown {
    bool settled = false;
    std::set<ChunkId> drawn;
    std::set<BlockId> failed;
    std::set<BlockId> loaded;
    std::vector<std::string> problems;
    int frames = 0;
    std::size_t mostBytes = 0;  // resident
    std::uint64_t evicted = 0;
};

class Dive {
public:
    Dive(std::unique_ptr<Planet> planet, std::size_t place)
        : planet_(std::move(planet)), place_(place), budget_(planet_->pagingSettings().budgetBytes) {}

    Flown fly() {
        for (int frame = 0; frame < framesADive; ++frame) step(frame);
        for (int left = mostFramesToSettle; left > 0 && !planet_->settled(); --left) step(framesADive);
        Flown flown{planet_->settled(), {}, {}, {}, planet_->takeProblems()};
        for (const DrawItem& item : planet_->selection().draw) {
            flown.drawn.insert(item.id);
            EXPECT_TRUE(keepsItsExtremes(planet_->tree().nodes[item.node])) << toString(item.id);
        }
        for (const PagingEvent& event : planet_->inspect().pagingHistory()) {
            if (event.outcome == PagingOutcome::Failed) flown.failed.insert({event.parent, event.kind});
            if (event.outcome == PagingOutcome::Loaded) flown.loaded.insert({event.parent, event.kind});
        }
        flown.frames = frames_;
        flown.mostBytes = mostBytes_;
        flown.evicted = planet_->paging()[BlockKind::Heights].evicted;
        return flown;
    }

private:
    void step(int frame) {
        ++frames_;
        const ViewInput view = diveView(place_, frame);
        planet_->step(
            {&view, 1}, [&](std::uint32_t slot, auto heights) { pool_.put(slot, heights); }, 0.02);
        planet_->takeTileChanges(BlockKind::Colours);
        EXPECT_TRUE(coversThePlanet(*planet_));
        mostBytes_ = std::max(mostBytes_, residentBytes(*planet_));
        EXPECT_LE(mostBytes_, budget_);
        for (const DrawItem& item : planet_->selection().draw)
            EXPECT_TRUE(isDrawable(*planet_, item, pool_)) << toString(item.id);
    }

    std::unique_ptr<Planet> planet_;
    std::size_t place_;
    std::size_t budget_;
    FilledSlots pool_;
    int frames_ = 0;
    std::size_t mostBytes_ = 0;
};

// Reads of a planet that is given bytes; none may lie outside, nor be asked for.
ReadAt checkedReader(const Bytes& bytes) {
    return [&bytes](std::uint64_t offset, std::span<std::byte> out) -> Result<void> {
        const bool inside = offset <= bytes.size() && out.size() <= bytes.size() - offset;
        EXPECT_TRUE(inside) << out.size() << " bytes at " << offset << " of " << bytes.size();
        if (!inside) return ioError("outside");
        std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(offset), out.size(), out.begin());
        return {};
    };
}

Result<std::unique_ptr<Planet>> openPlanet(const Bytes& bytes, const PagingSettings& settings) {
    auto file = ChunkFile::open(fileName, bytes.size(), checkedReader(bytes));
    if (!file) return tl::unexpected(file.error());
    Result<PlanetSource> source = planetSource(*std::move(file));
    if (!source) return tl::unexpected(std::move(source.error()));
    return Planet::open(*std::move(source), settings);
}

const Flown& wholeFlight(std::size_t place) {
    static std::map<std::size_t, Flown> flights;
    const auto found = flights.find(place);
    if (found != flights.end()) return found->second;
    auto planet = openPlanet(bakedEarth().bytes, pagingSettings(false));
    return flights[place] = Dive(std::move(*planet), place).fly();
}

// ---- what is done to the file ----

enum class Change { Flip, Cut, Swap, Duplicate, Zero };
constexpr std::array changeNames = {"bits flipped", "cut", "swapped", "duplicated", "zeroed"};
enum class Aim { Header, Entries, Payload, Checksum, Colours, Anywhere };
constexpr std::array aimNames = {"header", "entries", "payload", "checksum", "colours", "anywhere"};

struct Mutation {
    Change change = Change::Flip;
    Aim aim = Aim::Anywhere;
    bool resealed = false;
    Bytes bytes;
};

struct Range {
    std::size_t offset = 0;
    std::size_t size = 0;
};

class Mutator {
public:
    // Most of what it changes is met on the way to a place.
    Mutator(std::uint32_t seed, std::size_t place) : random_(seed), met_(wholeFlight(place).loaded) {}

    Mutation make(int number) {
        Mutation mutation;
        mutation.change = static_cast<Change>(number % static_cast<int>(changeNames.size()));
        mutation.aim = static_cast<Aim>(number / 5 % static_cast<int>(aimNames.size()));
        mutation.resealed = number / 30 % 2 == 1;
        mutation.bytes = bakedEarth().bytes;
        const Range target = aimed(mutation.aim);
        apply(mutation, part(target, 64), target);
        if (mutation.resealed) test::reseal(mutation.bytes);
        return mutation;
    }

private:
    std::size_t below(std::size_t end) { return random_() % std::max<std::size_t>(end, 1); }

    // Where a mutation begins.
    Range aimed(Aim aim) {
        const BakedEarth& earth = bakedEarth();
        if (aim == Aim::Header) return {0, chunkFileHeaderBytes};
        if (aim == Aim::Anywhere) return {0, earth.bytes.size()};
        for (;;) {
            const test::FileBlock& block = earth.blocks[below(earth.blocks.size())];
            const auto offset = static_cast<std::size_t>(block.at.offset);
            const std::size_t end = block.at.size - checksumBytes;
            const bool colours = block.id.kind == BlockKind::Colours;
            if (colours != (aim == Aim::Colours)) continue;
            if (block.isRoot ? below(8) > 0 : !met_.contains(block.id) && below(8) > 0) continue;
            if (aim == Aim::Entries && block.entriesBytes == 0) continue;
            if (aim == Aim::Entries) return {offset, block.entriesBytes};
            if (aim == Aim::Checksum) return {offset + end, checksumBytes};
            if (aim == Aim::Payload) return {offset + block.entriesBytes, end - block.entriesBytes};
            return {offset, block.at.size};
        }
    }

    Range part(const Range& whole, std::size_t most) {
        const std::size_t size = 1 + below(std::min(whole.size, most));
        return {whole.offset + below(whole.size - size + 1), size};
    }

    void apply(Mutation& mutation, const Range& here, const Range& target) {
        Bytes& bytes = mutation.bytes;
        const auto at = [&](std::size_t offset) {
            return bytes.begin() + static_cast<std::ptrdiff_t>(offset);
        };
        const Range there = {below(2) ? target.offset + below(target.size - here.size + 1)
                                      : below(bytes.size() - here.size + 1),
                             here.size};
        switch (mutation.change) {
            case Change::Flip:
                for (std::size_t left = 1 + below(8); left > 0; --left)
                    *at(here.offset + below(here.size)) ^= static_cast<std::byte>(1u << below(8));
                break;
            case Change::Cut:  // off the end, or out of the middle
                bytes.erase(at(here.offset), below(2) ? bytes.end() : at(here.offset + here.size));
                break;
            case Change::Swap: {
                const Bytes kept(at(here.offset), at(here.offset + here.size));
                std::copy_n(Bytes(at(there.offset), at(there.offset + here.size)).begin(), here.size,
                            at(here.offset));
                std::copy(kept.begin(), kept.end(), at(there.offset));
                break;
            }
            case Change::Duplicate: {  // over what is there, or between
                const Bytes copy(at(here.offset), at(here.offset + here.size));
                if (below(2))
                    bytes.insert(at(there.offset), copy.begin(), copy.end());
                else
                    std::copy(copy.begin(), copy.end(), at(there.offset));
                break;
            }
            case Change::Zero:
                std::fill(at(here.offset), at(here.offset + here.size), std::byte{0});
                break;
        }
    }

    std::mt19937 random_;
    const std::set<BlockId>& met_;
};

// Which blocks of the whole file have other bytes now where they lay.
struct Damage {
    bool header = false;
    std::set<BlockId> blocks;  // but roots
    std::set<BlockId> roots;

    explicit Damage(const Bytes& bytes) {
        const Bytes& whole = bakedEarth().bytes;
        const auto differs = [&](std::size_t offset, std::size_t size) {
            return offset + size > bytes.size() || std::memcmp(&bytes[offset], &whole[offset], size) != 0;
        };
        header = differs(0, chunkFileHeaderBytes);
        for (const test::FileBlock& block : bakedEarth().blocks) {
            if (differs(static_cast<std::size_t>(block.at.offset), block.at.size))
                (block.isRoot ? roots : blocks).insert(block.id);
        }
    }
    bool none() const { return !header && blocks.empty() && roots.empty(); }
};

// ---- what must hold ----

struct Figures {
    std::map<std::string, std::array<int, 2>> opened;  // by change and aim, of how many
    int resealed = 0, refused = 0, unharmed = 0, reported = 0, tiles = 0, asParents = 0, frames = 0;
    std::size_t mostBytes = 0, mostBytesTight = 0;  // resident, by the budget
    std::uint64_t evicted = 0;
};

// Whether a chunk lies under one whose block of children is among those.
bool liesUnder(const ChunkId& id, const std::set<BlockId>& blocks, ChunkId* highest = nullptr) {
    for (int level = 0; level < id.level; ++level) {
        const ChunkId above = ancestorOf(id, level);
        if (!blocks.contains({above})) continue;
        if (highest) *highest = above;
        return true;
    }
    return false;
}

void expectNamed(const std::string& problem) {
    EXPECT_NE(problem.find(fileName), std::string::npos) << problem;
}

// Whether a problem is about a block: by its own name, or that of a chunk or tile in it.
bool isAbout(const std::string& problem, const BlockId& block) {
    const std::string kind = block.kind == BlockKind::Colours ? "colour tile " : "chunk ";
    const auto names = [&](const ChunkId& id) {
        const std::size_t at = problem.find(kind + toString(id));
        return at != std::string::npos && std::isdigit(problem[at + kind.size() + toString(id).size()]) == 0;
    };
    for (int q = 0; q < quadrantCount; ++q) {
        if (names(childOf(block.parent, q))) return true;
    }
    return names(block.parent);
}

// Each block that failed was damaged, and is told of by its name and the file's.
void expectReported(const Flown& flown, const Damage& damage, bool resealed) {
    for (const std::string& problem : flown.problems) expectNamed(problem);
    for (const BlockId& block : flown.failed) {
        if (!resealed) {
            EXPECT_TRUE(damage.blocks.contains(block)) << toString(block);
        }
        EXPECT_TRUE(std::any_of(flown.problems.begin(), flown.problems.end(),
                                [&](const std::string& problem) { return isAbout(problem, block); }))
            << toString(block) << "\n"
            << (flown.problems.empty() ? "" : flown.problems[0]);
    }
}

// Where nothing was damaged, what is drawn is what the whole file gives; under a block that fails, its parent
// is drawn.
void expectDrawn(const Flown& flown, std::size_t place, const Damage& damage, bool resealed,
                 Figures& figures) {
    std::set<ChunkId> parents;
    for (const ChunkId& id : wholeFlight(place).drawn) {
        ChunkId above;
        if (!liesUnder(id, damage.blocks, &above)) {
            EXPECT_TRUE(flown.drawn.contains(id)) << toString(id);
        } else if (!resealed) {
            EXPECT_TRUE(flown.drawn.contains(above)) << toString(above);
            EXPECT_TRUE(flown.failed.contains({above})) << toString(above);
            parents.insert(above);
        } else if (flown.failed.contains({above})) {
            EXPECT_TRUE(flown.drawn.contains(above)) << toString(above);
            parents.insert(above);
        }
    }
    figures.asParents += static_cast<int>(parents.size());
}

// What the whole flight met of colours, and those of the faces that are read at once.
void expectColoursReported(const Flown& flown, std::size_t place, const Damage& damage) {
    for (const BlockId& root : damage.roots) {
        EXPECT_TRUE(std::any_of(flown.problems.begin(), flown.problems.end(),
                                [&](const std::string& problem) { return isAbout(problem, root); }))
            << toString(root);
    }
    for (const BlockId& block : wholeFlight(place).loaded) {
        const bool damaged = block.kind == BlockKind::Colours && damage.blocks.contains(block) &&
                             !damage.roots.contains(block);
        if (damaged) {
            EXPECT_TRUE(flown.failed.contains(block)) << toString(block);
        }
    }
}

bool refusedRightly(const Error& error, const Damage& damage) {
    expectNamed(error.message);
    EXPECT_EQ(error.kind, ErrorKind::BadInput) << error.message;
    const bool heights = std::any_of(damage.roots.begin(), damage.roots.end(),
                                     [](const BlockId& root) { return root.kind == BlockKind::Heights; });
    return damage.header || heights;
}

void flyOver(int number, Figures& figures) {
    const std::size_t place = static_cast<std::size_t>(number / 60) % flownPlaces.size();
    const Mutation mutation = Mutator(static_cast<std::uint32_t>(number), place).make(number);
    SCOPED_TRACE(fmt::format(
        "mutation {}: {} {}, {}", number, aimNames[static_cast<std::size_t>(mutation.aim)],
        changeNames[static_cast<std::size_t>(mutation.change)], mutation.resealed ? "resealed" : "as it is"));
    Damage damage(mutation.bytes);
    const bool longer = mutation.bytes.size() != bakedEarth().bytes.size();
    const bool tight = number % 7 == 0;
    auto& [opened, tried] =
        figures.opened[fmt::format("{} {}", aimNames[static_cast<std::size_t>(mutation.aim)],
                                   changeNames[static_cast<std::size_t>(mutation.change)])];
    ++tried;
    figures.resealed += mutation.resealed;
    auto planet = openPlanet(mutation.bytes, pagingSettings(tight));
    if (!planet) {
        EXPECT_TRUE(refusedRightly(planet.error(), damage) || longer) << planet.error().message;
        ++figures.refused;
        return;
    }
    ++opened;
    figures.unharmed += damage.none();
    if (!mutation.resealed) {
        EXPECT_FALSE(damage.header || longer) << "a header that was changed is taken";
    }
    const Flown flown = Dive(std::move(*planet), place).fly();
    EXPECT_TRUE(flown.settled);
    figures.frames += flown.frames;
    std::size_t& most = tight ? figures.mostBytesTight : figures.mostBytes;
    most = std::max(most, flown.mostBytes);
    figures.evicted += flown.evicted;
    expectReported(flown, damage, mutation.resealed);
    if (!damage.header && !tight && damage.roots.empty())
        expectDrawn(flown, place, damage, mutation.resealed, figures);
    if (!mutation.resealed && !tight) expectColoursReported(flown, place, damage);
    figures.reported += !flown.problems.empty();
    for (const BlockId& block : flown.failed) figures.tiles += block.kind == BlockKind::Colours;
}

class MutatedFile : public testing::TestWithParam<int> {};

TEST_P(MutatedFile, IsRefusedOrDrawnWithItsDamageReported) {
    Figures figures;
    for (int i = 0; i < mutationsEach && !HasFailure(); ++i) flyOver(GetParam() * mutationsEach + i, figures);
    int opened = 0;
    for (const auto& [kind, counts] : figures.opened) {
        std::cout << fmt::format("  {:22} {:3} of {:3} opened\n", kind, counts[0], counts[1]);
        opened += counts[0];
    }
    std::cout << fmt::format(
        "{} mutations{}, {} of them resealed: {} refused, {} flown over in {} frames ({} of a whole file), "
        "of "
        "which {} reported damage; {} blocks drawn as their parents, {} of colours as checkers; at most {} "
        "of {} "
        "bytes resident, and {} of {} where the budget is tight, with {} blocks evicted\n",
        mutationsEach, tests::sanitized ? " (fewer, under a sanitizer)" : "", figures.resealed,
        figures.refused, opened, figures.frames, figures.unharmed, figures.reported, figures.asParents,
        figures.tiles, figures.mostBytes, pagingSettings(false).budgetBytes, figures.mostBytesTight,
        pagingSettings(true).budgetBytes, figures.evicted);
    RecordProperty("refused", figures.refused);
    RecordProperty("flown", opened);
    RecordProperty("reported", figures.reported);
    EXPECT_GT(figures.refused, 0);
    EXPECT_GT(figures.asParents, 0);
}

INSTANTIATE_TEST_SUITE_P(Shards, MutatedFile, testing::Range(0, shards));

}  // namespace
}  // namespace planet
