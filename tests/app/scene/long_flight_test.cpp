// A long flight drawn with all there is: streamed colours in tiles and in a clipmap, normals, shadows, air
// and sea. No GL object, no byte of GPU memory and no file handle is left over. WORLDY_FLIGHT_SECONDS says
// how many simulated seconds to fly.
#include "tests/support/long_flight.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <iostream>
#include <sstream>

#include "planet/gl/device/object_counts.h"
#include "planet/gl/device/render_target.h"
#include "tests/app/session_fixture.h"
#include "tests/support/synthetic_colours.h"
#include "tests/support/synthetic_source.h"

namespace worldy {
namespace {

using planet::gl::countObjects;
using planet::gl::FeatureUse;
using planet::gl::ObjectCounts;
using planet::test::Holding;

std::string countsText(const ObjectCounts& counts) {
    std::ostringstream stream;
    stream << counts.buffers << " buffers, " << counts.textures << " textures, " << counts.vertexArrays
           << " vertex arrays, " << counts.framebuffers << " framebuffers, " << counts.renderbuffers
           << " renderbuffers, " << counts.queries << " queries, " << counts.programs << " programs, "
           << counts.shaders << " shaders";
    return stream.str();
}

// The least of some moments: tables of the air come and go in the background, and so do the driver's
// compilers.
void lower(std::optional<Holding>& least) {
    glFinish();  // nor what is still to be drawn
    planet::test::giveBackFreed();
    const Holding now;
    if (!least) least = now;
    least->residentBytes = std::min(least->residentBytes, now.residentBytes);
    least->heapBytes = std::min(least->heapBytes, now.heapBytes);
    least->files = std::min(least->files, now.files);
    least->threads = std::min(least->threads, now.threads);
}

class LongFlightDrawn : public test::SessionTest {
protected:
    static constexpr int widthPx = 96, heightPx = 64;

    LongFlightDrawn() {
        settings_.paging.simulated = true;
        settings_.paging.badDisk = {.latencyMs = 10, .bandwidthMBs = 2};
        settings_.paging.budgetMB = 8;
        settings_.paging.colourShare = 0.1;
        settings_.paging.normalShare = 0.8;
        settings_.lod.tauPx = 0.02;
        settings_.surface.texelsPerPixel = 4;
        settings_.surface.light.normals.use = FeatureUse::On;
        settings_.surface.light.normals.texelsPerPixel = 4;
        settings_.surface.light.shadows.use = FeatureUse::On;
        settings_.surface.light.sea.use = FeatureUse::On;
        settings_.surface.clipmapSizePx = 256;
        const planet::ColourSource colours = planet::test::formulaColours(planet::test::mottled);
        planet::BakeSettings bake{.faceSize = 513, .chunkSize = 33};
        bake.colour.faceSize = 513;
        for (const auto& file : files_) {
            if (!planet::bake(planet::test::hillsSource(), bake, file, {}, &colours))
                throw std::runtime_error("no bake");
            bake.chunkSize = 17;
        }
        target_ = planet::gl::RenderTarget::create(widthPx, heightPx).value();
    }

    void draw(Scene& scene, const planet::View& view) {
        target_->bind();
        drawScene(scene, view, settings_);
    }

