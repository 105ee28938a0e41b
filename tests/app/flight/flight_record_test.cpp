#include "app/flight/flight_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <xxhash.h>
#include <zstd.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>
#include <set>
#include <sstream>
#include <thread>

#include "app/cli/replay_command.h"
#include "app/flight/flight_path_file.h"
#include "app/flight/flight_replay.h"
#include "app/flight/recorder.h"
#include "app/scene/scene_settings.h"
#include "planet/bake/bake.h"
#include "planet/base/little_endian.h"
#include "planet/measure/lod_changes.h"
#include "planet/planet_tools.h"
#include "planet/source/height_source.h"
#include "tests/support/sparse_source.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using testing::HasSubstr;
using tests::TemporaryFolder;

// A planet of hills in a file, and flights over it.
class FlightRecordTest : public testing::Test {
protected:
    FlightRecordTest() { bakeTo("hills.chk", 257); }

    void bakeTo(const std::string& name, int faceSize) const {
        const std::filesystem::path image = folder_ / "hills.pgm";
        std::ofstream stream(image, std::ios::binary);
        stream << "P5\n256 128\n255\n";
        for (int i = 0; i < 256 * 128; ++i)
            stream.put(static_cast<char>(
                std::lround(100 + 100 * std::sin(0.15 * (i % 256)) * std::cos(0.2 * (i / 256)))));
        stream.close();
        planet::HeightSourceSettings scale;
        scale.metresPerUnit = 20;
        const auto source = planet::openHeightSource(image, scale);
        planet::BakeSettings settings;
        settings.faceSize = faceSize;
        settings.chunkSize = 17;
        settings.radiusM = 1e5;
        if (!source || !planet::bake(*source, settings, folder_ / name)) throw std::runtime_error("no bake");
    }
    std::unique_ptr<planet::Planet> openPlanet(const ViewSettings& settings) const {
        return planet::Planet::open(folder_ / "hills.chk", pagingSettingsOf(settings)).value();
    }
    static planet::View viewAt(int frame) {
        planet::CameraPose pose;
        pose.latitudeDeg = 10 + 0.1 * frame;
        pose.longitudeDeg = 20 + 0.2 * frame;
        pose.altitudeM = 60'000 / (1 + 0.05 * frame) + 6000;
        pose.pitchDeg = -60;
        return planet::viewFromPose(pose, 1e5, 1.1, 1280, 720);
    }
    static void step(planet::Planet& planet, Recorder& recorder, const ViewSettings& settings, int frame,
                     bool observed = false, bool paused = false, double elapsedS = 1.0 / 60) {
        EXPECT_TRUE(headless(planet).apply(
            settings, paused,
            settings.paging.simulated ? planet::PagingTime::Simulated : planet::PagingTime::Clock));
        recorder.givenSettings(planet, settings, paused);
        const std::array<planet::ViewInput, 2> views = {
            {{viewAt(frame), lodSettingsOf(settings), 1, {}, normalSettingsOf(settings)},
             {viewAt(300 - frame), lodSettingsOf(settings), 0.5, {}, normalSettingsOf(settings)}}};
        planet.step(std::span(views).first(observed ? 2 : 1), headless(planet).upload, elapsedS);
        constexpr std::array<double, 2> factors = {1, 0.5};
        recorder.stepped(planet, factors);
    }

    // A region below the flight.
    static RegionSettings spot(double tauFactor, double radiusM = 8'000) {
        planet::Region region;
        region.name = "spot";
        region.circles = {{{14, 28}, radiusM}};
        region.borderM = 3'000;
        region.tauFactor = tauFactor;
        return {.list = std::make_shared<const std::vector<planet::Region>>(1, region)};
    }

