// Selection, paging, re-bakes, swaps and cancelling, all at once and at random, with what must hold after
// each step. Meant for the thread sanitizer; the rest runs them too.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <iostream>
#include <map>
#include <random>
#include <set>
#include <thread>

#include "planet/bake/bake.h"
#include "planet/planet.h"
#include "planet/planet_tools.h"
#include "tests/support/held_tiles.h"
#include "tests/support/random_view.h"
#include "tests/support/sanitized.h"
#include "tests/support/synthetic_colours.h"
#include "tests/support/synthetic_source.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

// WORLDY_HAMMER_STEPS, or as many as are given, a third under a sanitizer.
int hammerSteps(int usual) {
    const char* asked = std::getenv("WORLDY_HAMMER_STEPS");
    return asked ? std::atoi(asked) : tests::sanitized ? usual / 3 : usual;
}

// What is drawn and what is culled cover each face once.
void expectCovered(const Selection& selection, const ChunkTree& tree) {
    std::set<ChunkId> parts;
    std::array<double, faceCount> covered{};
    const auto add = [&](const ChunkId& id) {
        ASSERT_TRUE(parts.insert(id).second) << toString(id);
        covered[static_cast<std::size_t>(id.face)] += std::ldexp(1.0, -2 * id.level);
    };
    for (const DrawItem& item : selection.draw) add(item.id);
    for (const VisitedNode& visited : selection.touched) {
        if (visited.fate == NodeFate::CulledFrustum || visited.fate == NodeFate::CulledHorizon)
            add(tree.nodes[visited.node].id);
    }
    for (const double share : covered) ASSERT_EQ(share, 1);
    for (const ChunkId& id : parts) {
        for (int level = 0; level < id.level; ++level)
            ASSERT_FALSE(parts.contains(ancestorOf(id, level))) << toString(id);
    }
}

// A planet and what a renderer would hold of it, called at random.
class Hammered {
public:
    Hammered(std::filesystem::path path, std::uint32_t seed) : path_(std::move(path)), random_(seed) {
        settings_.budgetBytes = 8 << 20;
        settings_.normalShare = 0.8;
        settings_.colourShare = 0.1;
        settings_.loaderThreads = 4;
        open();
    }

    void step() {
        act(static_cast<int>(random_() % 50));
        const std::array views = {viewInput(), viewInput()};
        const std::size_t count = 1 + random_() % 2;
        if (random_() % 4 == 0)
            planet_->step(std::span(views).first(count), upload(), 1.0 / 60);
        else
            planet_->step(std::span(views).first(count), upload());
        followTiles();
        expectSound();
    }

    std::uint64_t opened() const { return opened_; }
    std::uint64_t loaded() const { return loaded_ + planet_->paging()[BlockKind::Heights].loaded; }
    std::uint64_t dropped() const { return dropped_ + planet_->paging()[BlockKind::Heights].evicted; }
    const Planet& planet() const { return *planet_; }

private:
    void open() {
        if (planet_) {
            loaded_ += planet_->paging()[BlockKind::Heights].loaded;
            dropped_ += planet_->paging()[BlockKind::Heights].evicted;
        }
        auto opened = Planet::open(path_, settings_);
        ASSERT_TRUE(opened) << opened.error().message;
        planet_ = std::move(*opened);
        heights_.clear();
        ++opened_;
    }

    UploadChunk upload() {
        return [this](std::uint32_t slot, StepsView steps) {
            ASSERT_LT(slot, planet_->paging()[BlockKind::Heights].capacity);
            heights_[slot].assign(steps.begin(), steps.end());
        };
    }

    ViewInput viewInput() {
        ViewInput input;
        input.lodView = randomView(random_, planet_->tree().shape.radiusM);
        input.lod.tauPx = random_() % 3 == 0 ? 0.2 : 2;
        input.lod.seams = static_cast<SeamMode>(random_() % 3);
        input.lod.morph = random_() % 2 == 0;
        input.lod.fadeS = random_() % 3 == 0 ? 0.3 : 0;
        input.lod.hysteresis = random_() % 2 == 0 ? 0.2 : 0;
        input.priorityFactor = random_() % 2 == 0 ? 1 : 0.5;
        input.colours = {.enabled = random_() % 4 != 0, .texelsPerPixel = 2};
        input.normals = {.enabled = random_() % 4 != 0, .texelsPerPixel = 2};
        return input;
    }