    const std::array<std::filesystem::path, 2> files_ = {folder_ / "a.chk", folder_ / "b.chk"};
    std::optional<planet::gl::RenderTarget> target_;
};

TEST_F(LongFlightDrawn, HoldsNoMoreAtItsEndThanAtItsStart) {
    const auto frames = static_cast<std::uint64_t>(planet::test::flightSeconds(60) / planet::test::frameS);
    constexpr std::uint64_t drawnEvery = 6;  // the rest is only flown
    constexpr std::uint64_t phases = 12;
    const ObjectCounts before = countObjects();
    const Holding atStart;
    ObjectCounts objectsEarly, objectsLate;
    std::size_t mostGpuBytesEarly = 0, mostGpuBytes = 0;
    std::optional<Holding> holdingEarly, holdingLate;  // the least
    planet::test::PagingWatch paging;
    {
        auto scene = openScene({.chunkFile = files_[0]}, settings_);
        ASSERT_TRUE(scene) << scene.error().message;
        planet::test::RandomFlight flight(9, scene->planet->tree().shape.radiusM);
        for (std::uint64_t frame = 0; frame < frames; ++frame, flight.step()) {
            // The same way twice: the programs made for the first serve the second.
            if (frame == frames / 2)
                flight = planet::test::RandomFlight(9, scene->planet->tree().shape.radiusM);
            // In and out of the clipmap, whose memory comes and goes.
            const std::uint64_t phase = frame * phases / frames;
            const bool clipmap = phase % 2 == 0;
            settings_.surface.colourMode = clipmap ? ColourMode::Clipmap : ColourMode::Tiles;
            ASSERT_TRUE(applyLiveSettings(*scene, settings_));
            // Chosen for a large picture, drawn in a small one.
            stepScene(*scene, flight.view(1280, 720), settings_, planet::test::frameS);
            paging.look(*scene->planet);
            const bool endsPhase = (frame + 1) * phases / frames > phase;
            if (frame % drawnEvery != 0 && !endsPhase) continue;
            draw(*scene, flight.view(widthPx, heightPx));
            const std::size_t gpuBytes = scene->renderer.chunks().gpuMemory().total();
            mostGpuBytes = std::max(mostGpuBytes, gpuBytes);
            // Both ways of drawing colours have been seen by then.
            const bool early = phase < phases / 2;
            if (early) mostGpuBytesEarly = mostGpuBytes;
            if (!endsPhase || phase % (phases / 2) < 3) continue;
            lower(early ? holdingEarly : holdingLate);
            if (clipmap) (early ? objectsEarly : objectsLate) = countObjects();
        }
        EXPECT_TRUE(scene->renderer.drawsTiles(planet::BlockKind::Colours));
        EXPECT_TRUE(scene->renderer.drawsTiles(planet::BlockKind::Normals));
    }
    const ObjectCounts after = countObjects();
    const Holding atEnd;
    std::cout << frames << " frames, each " << drawnEvery << "th drawn: " << paging.loaded()
              << " blocks loaded, " << paging.dropped() << " dropped, " << paging.loadedSoonAgain()
              << " soon loaded again\nGPU bytes at most " << mostGpuBytesEarly << " in the first half, "
              << mostGpuBytes << " in all\nobjects: " << countsText(objectsEarly) << "; later "
              << countsText(objectsLate) << "; closed " << countsText(after) << "; before "
              << countsText(before) << "\nresident bytes " << holdingEarly->residentBytes << " then "
              << holdingLate->residentBytes << ", heap " << holdingEarly->heapBytes << " then "
              << holdingLate->heapBytes << ", files " << atStart.files << " then " << atEnd.files << "\n";
    EXPECT_EQ(mostGpuBytes, mostGpuBytesEarly);
    EXPECT_GT(objectsEarly.total(), before.total() + 20);
    // Programs are made when a variant is first drawn with, and kept.
    EXPECT_LE(objectsLate.programs, objectsEarly.programs + 2);
    objectsLate.programs = objectsEarly.programs;
    EXPECT_EQ(countsText(objectsLate), countsText(objectsEarly));
    EXPECT_EQ(countsText(after), countsText(before));
    EXPECT_EQ(atEnd.files, atStart.files);
    EXPECT_EQ(holdingLate->files, holdingEarly->files);
    EXPECT_GT(paging.loaded(), tests::sanitized ? 5u : 20u);
    if (!tests::sanitized) {
        EXPECT_GT(paging.dropped(), 20u);
    }
    // The heap is told of and not judged: a driver that draws with the CPU takes and gives back a hundred
    // megabytes as it goes. The flight that draws nothing and the files swapped in below keep an eye on that.
}

// As the window does: another file opened over and over, a bake kept beside it, the renderer's pools of
// another size.
TEST_F(LongFlightDrawn, SwappedFilesLeaveNothingBehind) {
    // The driver holds up to a twentieth more or less from one moment to the next, so the least of several late
    // counts is compared.
    const int swaps = std::getenv("WORLDY_FLIGHT_SECONDS") ? 50 : tests::sanitized ? 12 : 32;
    Session session = sessionOf(files_[1]);
    ObjectCounts warm;
    std::optional<Holding> warmHolding, laterHolding;  // the least
    std::size_t warmGpuBytes = 0;
    planet::test::RandomFlight flight(10, 6'371'000);
    for (int i = 0; i <= swaps; ++i) {
        const auto file = files_[static_cast<std::size_t>(i % 2)];
        // Every other time the one before stays beside it for a while.
        if (i % 4 < 2)
            ASSERT_TRUE(openFile(session, file, settings_, log_));
        else
            openBake(session, {}, file, settings_, log_);
        advanceSession(session, settings_, log_);
        ASSERT_EQ(shownPlanet(session)->data.chunkFile, file);
        Scene& scene = *shownScene(session);
        for (int frame = 0; frame < 2; ++frame, flight.step()) {
            settings_.surface.colourMode = frame % 2 == 0 ? ColourMode::Clipmap : ColourMode::Tiles;
            settings_.paging.budgetMB = frame == 0 ? 8 : 12;
            settings_.surface.exaggeration = frame == 0 ? 1 : 2;
            ASSERT_TRUE(applyLiveSettings(scene, settings_));
            stepScene(scene, flight.view(widthPx, heightPx), settings_, 0.1);
            draw(scene, flight.view(widthPx, heightPx));
        }
        settings_.paging.budgetMB = 8;
        dismissPreviousBake(session);
        if (i % 4 != 0) continue;
        lower(i <= 8 ? warmHolding : laterHolding);
        if (i == 4 || i == 8) {
            warm = countObjects();
            warmGpuBytes = scene.renderer.chunks().gpuMemory().total();
        }
        if (i <= 8) continue;
        EXPECT_EQ(countsText(countObjects()), countsText(warm)) << i;
        EXPECT_EQ(scene.renderer.chunks().gpuMemory().total(), warmGpuBytes) << i;
    }
    std::cout << swaps << " files swapped in: " << countsText(warm) << "; resident bytes "
              << warmHolding->residentBytes << " then " << laterHolding->residentBytes << ", heap "
              << warmHolding->heapBytes << " then " << laterHolding->heapBytes << ", files "
              << warmHolding->files << " then " << laterHolding->files << "\n";
    EXPECT_EQ(laterHolding->files, warmHolding->files);
    if (tests::sanitized) return;
    EXPECT_EQ(laterHolding->threads, warmHolding->threads);
    EXPECT_LE(laterHolding->heapBytes, warmHolding->heapBytes + warmHolding->heapBytes / 20);
}

}  // namespace
}  // namespace worldy