    // With all that can happen between frames.
    Recorder flyAbout(planet::Planet& planet, ViewSettings settings, int frames) const {
        Recorder recorder(planet, "about");
        for (int frame = 0; frame < frames; ++frame) {
            if (frame == 30) settings.lod.tauPx = 3.7;
            if (frame == 40) settings.regions = spot(0.5);
            if (frame == 95) settings.regions = spot(4);
            if (frame == 60) settings.paging.badDisk.seed = 9;
            if (frame == 80) settings.surface.exaggeration = 2.5;
            if (frame == 90) settings.paging.budgetMB = 16;
            if (frame == 50) {
                planet.tools().dropAll();
                recorder.called(planet, FlightCall::DropAll);
            }
            if (settings.paging.prefetch.mode == planet::PrefetchMode::Announced && frame % 16 == 0) {
                std::vector<planet::AnnouncedView> ahead;
                for (int later = 10; later <= 60; later += 10)
                    ahead.push_back({viewAt(frame + later), later / 60.0});
                planet.announce(ahead);
                recorder.announced(planet, ahead);
            }
            const bool paused = frame >= 70 && frame < 78;
            if (frame == 74) {
                planet.tools().loadOne();
                recorder.called(planet, FlightCall::LoadOne);
            }
            if (frame == 100) {
                planet.tools().retryFailed();
                recorder.called(planet, FlightCall::RetryFailed);
            }
            if (frame == 105 && !planet.inspect().failedBlocks().empty()) {
                const planet::BlockId block = planet.inspect().failedBlocks().front().block;
                planet.tools().retryFailed(block);
                recorder.called(planet, FlightCall::RetryBlock, block);
            }
            step(planet, recorder, settings, frame, frame > 110, paused);
            if (!settings.paging.simulated) std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
        return recorder;
    }
    static ViewSettings troubled(bool simulated) {
        ViewSettings settings;
        settings.lod.tauPx = 1.5;
        settings.paging.simulated = simulated;
        settings.paging.loaderThreads = 2;
        settings.paging.badDisk = {.latencyMs = simulated ? 20.0 : 0.3, .failureRate = 0.15, .seed = 3};
        return settings;
    }

    std::filesystem::path written(const Recorder& recorder) const {
        std::filesystem::path file = folder_ / "a.flight";
        const planet::Result<void> done = recorder.write(file);
        EXPECT_TRUE(done) << done.error().message;
        return file;
    }
    FlightReplay replayed(FlightRecord record, ReplayPaging paging, std::vector<std::string> set = {}) const {
        FlightReplay replay = FlightReplay::create(std::make_shared<const FlightRecord>(std::move(record)),
                                                   paging, std::move(set))
                                  .value();
        const auto planet = planet::Planet::open(folder_ / "hills.chk", replay.pagingAtStart()).value();
        replay.rewind(*planet);
        while (!replay.atEnd()) EXPECT_TRUE(replay.step(headless(*planet)));
        return replay;
    }
    // A record of one frame after another, each for so long with a view, over the planet's radius.
    static FlightRecord recordOf(const std::vector<planet::CameraPose>& poses, double elapsedS = 1.0 / 60) {
        FlightRecord record;
        record.data.shape.radiusM = 1e5;
        for (const planet::CameraPose& pose : poses) {
            FlightFrame& frame = record.frames.emplace_back();
            frame.elapsedS = elapsedS;
            frame.views.resize(1);
            frame.views[0].view = planet::viewFromPose(pose, 1e5, 1.1, 1280, 720);
        }
        return record;
    }
    // By whole selections, one a frame.
    static std::vector<FlightChange> changesOfLevelIn(const FlightRecord& record) {
        std::vector<FlightChange> expected;
        planet::LodChanges changes;
        std::set<planet::ChunkId> drawn;
        for (std::size_t i = 0; i < record.frames.size(); ++i) {
            const FlownView& view = record.frames[i].views[0];
            for (const planet::ChunkId& id : view.vanished) drawn.erase(id);
            drawn.insert(view.appeared.begin(), view.appeared.end());
            planet::Selection selection;
            std::set<planet::ChunkId> above;
            for (const planet::ChunkId& id : drawn) {
                selection.draw.emplace_back().id = id;
                for (planet::ChunkId up = id; up.level > 0;) above.insert(up = planet::parentOf(up));
            }
            for (const planet::ChunkId& id : above) selection.splits.push_back({planet::noNode, id, 0});
            changes.add(selection, static_cast<double>(i));
            FlightChange change{i, 0, 0};
            for (const planet::LodChange& one : changes.recent()) {
                if (one.timeS != static_cast<double>(i)) continue;
                ++(one.type == planet::LodChangeType::Split ? change.splits : change.merges);
            }
            if (i > 0 && change.splits + change.merges > 0) expected.push_back(change);
        }
        return expected;
    }
    // What is wrong with a file of these frames, each with a view of its own.
    std::string errorOfFrames(std::vector<FlightFrame> frames, const std::string& name = "made") const {
        FlightEncoder encoder;
        for (FlightFrame& frame : frames) {
            if (frame.views.empty()) frame.views.resize(1);
            for (FlownView& view : frame.views) view.view = viewAt(0);
            encoder.add(frame);
        }
        const FlightData data = flightDataOf(planet::ChunkFile::open(folder_ / "hills.chk").value());
        EXPECT_TRUE(encoder.write(folder_ / "made.flight", name, data));
        return errorOf(folder_ / "made.flight");
    }
    static std::string firstOf(const FlightReplay& replay) {
        const auto& first = replay.firstDifference();
        return first ? first->what + " of frame " + std::to_string(first->frame) : "none";
    }
    std::string errorOf(const std::filesystem::path& file) const {
        const auto record = loadFlightRecord(file);
        return record ? "no error" : record.error().message;
    }

    // The content of a file, and a file of some content with the right checksum.
    static std::string contentOf(const std::filesystem::path& file) {
        std::ifstream stream(file, std::ios::binary);
        const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
        std::uint64_t size = 0;
        std::memcpy(&size, bytes.data() + 12, 8);
        std::string content(size, 0);
        ZSTD_decompress(content.data(), size, bytes.data() + 28, bytes.size() - 28);
        return content;
    }
    std::filesystem::path fileOf(const std::string& content, std::uint32_t version = 1) const {
        std::string packed(ZSTD_compressBound(content.size()), 0);
        packed.resize(ZSTD_compress(packed.data(), packed.size(), content.data(), content.size(), 1));
        std::vector<std::byte> header;
        planet::ByteWriter out(header);
        out.put(version);
        out.put(static_cast<std::uint64_t>(content.size()));
        out.put(static_cast<std::uint64_t>(XXH3_64bits(content.data(), content.size())));
        std::filesystem::path file = folder_ / "made.flight";
        std::ofstream stream(file, std::ios::binary);
        stream << "WYFLIGHT";
        stream.write(reinterpret_cast<const char*>(header.data()),
                     static_cast<std::streamsize>(header.size()));
        stream << packed;
        return file;
    }

    const TemporaryFolder folder_;
};

TEST_F(FlightRecordTest, ARecordingHoldsItsRegions) {
    const ViewSettings plain;
    const auto planet = openPlanet(plain);
    Recorder recorder(*planet, "regions");
    ViewSettings settings = plain;
    settings.regions = spot(0.05, 60'000);
    std::size_t inRegion = 0;
    for (int frame = 0; frame < 60; ++frame) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        step(*planet, recorder, settings, frame);
        for (const planet::DrawItem& item : planet->selection().draw) inRegion += item.tauFactor < 1;
    }
    EXPECT_GT(inRegion, 100u);
    FlightRecord record = loadFlightRecord(written(recorder)).value();
    EXPECT_EQ(replayed(record, ReplayPaging::AsRecorded).framesDifferent(), 0u);
    EXPECT_EQ(replayed(record, ReplayPaging::AsRecorded).settings().regions.all(), settings.regions.all());
    // Without them, the planet does something else.
    EXPECT_GT(replayed(record, ReplayPaging::AsRecorded, {"regions.on=false"}).framesDifferent(), 0u);
    std::erase_if(record.frames[0].calls[0].settings,
                  [](const std::string& one) { return one.starts_with("regions="); });
    EXPECT_GT(replayed(record, ReplayPaging::AsRecorded).framesDifferent(), 0u);
    const std::vector<std::string> broken = {"regions=[[region]]\nname = \"a\"\ntau_factor = 0\n"};
    ViewSettings into;
    EXPECT_FALSE(applyFlightSettings(broken, into));
}

TEST_F(FlightRecordTest, AFlightByTheClockReplaysExactlyAsRecorded) {
    const ViewSettings settings = troubled(false);
    const auto planet = openPlanet(settings);
    // Something before the recording.
    planet->settle(viewAt(90), lodSettingsOf(settings), headless(*planet).upload, 60);
    const Recorder recorder = flyAbout(*planet, settings, 150);
    EXPECT_GT(planet->paging()[planet::BlockKind::Heights].loaded, 10u);
    const FlightReplay replay =
        replayed(loadFlightRecord(written(recorder)).value(), ReplayPaging::AsRecorded);
    EXPECT_EQ(firstOf(replay), "none");
    EXPECT_EQ(replay.next(), 150u);
    EXPECT_NEAR(replay.timeS(), 2.5, 1e-9);
}

TEST_F(FlightRecordTest, AFlightBySimulatedTimeReplaysExactlyEitherWay) {
    const auto planet = openPlanet(troubled(true));
    const Recorder recorder = flyAbout(*planet, troubled(true), 150);
    EXPECT_GT(planet->paging()[planet::BlockKind::Heights].failed, 0u);
    const FlightRecord record = loadFlightRecord(written(recorder)).value();
    EXPECT_EQ(firstOf(replayed(record, ReplayPaging::Simulated)), "none");
    EXPECT_EQ(firstOf(replayed(record, ReplayPaging::AsRecorded)), "none");
}

TEST_F(FlightRecordTest, PrefetchesReplayExactlyEitherWay) {
    for (const auto mode : {planet::PrefetchMode::Motion, planet::PrefetchMode::Announced}) {
        for (const bool simulated : {false, true}) {
            ViewSettings settings = troubled(simulated);
            settings.paging.prefetch = {.mode = mode, .horizonS = 1, .share = 0.8};
            const auto planet = openPlanet(settings);
            planet->settle(viewAt(90), lodSettingsOf(settings), headless(*planet).upload, 60);
            const Recorder recorder = flyAbout(*planet, settings, 150);
            EXPECT_GT(planet->paging().prefetch().blocks, 5u);
            const FlightRecord record = loadFlightRecord(written(recorder)).value();
            EXPECT_EQ(firstOf(replayed(record, ReplayPaging::AsRecorded)), "none");
            if (!simulated) continue;
            EXPECT_EQ(firstOf(replayed(record, ReplayPaging::Simulated)), "none");
        }
    }
}

TEST_F(FlightRecordTest, AnnouncedViewsAreCheckedAsTheyAreRead) {
    const auto planet = openPlanet(troubled(true));
    Recorder recorder(*planet, "announced");
    const std::vector<planet::AnnouncedView> ahead = {{viewAt(40), 0.5}, {viewAt(90), 3599}};
    planet->announce(ahead);
    recorder.announced(*planet, ahead);
    step(*planet, recorder, troubled(true), 0);
    const FlightRecord record = loadFlightRecord(written(recorder)).value();
    const CalledInFlight& called = record.frames[0].calls[0];
    ASSERT_EQ(called.call, FlightCall::Announce);
    ASSERT_EQ(called.announced.size(), 2u);
    EXPECT_EQ(called.announced[1].view, viewAt(90));
    EXPECT_EQ(called.announced[1].inS, 3599);

    Recorder tooLate(*planet, "too late");
    tooLate.announced(*planet, std::vector<planet::AnnouncedView>{{viewAt(40), 3601}});
    step(*planet, tooLate, troubled(true), 0);
    EXPECT_FALSE(loadFlightRecord(written(tooLate)));
    Recorder tooMany(*planet, "too many");
    tooMany.announced(*planet, std::vector<planet::AnnouncedView>(planet::maxAnnounced + 1, {viewAt(40), 1}));
    step(*planet, tooMany, troubled(true), 0);
    EXPECT_FALSE(loadFlightRecord(written(tooMany)));
}

// The flight crosses the rim of the fine part.
TEST_F(FlightRecordTest, AFlightOverASparseFileReplaysExactlyEitherWay) {
    constexpr double degrees = 0.017453292519943295;
    const planet::FacePoint middle =
        planet::facePointFromDirection(planet::directionFromGeographic({20 * degrees, 40 * degrees}));
    const planet::test::FineBox fine =
        planet::test::boxAround(planet::cubePoint(middle.face, middle.u, middle.v), 0.15, 4096);
    const auto rough = [](const glm::dvec3& d) {
        return 200 * std::sin(2001 * d.x + 7 * d.z) * std::sin(1809 * d.y + 1507 * d.z);
    };
    ASSERT_TRUE(
        planet::bake(planet::test::sparse(planet::test::formulaSource(rough, -200, 200, 0, 4097), {fine}),
                     {.chunkSize = 17, .radiusM = 1e5}, folder_ / "hills.chk"));
    const planet::ChunkFileInfo info = planet::ChunkFile::open(folder_ / "hills.chk").value().info();
    ASSERT_EQ(planet::deepestLevelOf(info.shape), 8);
    ASSERT_EQ(info.coarsestLeafLevel, 5);
    ViewSettings settings = troubled(true);
    settings.lod.tauPx = 0.5;
    settings.paging.badDisk.latencyMs = 2;
    const auto planet = openPlanet(settings);
    const Recorder recorder = flyAbout(*planet, settings, 150);
    const FlightRecord record = loadFlightRecord(written(recorder)).value();
    std::set<int> levels;
    for (const FlightFrame& frame : record.frames) {
        for (const planet::ChunkId& id : frame.views[0].appeared) levels.insert(id.level);
    }
    EXPECT_TRUE(levels.contains(6)) << "nothing finer than the coarsest leaves is drawn";
    EXPECT_EQ(firstOf(replayed(record, ReplayPaging::Simulated)), "none");
    EXPECT_EQ(firstOf(replayed(record, ReplayPaging::AsRecorded)), "none");
}

TEST_F(FlightRecordTest, AFlightOverADamagedFileReplaysExactlyThoughTheFileIsMended) {
    const std::filesystem::path file = folder_ / "hills.chk";
    std::stringstream whole;
    whole << std::ifstream(file, std::ios::binary).rdbuf();
    const auto chunks = planet::ChunkFile::open(file).value();
    const planet::BlockLocation damaged = chunks.readRoot(planet::Face::PosX).value().children;
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(static_cast<std::streamoff>(damaged.offset + 40));
    stream << "damage";
    stream.close();
    const auto planet = openPlanet(troubled(true));
    const FlightRecord record = loadFlightRecord(written(flyAbout(*planet, troubled(true), 120))).value();
    EXPECT_GT(planet->paging().failedPermanently(), 0u);
    std::size_t bad = 0, failed = 0, byName = 0;
    for (const FlightFrame& frame : record.frames) {
        for (const planet::PagingMoves::Arrival& arrival : frame.moves.arrived) {
            bad += arrival.badData;
            failed += arrival.outcome == planet::PagingOutcome::Failed;
        }
        for (const CalledInFlight& called : frame.calls) byName += called.call == FlightCall::RetryBlock;
    }
    EXPECT_GT(bad, 0u);
    EXPECT_GT(failed, bad);
    EXPECT_EQ(byName, 1u);
    EXPECT_EQ(firstOf(replayed(record, ReplayPaging::Simulated)), "none");
    EXPECT_EQ(firstOf(replayed(record, ReplayPaging::AsRecorded)), "none");
    std::ofstream(file, std::ios::binary | std::ios::trunc) << whole.str();
    EXPECT_EQ(firstOf(replayed(record, ReplayPaging::AsRecorded)), "none");
}

TEST_F(FlightRecordTest, WhatWasRecordedBeforeThereWereRetriesHasNone) {
    const auto planet = openPlanet(troubled(true));
    FlightRecord record = loadFlightRecord(written(flyAbout(*planet, troubled(true), 5))).value();
    const auto retriesOf = [](const FlightRecord& flown) {
        const auto shared = std::make_shared<const FlightRecord>(flown);
        return FlightReplay::create(shared, ReplayPaging::AsRecorded).value().pagingAtStart().retry.retries;
    };
    EXPECT_EQ(retriesOf(record), planet::RetryRules{}.retries);
    for (CalledInFlight& called : record.frames[0].calls) {
        std::erase_if(called.settings,
                      [](const std::string& one) { return one.starts_with("paging.retries="); });
    }
    EXPECT_EQ(retriesOf(record), 0);
}

TEST_F(FlightRecordTest, AFlightWithTilesOfNormalsReplaysExactlyEitherWay) {
    bakeTo("hills.chk", 513);
    ViewSettings settings = troubled(true);
    settings.surface.light.normals = {planet::gl::FeatureUse::On, 2};
    const auto planet = openPlanet(settings);
    const FlightRecord record = loadFlightRecord(written(flyAbout(*planet, settings, 120))).value();
    std::size_t ofNormals = 0;
    for (const FlightFrame& frame : record.frames) {
        for (const planet::PagingMoves::Arrival& arrival : frame.moves.arrived)
            ofNormals += arrival.block.kind == planet::BlockKind::Normals;
    }
    EXPECT_GT(ofNormals, 5u);
    EXPECT_EQ(firstOf(replayed(record, ReplayPaging::Simulated)), "none");
    EXPECT_EQ(firstOf(replayed(record, ReplayPaging::AsRecorded)), "none");
}

TEST_F(FlightRecordTest, WhetherNormalsAreUsedIsAsItWasOnTheMachineThatRecorded) {
    ViewSettings settings = troubled(true);
    for (const bool used : {false, true}) {
        planet::PagingSettings paging = pagingSettingsOf(settings);
        paging.normals = used;
        const auto planet = planet::Planet::open(folder_ / "hills.chk", paging).value();
        Recorder recorder(*planet, "automatic");
        recorder.givenSettings(*planet, settings, false);
        planet->step(viewAt(0), lodSettingsOf(settings), headless(*planet).upload);
        constexpr std::array<double, 1> factors = {1};
        recorder.stepped(*planet, factors);
        const FlightReplay replay =
            FlightReplay::create(
                std::make_shared<const FlightRecord>(loadFlightRecord(written(recorder)).value()),
                ReplayPaging::AsRecorded, {})
                .value();
        EXPECT_EQ(replay.pagingAtStart().normals, used);
    }
}

TEST_F(FlightRecordTest, AnotherSeedReplaysDifferently) {
    const auto planet = openPlanet(troubled(true));
    const FlightRecord record = loadFlightRecord(written(flyAbout(*planet, troubled(true), 60))).value();
    const FlightReplay replay = replayed(record, ReplayPaging::Simulated, {"bad_disk.seed=4"});
    EXPECT_GT(replay.framesDifferent(), 0u);
    EXPECT_EQ(replay.settings().paging.badDisk.seed, 4u);
    EXPECT_FALSE(FlightReplay::create(std::make_shared<const FlightRecord>(record), ReplayPaging::Simulated,
                                      {"bad_disk.sead=4"}));
}

TEST_F(FlightRecordTest, AFrameThatWasNotSoIsFoundWithItsChunk) {
    const auto planet = openPlanet(troubled(true));
    const FlightRecord record = loadFlightRecord(written(flyAbout(*planet, troubled(true), 60))).value();
    std::size_t at = 20;
    while (record.frames[at].views[0].appeared.empty()) ++at;
    FlightRecord other = record;
    const planet::ChunkId missing = other.frames[at].views[0].appeared.back();
    other.frames[at].views[0].appeared.pop_back();
    ++other.frames[at].selectionHash;
    const FlightReplay replay = replayed(other, ReplayPaging::Simulated);
    EXPECT_EQ(firstOf(replay), "selection of frame " + std::to_string(at));
    EXPECT_THAT(replay.firstDifference()->onlyReplayed, testing::ElementsAre(missing));
    EXPECT_THAT(replay.firstDifference()->onlyRecorded, testing::IsEmpty());
    EXPECT_EQ(replay.framesDifferent(), 1u);

    other = record;
    at = 0;
    while (other.frames[at].moves.arrived.empty()) ++at;
    other.frames[at].moves.arrived.clear();
    EXPECT_EQ(firstOf(replayed(other, ReplayPaging::Simulated)), "arrivals of frame " + std::to_string(at));
    EXPECT_GT(replayed(other, ReplayPaging::AsRecorded).framesDifferent(), 0u);  // what is missing is missed
    other = record;
    other.frames[0].moves.requested.pop_back();
    EXPECT_EQ(firstOf(replayed(other, ReplayPaging::Simulated)), "requests of frame 0");
}

TEST_F(FlightRecordTest, AFlightIsSmall) {
    const ViewSettings settings;
    const auto planet = openPlanet(settings);
    // Ten seconds of frames that are never quite as long as the one before.
    const auto bytesPerS = [&](bool flying) {
        Recorder recorder(*planet, "ten seconds");
        for (int i = 0; i < 600; ++i) {
            const double elapsedS = (1 + 0.1 * std::sin(1.7 * i * i)) / 60;
            step(*planet, recorder, settings, flying ? i : 0, false, false, elapsedS);
        }
        return static_cast<double>(std::filesystem::file_size(written(recorder))) / 10;
    };
    const double still = bytesPerS(false), flying = bytesPerS(true);
    RecordProperty("still_bytes_per_s", std::to_string(still));
    RecordProperty("flying_bytes_per_s", std::to_string(flying));
    EXPECT_LT(still, 1024);
    EXPECT_LT(flying, 20 * 1024);
}

TEST_F(FlightRecordTest, CutOffOrDamagedItIsAnErrorThatNamesTheFile) {
    const auto planet = openPlanet(troubled(true));
    const std::filesystem::path file = written(flyAbout(*planet, troubled(true), 60));
    const std::uintmax_t whole = std::filesystem::file_size(file);
    for (std::uintmax_t size = 0; size < whole; size += 1 + size / 3) {
        std::filesystem::copy_file(file, folder_ / "cut.flight",
                                   std::filesystem::copy_options::overwrite_existing);
        std::filesystem::resize_file(folder_ / "cut.flight", size);
        EXPECT_THAT(errorOf(folder_ / "cut.flight"), HasSubstr("cut.flight: ")) << size;
    }
    EXPECT_THAT(errorOf(folder_ / "none.flight"), HasSubstr("none.flight: no such file"));
    EXPECT_THAT(errorOf(folder_ / "hills.chk"), HasSubstr("not a recorded flight"));
    EXPECT_THAT(errorOf(fileOf(contentOf(file), 7)), HasSubstr("version 7; expected 1"));
    EXPECT_EQ(errorOf(fileOf(contentOf(file))), "no error");
    EXPECT_THAT(errorOf(fileOf(contentOf(file) + "x")), HasSubstr("data after the end"));
}

TEST_F(FlightRecordTest, ANumberThatIsTooLargeOrTooLongIsNotSaidToBeCutOff) {
    // The first number of a recording is the length of its name.
    const std::string tooLarge = std::string(9, '\xFF') + '\x02';
    EXPECT_THAT(errorOf(fileOf(tooLarge)), HasSubstr("number out of range"));
    EXPECT_THAT(errorOf(fileOf(std::string("\x80\0", 2))), HasSubstr("number out of range"));
    EXPECT_THAT(errorOf(fileOf("\x80")), HasSubstr("truncated"));
    EXPECT_THAT(errorOf(fileOf("")), HasSubstr("truncated"));
}

// With the right checksum: each byte may be anything.
TEST_F(FlightRecordTest, WhateverItHoldsItIsReadOrRefused) {
    const auto planet = openPlanet(troubled(true));
    const std::string content = contentOf(written(flyAbout(*planet, troubled(true), 20)));
    std::size_t refused = 0;
    const std::size_t stride = content.size() / 100 + 1;
    for (std::size_t at = 0; at < content.size(); at += stride) {
        for (const char value : {'\xFF', '\x00'}) {
            std::string bad = content;
            bad[at] = value;
            const std::string error = errorOf(fileOf(bad));
            if (error == "no error") continue;
            EXPECT_THAT(error, HasSubstr("made.flight: "));
            ++refused;
        }
        EXPECT_THAT(errorOf(fileOf(content.substr(0, at))), HasSubstr("made.flight: "));
    }
    EXPECT_GT(refused, 20u);
}

TEST_F(FlightRecordTest, NumbersThatAreNoneAreRefused) {
    const auto planet = openPlanet({});
    const FlightData data = flightDataOf(planet->file());
    FlightFrame good;
    good.views.resize(1);
    good.views[0].view = viewAt(0);
    const auto errorWith = [&](const FlightFrame& frame) {
        FlightEncoder encoder;
        encoder.add(frame);
        EXPECT_TRUE(encoder.write(folder_ / "one.flight", "one", data));
        return errorOf(folder_ / "one.flight");
    };
    EXPECT_EQ(errorWith(good), "no error");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    FlightFrame bad = good;
    bad.elapsedS = nan;
    EXPECT_THAT(errorWith(bad), HasSubstr("frame 1: value nan; expected [0, 1000000]"));
    bad = good;
    bad.views[0].view.eyeM.y = nan;
    EXPECT_THAT(errorWith(bad), HasSubstr("nan"));
    bad = good;
    bad.views[0].view.up *= 1.5;
    EXPECT_THAT(errorWith(bad), HasSubstr("right angles"));
    bad = good;
    bad.views[0].view.widthPx = 0;
    EXPECT_THAT(errorWith(bad), HasSubstr("0 x 720 pixels"));
    bad = good;
    bad.views.clear();
    EXPECT_THAT(errorWith(bad), HasSubstr("0 views"));
    bad = good;
    bad.views[0].appeared = {{planet::Face::PosX, 9, 1, 1}};  // deeper than the planet
    EXPECT_THAT(errorWith(bad), HasSubstr("unknown chunk"));
    bad = good;
    bad.calls = {{.call = FlightCall::Settings, .settings = {"lod.tau_px=0"}}};
    EXPECT_THAT(errorWith(bad), HasSubstr("tau_px"));
    bad.calls[0].settings = {"window.width_px=800"};
    EXPECT_THAT(errorWith(bad), HasSubstr("is not a view setting"));
}

TEST_F(FlightRecordTest, MoreCallsThanARecorderWritesAreRefused) {
    FlightFrame most;
    most.calls.resize(maxCallsAFrame);
    EXPECT_EQ(errorOfFrames({most}), "no error");
    FlightFrame more = most;
    more.calls.emplace_back();
    EXPECT_THAT(errorOfFrames({more}),
                HasSubstr("made.flight: frame 1: 1001 calls in a frame; expected at most 1000"));
    EXPECT_THAT(errorOfFrames(std::vector<FlightFrame>(maxFlightCalls / maxCallsAFrame + 1, most)),
                HasSubstr("more than 432000 calls"));
    FlightFrame settings;
    settings.calls.push_back({.call = FlightCall::Settings});
    settings.calls[0].settings = flightSettings(ViewSettings{});
    EXPECT_EQ(errorOfFrames({settings}), "no error");
    settings.calls[0].settings.push_back("lod.tau_px=3");
    EXPECT_THAT(errorOfFrames({settings}), HasSubstr("settings in a call"));
}

TEST_F(FlightRecordTest, ChunksThatCannotAppearOrVanishAreRefused) {
    const planet::ChunkId a{planet::Face::PosX, 1, 0, 0}, b{planet::Face::PosX, 1, 0, 1};
    const auto frameOf = [](std::vector<planet::ChunkId> appeared, std::vector<planet::ChunkId> vanished) {
        FlightFrame frame;
        frame.views.resize(1);
        frame.views[0].appeared = std::move(appeared);
        frame.views[0].vanished = std::move(vanished);
        return frame;
    };
    EXPECT_EQ(errorOfFrames({frameOf({a, b}, {}), frameOf({}, {a, b}), frameOf({b}, {})}), "no error");
    EXPECT_THAT(errorOfFrames({frameOf({a, a}, {})}), HasSubstr("duplicate or unsorted appearance"));
    EXPECT_THAT(errorOfFrames({frameOf({b, a}, {})}), HasSubstr("duplicate or unsorted appearance"));
    EXPECT_THAT(errorOfFrames({frameOf({a}, {}), frameOf({a}, {})}),
                HasSubstr("frame 2: " + toString(a) + " appears although already drawn"));
    EXPECT_THAT(errorOfFrames({frameOf({a}, {}), frameOf({}, {b})}),
                HasSubstr(toString(b) + " vanishes although not drawn"));
    EXPECT_THAT(errorOfFrames({frameOf({a}, {}), frameOf({}, {a, a})}),
                HasSubstr("duplicate or unsorted disappearance"));
    EXPECT_THAT(errorOfFrames({frameOf({a}, {}), frameOf({a}, {a})}),
                HasSubstr("appears although already drawn"));
}

TEST_F(FlightRecordTest, MoreThanAMillionSecondsAreRefused) {
    FlightFrame half;
    half.elapsedS = 5e5;
    EXPECT_EQ(errorOfFrames({half, half}), "no error");
    EXPECT_THAT(errorOfFrames({half, half, half}), HasSubstr("later than 1000000 s"));
    half.elapsedS = -1;
    EXPECT_THAT(errorOfFrames({half}), HasSubstr("value -1; expected [0, 1000000]"));
}

TEST_F(FlightRecordTest, TextsThatAreNotUtf8AreRefused) {
    EXPECT_THAT(errorOfFrames(std::vector<FlightFrame>(1), "caf\xE9"), HasSubstr("name is not UTF-8"));
    FlightFrame frame;
    frame.calls.push_back({.call = FlightCall::Settings, .settings = {"lod.tau_px=\xFF"}});
    EXPECT_THAT(errorOfFrames({frame}), HasSubstr("setting is not UTF-8"));
}

TEST_F(FlightRecordTest, ARecorderEndsBeforeAFrameThatNoFileMayHold) {
    const auto planet = openPlanet({});
    Recorder recorder(*planet, "a");
    step(*planet, recorder, {}, 0);
    for (std::size_t i = 0; i <= maxCallsAFrame; ++i) recorder.called(*planet, FlightCall::RetryFailed);
    EXPECT_FALSE(recorder.encoded().full());
    step(*planet, recorder, {}, 1);
    EXPECT_TRUE(recorder.encoded().full());
    EXPECT_EQ(loadFlightRecord(written(recorder)).value().frames.size(), 1u);

    Recorder slow(*planet, "slow");
    for (int frame = 0; frame < 3; ++frame) step(*planet, slow, {}, frame, false, false, 4e5);
    EXPECT_TRUE(slow.encoded().full());
    EXPECT_EQ(loadFlightRecord(written(slow)).value().frames.size(), 2u);
}

// As where the GPU had no room for a budget.
TEST_F(FlightRecordTest, WhatThePlanetHasOfPagingIsRecorded) {
    ViewSettings settings;
    settings.paging.budgetMB = 300;
    const auto planet = openPlanet(settings);
    Recorder recorder(*planet, "a");
    ViewSettings asked = settings;
    asked.paging.budgetMB = 60'000;
    asked.lod.tauPx = 3;
    recorder.givenSettings(*planet, asked, false);
    planet->step(viewAt(0), lodSettingsOf(asked), headless(*planet).upload);
    constexpr std::array<double, 1> factors = {1};
    recorder.stepped(*planet, factors);
    const FlightRecord record = loadFlightRecord(written(recorder)).value();
    ViewSettings recorded;
    EXPECT_TRUE(applyFlightSettings(record.frames[0].calls[0].settings, recorded));
    EXPECT_EQ(recorded.paging.budgetMB, 300);
    EXPECT_EQ(recorded.lod.tauPx, 3);
}

TEST_F(FlightRecordTest, AnotherFileIsToldApart) {
    bakeTo("other.chk", 129);
    std::filesystem::copy_file(folder_ / "hills.chk", folder_ / "copy.chk");
    const auto dataOf = [&](const char* name) {
        return flightDataOf(planet::ChunkFile::open(folder_ / name).value());
    };
    EXPECT_TRUE(checkSameData("a.flight", dataOf("hills.chk"), dataOf("copy.chk")));
    const auto other = checkSameData("a.flight", dataOf("hills.chk"), dataOf("other.chk"));
    ASSERT_FALSE(other);
    EXPECT_THAT(other.error().message, HasSubstr("a.flight: was recorded with a different file than"));
    EXPECT_THAT(other.error().message, HasSubstr("faces of 257 samples in chunks of 17, not 129 in 17"));
    FlightData header = dataOf("hills.chk");
    ++header.headerHash;
    EXPECT_FALSE(checkSameData("a.flight", header, dataOf("hills.chk")));
}

TEST_F(FlightRecordTest, ACameraMayFollowIt) {
    const auto planet = openPlanet({});
    const FlightPath path = loadFlightPath(written(flyAbout(*planet, {}, 120))).value();
    EXPECT_EQ(path.name, "about");
    EXPECT_NEAR(durationS(path), 2, 0.15);  // keys are a tenth of a second apart
    EXPECT_GE(path.keys.size(), 15u);
    const planet::CameraPose pose = poseAt(path, path.keys[5].timeS);
    const planet::CameraPose flown =
        planet::poseFromView(viewAt(static_cast<int>(std::lround(path.keys[5].timeS * 60)) - 1), 1e5);
    EXPECT_NEAR(pose.latitudeDeg, flown.latitudeDeg, 1e-6);
    EXPECT_NEAR(pose.altitudeM, flown.altitudeM, 1e-3);
    Recorder moment(*planet, "moment");
    step(*planet, moment, {}, 0);
    EXPECT_FALSE(loadFlightPath(written(moment)));
}

// Half round the planet and down, as to a bookmark, halfway through two seconds.
TEST_F(FlightRecordTest, ACameraThatFollowsItJumpsWhereItJumped) {
    std::vector<planet::CameraPose> poses;
    for (int i = 0; i < 120; ++i) {
        poses.push_back({.latitudeDeg = 10 + 0.01 * i, .longitudeDeg = 20, .altitudeM = 30'000});
        if (i >= 63) poses.back() = {.latitudeDeg = -5, .longitudeDeg = 150 + 0.01 * i, .altitudeM = 2'000};
    }
    const FlightPath path = pathOf(recordOf(poses), "a.flight").value();
    EXPECT_LE(path.keys.size(), 23u);
    const double jumpS = 64.0 / 60;
    for (double timeS = path.keys.front().timeS; timeS < 2; timeS += 1.0 / 977) {
        const planet::CameraPose pose = poseAt(path, timeS);
        const bool before = timeS < jumpS - 1e-9;
        EXPECT_NEAR(pose.latitudeDeg, before ? std::min(10 + 0.01 * (60 * timeS - 1), 10.62) : -5, 0.02)
            << timeS;
        EXPECT_NEAR(pose.longitudeDeg, before ? 20 : 150 + 0.01 * (60 * timeS - 1), 0.03) << timeS;
        EXPECT_NEAR(pose.altitudeM, before ? 30'000 : 2'000, 1) << timeS;
    }
    EXPECT_NEAR(poseAt(path, jumpS - 1e-6).latitudeDeg, 10.62, 1e-9);
    EXPECT_NEAR(poseAt(path, jumpS + 1e-12).longitudeDeg, 150.63, 1e-9);
}

TEST_F(FlightRecordTest, AJumpIsToldByArcByHeightAndByBoth) {
    const auto jumpsIn = [](const planet::CameraPose& from, const planet::CameraPose& to, double elapsedS) {
        const FlightPath path = pathOf(recordOf({from, from, to, to}, elapsedS), "a.flight").value();
        return std::count_if(path.keys.begin(), path.keys.end(),
                             [](const FlightKey& key) { return key.jumpedTo; });
    };
    const auto poseAt = [](double latitudeDeg, double altitudeM) {
        return planet::CameraPose{.latitudeDeg = latitudeDeg, .altitudeM = altitudeM};
    };
    const planet::CameraPose high = poseAt(0, 50'000), low = poseAt(0, 500);
    EXPECT_EQ(jumpsIn(high, poseAt(5.1, 50'000), 0.1), 1);
    EXPECT_EQ(jumpsIn(high, poseAt(4.9, 50'000), 0.1), 0);
    EXPECT_EQ(jumpsIn(high, poseAt(5.1, 50'000), 0.2), 0);
    EXPECT_EQ(jumpsIn(high, poseAt(0, 4'900), 0.1), 1);
    EXPECT_EQ(jumpsIn(high, poseAt(0, 5'100), 0.1), 0);
    EXPECT_EQ(jumpsIn(low, poseAt(0.29, 500), 0.1), 1);
    EXPECT_EQ(jumpsIn(low, poseAt(0.28, 500), 0.1), 0);
}

TEST_F(FlightRecordTest, SplitsAndMergesAreThoseOfTheChangesOfLevel) {
    const auto planet = openPlanet(troubled(true));
    const FlightRecord record = loadFlightRecord(written(flyAbout(*planet, troubled(true), 150))).value();
    const std::vector<FlightChange> expected = changesOfLevelIn(record);
    const std::vector<FlightChange> found = changesIn(record);
    ASSERT_EQ(found.size(), expected.size());
    EXPECT_GT(found.size(), 10u);
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].frame, expected[i].frame);
        EXPECT_EQ(found[i].splits, expected[i].splits) << expected[i].frame;
        EXPECT_EQ(found[i].merges, expected[i].merges) << expected[i].frame;
    }
}

TEST_F(FlightRecordTest, SplitsAndMergesAreToldFromIt) {
    const auto planet = openPlanet(troubled(true));
    const FlightRecord record = loadFlightRecord(written(flyAbout(*planet, troubled(true), 120))).value();
    int splits = 0, merges = 0;
    for (const FlightChange& change : changesIn(record)) {
        splits += change.splits;
        // All that was loaded is dropped before frame 50.
        if (change.frame == 50) {
            merges = change.merges;
        }
    }
    EXPECT_GT(splits, 10);
    EXPECT_GT(merges, 3);
}

// Names of files may be any bytes; JSON is UTF-8.
TEST_F(FlightRecordTest, AReportOfAFileWhoseNameIsNotUtf8IsWritten) {
    const std::filesystem::path copy = folder_ / "h\xE9.chk";
    std::filesystem::copy_file(folder_ / "hills.chk", copy);
    const auto planet = planet::Planet::open(copy, pagingSettingsOf(ViewSettings{})).value();
    ReplayOptions options;
    options.flight = written(flyAbout(*planet, troubled(true), 5));
    options.report.file = folder_ / "out.json";
    const planet::Result<bool> exact = replayFlight(options);
    ASSERT_TRUE(exact) << exact.error().message;
    EXPECT_GT(std::filesystem::file_size(options.report.file), 100u);
}

TEST_F(FlightRecordTest, theFileThatARecordingNamesIsNotReplacedByTheReport) {
    const std::filesystem::path copy = folder_ / "flown.chk";
    std::filesystem::copy_file(folder_ / "hills.chk", copy);
    const auto planet = planet::Planet::open(copy, pagingSettingsOf(ViewSettings{})).value();
    ReplayOptions options;
    options.flight = written(flyAbout(*planet, troubled(true), 5));
    options.report.file = copy;
    const planet::Result<bool> replayed = replayFlight(options);
    ASSERT_FALSE(replayed);
    EXPECT_THAT(replayed.error().message, testing::HasSubstr("flown.chk: is an input of this command"));
    EXPECT_TRUE(planet::ChunkFile::open(copy));
}

TEST_F(FlightRecordTest, WithoutAFrameNothingIsWritten) {
    const auto planet = openPlanet({});
    const Recorder recorder(*planet, "nothing");
    EXPECT_FALSE(recorder.write(folder_ / "nothing.flight"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "nothing.flight"));
}

}  // namespace
}  // namespace worldy