    void act(int what) {
        switch (what) {
            case 0:
                return change([&] { settings_.loaderThreads = 1 + static_cast<int>(random_() % 8); });
            case 1:
                return change([&] { settings_.budgetBytes = (5 + random_() % 8) << 20; });
            case 2:
                return change([&] { settings_.paused = !settings_.paused; });
            case 3:
            case 20:
                return change([&] { settings_.badDisk = badDisk(); });
            case 4:
                return change([&] { settings_.badDisk = {}; });
            case 5:
                return change([&] { settings_.normals = !settings_.normals; });
            case 6:
            case 21:
            case 22:
                return change([&] { settings_.time = static_cast<PagingTime>(random_() % 3); });
            case 7:
            case 23:
            case 24:
                return change([&] { settings_.time = PagingTime::Clock; });
            case 8:
                return change([&] { settings_.colourShare = random_() % 2 == 0 ? 0.1 : 0.2; });
            case 9:
                return planet_->tools().dropAll();
            case 10:
                return planet_->tools().reset();
            case 11:
                return planet_->setExaggeration(0.5 + static_cast<double>(random_() % 3));
            case 12:
                return planet_->tools().retryFailed();
            case 13:
                return planet_->tools().loadOne();
            case 14:
                return look();
            case 15:
                return settle();
            case 16:
                return planet_->reloadTiles(BlockKind::Colours);
            case 17:
                return planet_->reloadTiles(BlockKind::Normals);
            case 18:
                return planet_->tools().keepMoves(random_() % 2 == 0);
            case 19:
                return random_() % 4 == 0 ? open() : void();
            default:
                return;  // fly on
        }
    }

    template <class Edit>
    void change(const Edit& edit) {
        edit();
        const Result<bool> moved = planet_->setPaging(settings_);
        ASSERT_TRUE(moved) << moved.error().message;
        if (!*moved) return;
        heights_.clear();
        planet_->uploadAll(upload());
    }

    BadDiskSettings badDisk() {
        return {.latencyMs = static_cast<double>(random_() % 5),
                .bandwidthMBs = random_() % 2 == 0 ? 0.0 : 20.0,
                .failureRate = random_() % 2 == 0 ? 0.0 : 0.2,
                .shuffledOrder = random_() % 2 == 0,
                .seed = static_cast<std::uint32_t>(random_())};
    }

    // All that panels read.
    void look() {
        for (const PagingType type : {PagingType::PageIn, PagingType::PageOut})
            static_cast<void>(planet_->inspect().pendingRequests(type));
        static_cast<void>(planet_->inspect().loadingNow());
        static_cast<void>(planet_->takeProblems());
        static_cast<void>(planet_->tools().takeMoves());
        ASSERT_LE(planet_->inspect().pagingHistory().size(), 1000u);
    }

    void settle() {
        const ViewInput input = viewInput();
        planet_->settle(std::span(&input, 1), upload(), 0.02);
    }

    void followTiles() {
        const auto ignored = [](const TileData&) {};
        colours_.follow(planet_->takeTileChanges(BlockKind::Colours), ignored);
        normals_.follow(planet_->takeTileChanges(BlockKind::Normals), ignored);
        if (planet_->paging()[BlockKind::Normals].capacity == 0) normals_.tiles.clear();
        ASSERT_EQ(colours_.tiles.size(),
                  planet_->colour() ? planet_->paging()[BlockKind::Colours].resident : 0);
        ASSERT_LE(colours_.tiles.size(), planet_->paging()[BlockKind::Colours].capacity);
        ASSERT_EQ(normals_.tiles.size(), planet_->tiles(BlockKind::Normals).residentTiles);
        ASSERT_LE(normals_.tiles.size(), planet_->paging()[BlockKind::Normals].capacity);
    }

