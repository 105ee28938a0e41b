#include "app/measure/cracks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "app/base/stopwatch.h"

namespace worldy {

namespace {

using planet::Result;

planet::DrawnGround groundOf(const Scene& scene, std::span<const planet::DrawItem> items, bool stitched) {
    return {scene.planet->tree().shape, items, planet::heightsIn(scene.planet->tree()), stitched};
}

// Returns the number of leaking pixels for a skirt size. It never grows with the size.
using LeaksWith = std::function<Result<int>(double)>;

// Returns the smallest value >= from without a leak, to within 0.5 % or a step. The value limit must not
// leak. first is a guess.
Result<double> smallestWithoutLeak(const LeaksWith& leaksWith, double from, double first, double limit,
                                   double step) {
    const Result<int> atOnce = leaksWith(from);
    if (!atOnce) return tl::unexpected(atOnce.error());
    if (*atOnce == 0) return from;
    double low = from;
    double high = std::min(std::max(first, from) + step, limit);
    while (high < limit) {
        const Result<int> leaks = leaksWith(high);
        if (!leaks) return tl::unexpected(leaks.error());
        if (*leaks == 0) break;
        low = high;
        high = std::min(2 * high, limit);
    }
    while (high - low > std::max(step, 0.005 * high)) {
        const double middle = (low + high) / 2;
        const Result<int> leaks = leaksWith(middle);
        if (!leaks) return tl::unexpected(leaks.error());
        (*leaks == 0 ? high : low) = middle;
    }
    return high;
}

constexpr double largestFactor = 1000;

// Tries skirts in one view.
struct Trial {
    Scene& scene;
    const planet::View& view;
    std::vector<planet::DrawItem> items;
    planet::gl::CrackMap map;

