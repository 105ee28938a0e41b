#include "app/measure/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>

#include "app/base/stopwatch.h"
#include "app/flight/measure_flight.h"
#include "app/measure/cracks.h"
#include "app/measure/pops_flight.h"
#include "app/scene/scene_settings.h"
#include "app/settings/camera_text.h"
#include "planet/base/percentile.h"

namespace worldy {

namespace {

using planet::Result;

// Estimated shares of the total time: the sample frames and the pops of each side, and the frame times of
// both.
constexpr double momentsShare = 0.3;
constexpr double popsShare = 0.14;
constexpr double timesShare = 0.12;

constexpr int timedRounds = 5;

// Reports the progress of a part of a comparison.
struct PartWatch {
    const ComparisonWatch& whole;
    double from = 0;
    double size = 1;

    bool operator()(double share) const { return whole(from + size * share); }
};

ComparedFigures figuresOf(const FlightFigures& flown) {
    ComparedFigures figures;
    figures.groundTriangles = flown.meanGroundTriangles;
    figures.skirtTriangles = flown.meanSkirtTriangles;
    figures.triangles = flown.meanTriangles;
    figures.chunks = flown.meanChunks;
    figures.residentBytes = flown.mostResidentMiB * (1 << 20);
    figures.bytesRead = static_cast<double>(flown.bytesRead);
    figures.worstEpsPx = flown.worstEpsPx;
    figures.worstDrawnBoundPx = flown.worstDrawnBoundPx;
    figures.worstErrorPx = flown.worstMeasuredPx;
    figures.p99ErrorPx = flown.p99MeasuredPx;
    figures.violations = static_cast<double>(flown.violations);
    return figures;
}

FlightFrames momentsOf(const ComparisonPlan& plan) {
    return framesOf(plan.path, plan.moments, plan.momentStepS);
}

struct MeasuredMoments {
    ComparedFigures figures;
    bool software = false;  // the CPU draws
};

Result<MeasuredMoments> measureMoments(const ComparedSide& side, const ComparisonPlan& plan,
                                       const PartWatch& goOn) {
    Result<Offscreen> offscreen = openOffscreen({.chunkFile = side.chunkFile}, side.settings, plan.size, 1);
    if (!offscreen) return tl::unexpected(offscreen.error());
    planet::FinestHeights heights(std::make_shared<const planet::ChunkFile>(offscreen->scene.planet->file()));
    double cracks = 0;
    double leaking = 0;
    int done = 0;
    const auto measureMoment = [&](Offscreen& at, const SettledView& settled) -> Result<void> {
        const Result<CrackMeasurement> measured = measureCracks(at.scene, settled.view, side.settings);
        if (!measured) return tl::unexpected(measured.error());
        cracks += static_cast<double>(measured->map.pixels.size());
        leaking += measured->map.leaking;
        ++done;
        return {};
    };
    const Result<FlightFigures> flown = measureFlight(
        *offscreen, plan.path, side.settings, momentsOf(plan), FigureSet::CostAndError, heights,
        [&](int) { return goOn(static_cast<double>(done) / plan.moments); }, measureMoment);
    if (!flown) return tl::unexpected(flown.error());
    MeasuredMoments measured{figuresOf(*flown), offscreen->scene.renderer.chunks().capabilities().software};
    measured.figures.crackPx = cracks;
    measured.figures.leakingPx = leaking;
    return measured;
}

Result<void> addPops(const ComparedSide& side, const ComparisonPlan& plan, bool software,
                     const PartWatch& goOn, ComparedFigures& figures) {
    auto planet = planet::Planet::open(side.chunkFile, pagingSettingsOf(side.settings));
    if (!planet) return tl::unexpected(planet.error());
    (*planet)->setExaggeration(side.settings.surface.exaggeration);
    if (const auto set = (*planet)->setRegions(side.settings.regions.applied()); !set)
        return tl::unexpected(set.error());
    const Result<PopsFlight> flown =
        flyForPops(**planet, plan.path, side.settings, plan.size, plan.popStepS, software, goOn);
    if (!flown) return tl::unexpected(flown.error());
    figures.switches = static_cast<double>(flown->totals.switches);
    figures.worstPopPx = flown->totals.worstPx;
    figures.p99PopPx = planet::percentileOf(jumpsOf(*flown), 0.99);
    figures.late = static_cast<double>(flown->totals.late);
    return {};
}

// Returns a side without the tint that measures the true error for each picture.
ComparedSide timedSide(const ComparisonPlan& plan, std::size_t index) {
    ComparedSide side = flownSide(plan, index);
    // Nothing is measured or read for these tints here.
    constexpr std::array unknown = {ColourBy::Measured, ColourBy::LeafDepth, ColourBy::Spacing,
                                    ColourBy::Source, ColourBy::Atlas};
    if (std::ranges::find(unknown, side.settings.overlay.colourBy) != unknown.end())
        side.settings.overlay.colourBy = ColourBy::None;
    return side;
}

Result<double> radiusOf(const std::filesystem::path& chunkFile) {
    return planet::ChunkFile::open(chunkFile).map(
        [](const planet::ChunkFile& file) { return file.info().shape.radiusM; });
}

Result<void> checkFiles(const ComparisonPlan& plan) {
    std::array<double, 2> radii{};
    for (std::size_t i = 0; i < 2; ++i) {
        const Result<double> radiusM = radiusOf(plan.sides[i].chunkFile);
        if (!radiusM) return tl::unexpected(radiusM.error());
        radii[i] = *radiusM;
    }
    return checkSameRadius(radii[0], radii[1]);
}

struct ByteDifference {
    std::uint64_t pixels = 0;
    int largestSteps = 0;
};

ByteDifference countDifferent(const Picture& a, const Picture& b) {
    ByteDifference difference;
    for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
        int largest = 0;
        for (std::size_t channel = i; channel < i + 3; ++channel)
            largest = std::max(largest, std::abs(a.rgb[channel] - b.rgb[channel]));
        difference.pixels += largest > 1 ? 1 : 0;
        difference.largestSteps = std::max(difference.largestSteps, largest);
    }
    return difference;
}

// Two scenes in one context. offscreen.scene is A's; withB exchanges it with B's during a call.
struct BothScenes {
    Offscreen offscreen;
    Scene other;