    void expectSound() {
        const PagingCounters& paging = planet_->paging();
        ASSERT_LE(paging.residentBytesCpu + paging.residentBytesGpu, settings_.budgetBytes);
        std::set<std::uint32_t> slots;
        forEachNode(planet_->tree(), [&](NodeIndex, const ChunkNode& node) {
            ASSERT_TRUE(slots.insert(node.slot).second) << toString(node.id);
            ASSERT_LT(node.slot, planet_->paging()[BlockKind::Heights].capacity);
            ASSERT_EQ(heights_.at(node.slot), node.heights->view().toVector()) << toString(node.id);
        });
        ASSERT_EQ(slots.size(), planet_->tree().residentChunks);
        for (std::size_t v = 0; v < planet_->views().size(); ++v) {
            const Selection& selection = planet_->selection(v);
            expectCovered(selection, planet_->tree());
            for (const DrawItem& item : selection.draw) {
                ASSERT_EQ(findNode(planet_->tree(), item.id), item.node);
                ASSERT_EQ(planet_->tree().nodes[item.node].slot, item.slot);
            }
        }
    }

    std::filesystem::path path_;
    std::mt19937 random_;
    PagingSettings settings_;
    std::unique_ptr<Planet> planet_;
    std::map<std::uint32_t, std::vector<std::int32_t>> heights_;  // by slot
    HeldTiles colours_, normals_;
    std::uint64_t opened_ = 0;
    std::uint64_t loaded_ = 0;
    std::uint64_t dropped_ = 0;
};

class Threads : public testing::Test {
protected:
    void SetUp() override {
        BakeSettings settings{.faceSize = 513, .chunkSize = 33};
        settings.colour.faceSize = 513;
        ASSERT_TRUE(bake(heights_, settings, path_, {}, &colours_));
    }

    // Bakes again and again, every other one cancelled after a while.
    void bakeOver(const std::filesystem::path& path, std::uint32_t seed) {
        std::mt19937 random(seed);
        while (!stopping_) {
            BakeSettings settings{.faceSize = random() % 2 == 0 ? 129 : 257, .chunkSize = 33};
            settings.colour.faceSize = 257;
            const int cancelAfter = random() % 2 == 0 ? static_cast<int>(random() % 6) : 1'000'000;
            std::atomic<int> told = 0;
            const auto goOn = [&](const BakeProgress&) { return ++told <= cancelAfter && !stopping_; };
            const Result<BakeReport> baked = bake(heights_, settings, path, goOn, &colours_);
            if (baked)
                ++baked_;
            else if (baked.error().kind == ErrorKind::Cancelled)
                ++cancelled_;
            else
                ADD_FAILURE() << baked.error().message;
        }
    }

    tests::TemporaryFolder folder_;
    const std::filesystem::path path_ = folder_ / "hills.chk";
    const HeightSource heights_ = test::hillsSource();
    const ColourSource colours_ = test::formulaColours(test::mottled);
    std::atomic<bool> stopping_ = false;
    std::atomic<int> baked_ = 0, cancelled_ = 0;
};

TEST_F(Threads, SettingsViewsAndCallsAtRandomLeaveThePlanetSound) {
    const int steps = hammerSteps(1500);
    for (const std::uint32_t seed : {1u, 2u}) {
        Hammered hammered(path_, seed);
        for (int i = 0; i < steps; ++i) {
            hammered.step();
            if (HasFatalFailure()) FAIL() << "seed " << seed << ", step " << i;
        }
        std::cout << steps << " steps, seed " << seed << ": " << hammered.loaded() << " blocks loaded, "
                  << hammered.dropped() << " dropped\n";
        EXPECT_GT(hammered.loaded(), static_cast<std::uint64_t>(steps / 10));
        EXPECT_GT(hammered.dropped(), 0u);
    }
}

TEST_F(Threads, BakesOntoTheFileThatIsFlownOverAndBesideItDisturbNothing) {
    const int steps = hammerSteps(1000);
    {
        std::jthread onto([&] { bakeOver(path_, 3); });
        std::jthread beside([&] { bakeOver(folder_ / "other.chk", 4); });
        Hammered hammered(path_, 5);
        for (int i = 0; i < steps || ((baked_ < 3 || cancelled_ < 3) && i < 1'000'000); ++i) {
            hammered.step();
            if (!HasFatalFailure()) continue;
            stopping_ = true;
            FAIL() << "step " << i;
        }
        stopping_ = true;
        std::cout << steps << " steps beside " << baked_ << " bakes and " << cancelled_
                  << " that were cancelled; opened " << hammered.opened() << " times, " << hammered.loaded()
                  << " blocks loaded\n";
    }
    // Nothing half done is left.
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
        EXPECT_EQ(entry.path().extension(), ".chk") << entry.path();
    EXPECT_TRUE(ChunkFile::open(path_));
}

}  // namespace
}  // namespace planet