    Result<int> leaks() {
        const planet::DrawnGround ground = groundOf(scene, items, false);
        if (Result<void> found = planet::gl::findLeaks(scene.renderer.chunks(), view, ground, map); !found)
            return tl::unexpected(found.error());
        return map.leaking;
    }
    Result<int> leaksOfDepth(double depthM) {
        for (planet::DrawItem& item : items) item.skirtDepthM = static_cast<float>(depthM);
        return leaks();
    }
    Result<int> leaksOfFactor(std::span<const planet::DrawnPair> pairs, double factor) {
        const std::vector<float> depths = planet::automaticSkirtDepthsM(
            scene.planet->tree(), scene.planet->views()[0].input.lod.metric, items, pairs, factor);
        for (std::size_t i = 0; i < items.size(); ++i) items[i].skirtDepthM = depths[i];
        return leaks();
    }
};

}  // namespace

Result<CrackMeasurement> measureCracks(Scene& scene, const planet::View& view, const ViewSettings& settings) {
    const Stopwatch watch;
    const planet::Selection& selection = scene.planet->selection();
    const planet::ChunkTree& tree = scene.planet->tree();
    CrackMeasurement made;
    made.view = view;
    made.lodView = scene.planet->views()[0].input.lodView;
    made.seams = settings.lod.seams;
    made.pairs = planet::drawnPairs(selection.draw);
    for (const planet::DrawItem& item : selection.draw) made.items.push_back(item.id);
    made.levelPairs = selection.seams.size();
    const planet::DrawnGround ground =
        groundOf(scene, selection.draw, made.seams == planet::SeamMode::Stitched);
    Result<planet::gl::CrackMap> map = planet::gl::measureCracks(
        scene.renderer.chunks(), view, ground, made.pairs, planet::gl::innerShellDepthM(tree));
    if (!map) return tl::unexpected(map.error());
    made.map = std::move(*map);
    made.spots = planet::crackSpots(made.map.pixels, made.map.widthPx, made.map.heightPx);
    made.gaps = planet::edgeGaps(ground, made.pairs, view);
    made.required = planet::requiredSkirts(tree, scene.planet->views()[0].input.lod.metric, selection.draw,
                                           made.pairs, made.gaps);
    const auto none = std::find_if(made.gaps.begin(), made.gaps.end(),
                                   [](const planet::EdgeGap& gap) { return gap.gapM == 0; });
    made.gaps.erase(none, made.gaps.end());
    made.tookMs = watch.elapsedMs();
    return made;
}

Result<SmallestSkirts> smallestSkirts(Scene& scene, const planet::View& view,
                                      const CrackMeasurement& measured, const SmallestSkirts& atLeast) {
    const planet::Selection& selection = scene.planet->selection();
    Trial trial{scene, view, selection.draw, {}};
    const double shellM = planet::gl::innerShellDepthM(scene.planet->tree());
    Result<planet::gl::CrackMap> map = planet::gl::findCracks(
        scene.renderer.chunks(), view, groundOf(scene, trial.items, false), measured.pairs, shellM);
    if (!map) return tl::unexpected(map.error());
    trial.map = std::move(*map);
    const Result<double> depthM = smallestWithoutLeak([&](double depth) { return trial.leaksOfDepth(depth); },
                                                      atLeast.depthM, measured.required.depthM, shellM, 0.01);
    if (!depthM) return tl::unexpected(depthM.error());
    if (std::isinf(atLeast.factor)) return SmallestSkirts{*depthM, atLeast.factor};
    const auto leaksOfFactor = [&](double factor) { return trial.leaksOfFactor(measured.pairs, factor); };
    const Result<int> atMost = leaksOfFactor(largestFactor);
    if (!atMost) return tl::unexpected(atMost.error());
    if (*atMost > 0) return SmallestSkirts{*depthM, std::numeric_limits<double>::infinity()};
    const double first = std::isfinite(measured.required.factor) ? measured.required.factor : 1;
    const Result<double> factor =
        smallestWithoutLeak(leaksOfFactor, atLeast.factor, first, largestFactor, 0.001);
    if (!factor) return tl::unexpected(factor.error());
    return SmallestSkirts{*depthM, *factor};
}

Result<void> measureNow(CrackInstrument& instrument, Scene& scene, const planet::View& view,
                        const ViewSettings& settings) {
    Result<CrackMeasurement> measured = measureCracks(scene, view, settings);
    if (!measured) return tl::unexpected(measured.error());
    instrument.measured = std::move(*measured);
    instrument.drawn = scene.planet->selection().draw;
    instrument.smallest.reset();
    return {};
}

bool isCurrent(const CrackInstrument& instrument, const Scene& scene, const planet::View& view,
               const ViewSettings& settings) {
    if (!instrument.measured || settings.overlay.cube || instrument.measured->view != view) return false;
    const auto sameItem = [](const planet::DrawItem& a, const planet::DrawItem& b) {
        return a.id == b.id && a.skirtDepthM == b.skirtDepthM && a.morph == b.morph;
    };
    const std::vector<planet::DrawItem>& drawn = scene.planet->selection().draw;
    return instrument.measured->seams == settings.lod.seams &&
           std::equal(instrument.drawn.begin(), instrument.drawn.end(), drawn.begin(), drawn.end(), sameItem);
}

Result<void> findSmallestNow(CrackInstrument& instrument, Scene& scene, const planet::View& view,
                             const ViewSettings& settings) {
    if (!isCurrent(instrument, scene, view, settings)) return {};
    if (instrument.measured->seams == planet::SeamMode::Stitched) return {};
    Result<SmallestSkirts> smallest = smallestSkirts(scene, view, *instrument.measured);
    if (!smallest) return tl::unexpected(smallest.error());
    instrument.smallest = *smallest;
    return {};
}

void markCracks(const planet::gl::CrackMap& map, Picture& picture) {
    using Colour = std::array<std::uint8_t, 3>;
    constexpr Colour leaking = {255, 0, 60};
    constexpr Colour hidden = {255, 220, 0};
    const auto at = [&](int x, int y) {
        return picture.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * picture.width + x);
    };
    // Each pixel of the rim is darkened only once.
    std::vector<std::uint8_t> rim(map.pixels.empty() ? 0 : picture.rgb.size() / 3, 0);
    for (const planet::CrackPixel& pixel : map.pixels) {
        for (int y = std::max(pixel.y - 1, 0); y <= std::min(pixel.y + 1, picture.height - 1); ++y) {
            for (int x = std::max(pixel.x - 1, 0); x <= std::min(pixel.x + 1, picture.width - 1); ++x) {
                std::uint8_t& done =
                    rim[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                        static_cast<std::size_t>(x)];
                if (std::exchange(done, std::uint8_t{1}) != 0) continue;
                for (auto channel = at(x, y); channel != at(x, y) + 3; ++channel)
                    *channel = static_cast<std::uint8_t>(*channel / 3);
            }
        }
    }
    for (const planet::CrackPixel& pixel : map.pixels)
        std::copy_n((pixel.leaks ? leaking : hidden).begin(), 3, at(pixel.x, pixel.y));
}

}  // namespace worldy