    template <class Use>
    auto withB(const Use& use) {
        std::swap(offscreen.scene, other);
        auto result = use();
        std::swap(offscreen.scene, other);
        return result;
    }
};

Result<BothScenes> openBoth(const ComparedSide& a, const ComparedSide& b, const PictureSize& size) {
    Result<Offscreen> offscreen = openOffscreen({.chunkFile = a.chunkFile}, a.settings, size, 1);
    if (!offscreen) return tl::unexpected(offscreen.error());
    Result<Scene> other = openScene({.chunkFile = b.chunkFile}, b.settings);
    if (!other) return tl::unexpected(other.error());
    return BothScenes{std::move(*offscreen), std::move(*other)};
}

Result<double> frameMs(Offscreen& offscreen, const planet::View& view, const ViewSettings& settings) {
    const Stopwatch watch;
    stepScene(offscreen.scene, view, settings);
    return drawAndFinish(offscreen, view, settings).map([&] { return watch.elapsedMs(); });
}

// Measures both sides in alternation, so that other load affects both. Takes the best of several rounds at
// each sample frame, and the median of those.
Result<std::array<double, 2>> measureFrameMs(const ComparisonPlan& plan, const PartWatch& goOn) {
    const ComparedSide a = timedSide(plan, 0);
    const ComparedSide b = timedSide(plan, 1);
    Result<BothScenes> both = openBoth(a, b, plan.size);
    if (!both) return tl::unexpected(both.error());
    const FlightFrames moments = momentsOf(plan);
    std::array<std::vector<double>, 2> bests;
    for (int i = 0; i < plan.moments; ++i) {
        if (!goOn(static_cast<double>(i) / plan.moments)) return planet::cancelled();
        const planet::CameraPose pose = poseAt(plan.path, moments.timeS(i));
        const planet::View viewA = settleAt(both->offscreen, pose, a.settings).view;
        const planet::View viewB =
            both->withB([&] { return settleAt(both->offscreen, pose, b.settings).view; });
        std::array<double, 2> best = {std::numeric_limits<double>::infinity(),
                                      std::numeric_limits<double>::infinity()};
        for (int round = 0; round < timedRounds; ++round) {
            const Result<double> ofA = frameMs(both->offscreen, viewA, a.settings);
            const Result<double> ofB =
                both->withB([&] { return frameMs(both->offscreen, viewB, b.settings); });
            if (!ofA) return tl::unexpected(ofA.error());
            if (!ofB) return tl::unexpected(ofB.error());
            best = {std::min(best[0], *ofA), std::min(best[1], *ofB)};
        }
        for (std::size_t side = 0; side < best.size(); ++side) bests[side].push_back(best[side]);
    }
    return std::array{planet::percentileOf(bests[0], 0.5), planet::percentileOf(bests[1], 0.5)};
}

Result<Picture> pictureAt(Offscreen& offscreen, const planet::CameraPose& pose,
                          const ViewSettings& settings) {
    const SettledView at = settleAt(offscreen, pose, settings);
    if (!at.settled) return loadingTimedOut();
    if (Result<void> drawn = drawAndFinish(offscreen, at.view, settings); !drawn)
        return tl::unexpected(drawn.error());
    return readPicture(offscreen);
}

}  // namespace

