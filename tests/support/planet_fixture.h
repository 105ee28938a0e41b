// Planets made of the fake pyramid, for tests of the facade: views of them, and sources that wait or fail.
#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "planet/planet.h"
#include "planet/planet_tools.h"
#include "tests/support/fake_selection.h"
#include "tests/support/gate.h"
#include "tests/support/sudden_lod.h"

namespace planet {

inline constexpr double timeoutS = 60;  // longer than any machine takes

inline std::size_t bytesOf(std::size_t chunks) {
    const PlanetShape& shape = fakePyramid().shape;
    return chunks * (chunkBytesCpu(shape) + chunkBytesGpu(shape));
}

// With a failure that is final: what is tried again is in planet_retry_test.cpp.
inline std::unique_ptr<Planet> openFake(PlanetSource source = fakePyramid().source(),
                                        std::size_t budgetChunks = 100'000, int loaderThreads = 1) {
    PagingSettings settings;
    settings.budgetBytes = bytesOf(budgetChunks);
    settings.loaderThreads = loaderThreads;
    settings.retry.retries = 0;
    return Planet::open(std::move(source), settings).value();
}

inline View viewAt(double latitudeDeg, double longitudeDeg, double altitudeM = 8000, double pitchDeg = -60) {
    CameraPose pose;
    pose.latitudeDeg = latitudeDeg;
    pose.longitudeDeg = longitudeDeg;
    pose.altitudeM = altitudeM;
    pose.pitchDeg = pitchDeg;
    return viewFromPose(pose, fakePyramid().shape.radiusM, 1.1, 1280, 720);
}

inline LodSettings fineSettings() {
    LodSettings settings = suddenLod();
    settings.tauPx = 0.5;
    return settings;
}

inline std::vector<ChunkId> drawn(const Planet& planet) {
    std::vector<ChunkId> ids;
    for (const DrawItem& item : planet.selection().draw) ids.push_back(item.id);
    std::sort(ids.begin(), ids.end());
    return ids;
}

// What would be drawn if everything were resident.
inline std::vector<ChunkId> drawnOfWhole(const View& view, const LodSettings& settings) {
    const auto ids = drawnIds(select(wholeTree(), view, settings));
    std::vector<ChunkId> sorted(ids.begin(), ids.end());
    std::sort(sorted.begin(), sorted.end());
    return sorted;
}

// A source whose loads wait at a gate, and that notes what it was asked for.
struct Gated {
    Gate gate;
    std::mutex mutex;
    std::vector<ChunkId> asked;

    PlanetSource source() {
        PlanetSource source = fakePyramid().source();
        source.loadChildren = [this](const ChunkId& parent, BlockLocation location, StepsView heights) {
            {
                const std::lock_guard lock(mutex);
                asked.push_back(parent);
            }
            gate.pass();
            return fakePyramid().load(parent, location, heights);
        };
        return source;
    }
};

// A source that fails for some blocks, for as long as it is told to.
struct Faulty {
    std::atomic<bool> broken = true;
    std::atomic<int> failures = 0;

    static bool affects(const ChunkId& parent) { return parent.level == 1 && parent.x == 1; }

    PlanetSource source() {
        PlanetSource source = fakePyramid().source();
        source.loadChildren = [this](const ChunkId& parent, BlockLocation location,
                                     StepsView heights) -> Result<SiblingBlock> {
            if (broken && affects(parent)) {
                ++failures;
                return ioError("children of " + toString(parent) + ": the disk is bad");
            }
            return fakePyramid().load(parent, location, heights);
        };
        return source;
    }
};

inline std::unique_ptr<Planet> openPaused() {
    PagingSettings settings;
    settings.paused = true;
    return Planet::open(fakePyramid().source(), settings).value();
}

}  // namespace planet