ComparedSide flownSide(const ComparisonPlan& plan, std::size_t index) {
    ComparedSide side = plan.sides[index];
    side.settings.camera = plan.sides[0].settings.camera;
    side.settings.paging.badDisk = {};
    side.settings.paging.simulated = false;
    side.settings.surface.light.fill = 0;
    return side;
}

Result<void> checkSameRadius(double radiusM, double radiusOfBM) {
    if (radiusM == radiusOfBM) return {};
    return planet::badInput(
        fmt::format("the radius of A is {:.10g} m and that of B {:.10g} m; expected equal radii, because one "
                    "camera shows both",
                    radiusM, radiusOfBM));
}

Result<ComparedPair> compareOverFlight(const ComparisonPlan& plan, const ComparisonWatch& goOn) {
    if (const Result<void> good = checkFiles(plan); !good) return tl::unexpected(good.error());
    ComparedPair pair;
    for (std::size_t i = 0; i < pair.size(); ++i) {
        const ComparedSide side = timedSide(plan, i);
        const double from = (momentsShare + popsShare) * static_cast<double>(i);
        Result<MeasuredMoments> moments = measureMoments(side, plan, {goOn, from, momentsShare});
        if (!moments) return tl::unexpected(moments.error());
        const PartWatch popsWatch{goOn, from + momentsShare, popsShare};
        if (const Result<void> added = addPops(side, plan, moments->software, popsWatch, moments->figures);
            !added)
            return tl::unexpected(added.error());
        pair[i] = moments->figures;
    }
    const Result<std::array<double, 2>> times =
        measureFrameMs(plan, {goOn, 2 * (momentsShare + popsShare), timesShare});
    if (!times) return tl::unexpected(times.error());
    for (std::size_t i = 0; i < pair.size(); ++i) pair[i].frameMs = (*times)[i];
    return pair;
}

Result<ComparedPictures> compareInPictures(const ComparisonPlan& plan, const ComparisonWatch& goOn) {
    if (const Result<void> good = checkFiles(plan); !good) return tl::unexpected(good.error());
    const ComparedSide a = flownSide(plan, 0);
    const ComparedSide b = flownSide(plan, 1);
    Result<BothScenes> both = openBoth(a, b, plan.size);
    if (!both) return tl::unexpected(both.error());
    const FlightFrames moments = momentsOf(plan);
    ComparedPictures worst;
    for (int i = 0; i < plan.moments; ++i) {
        if (!goOn(static_cast<double>(i) / plan.moments)) return planet::cancelled();
        const planet::CameraPose pose = poseAt(plan.path, moments.timeS(i));
        Result<Picture> pictureA = pictureAt(both->offscreen, pose, a.settings);
        Result<Picture> pictureB = both->withB([&] { return pictureAt(both->offscreen, pose, b.settings); });
        if (!pictureA) return tl::unexpected(pictureA.error());
        if (!pictureB) return tl::unexpected(pictureB.error());
        const ByteDifference difference = countDifferent(*pictureA, *pictureB);
        if (i > 0 && difference.pixels <= worst.pixels) continue;
        worst = {moments.timeS(i), std::move(*pictureA), std::move(*pictureB), difference.pixels,
                 difference.largestSteps};
    }
    return worst;
}

Picture besideEachOther(const Picture& a, const Picture& b) {
    Picture both{a.width + b.width, a.height, {}};
    const auto appendRow = [&](const Picture& picture, int row) {
        const auto length = 3 * static_cast<std::ptrdiff_t>(picture.width);
        const auto from = picture.rgb.begin() + row * length;
        both.rgb.insert(both.rgb.end(), from, from + length);
    };
    for (int row = 0; row < a.height; ++row) {
        appendRow(a, row);
        appendRow(b, row);
    }
    return both;
}

Picture differenceOf(const Picture& a, const Picture& b, double gain) {
    Picture difference{a.width, a.height, {}};
    difference.rgb.reserve(a.rgb.size());
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        const double apart = gain * std::abs(a.rgb[i] - b.rgb[i]);
        difference.rgb.push_back(static_cast<std::uint8_t>(std::lround(std::min(apart, 255.0))));
    }
    return difference;
}

}  // namespace worldy
