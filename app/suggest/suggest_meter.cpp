#include "app/suggest/suggest_meter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/scene/camera_control.h"
#include "app/scene/scene_settings.h"
#include "planet/base/percentile.h"
#include "planet/base/result.h"
#include "planet/base/try.h"
#include "planet/gl/draw/frame_uniforms.h"
#include "planet/measure/lod_changes.h"
#include "planet/measure/pop_meter.h"
#include "planet/planet_tools.h"
#include "planet/select/drawn_bound.h"
#include "planet/select/governor.h"
#include "planet/select/screen_error.h"
#include "planet/sphere/cube_sphere.h"
#include "planet/sphere/view.h"
#include "planet/tree/chunk_tree.h"

namespace worldy {

namespace {

using planet::Result;

constexpr std::size_t sampledFrames = 24;  // of each leg
constexpr std::size_t keptWorst = 5;       // of each limit
constexpr double apartDeg = 2;             // between places of these

constexpr std::size_t indexOf(SuggestLimit limit) {
    return static_cast<std::size_t>(limit);
}

// The values of the frames of one leg.
struct LegValues {
    std::array<std::vector<double>, suggestLimitCount> of;
    std::vector<planet::View> views;
    std::vector<std::size_t> frames;  // indices in the leg
};

// The measurement of one candidate.
struct Measuring {
    planet::Planet& planet;
    const ViewSettings settings;
    const std::optional<FrameCost>& cost;
    const std::function<bool(double)>& goOn;
    double lateChunks = 0, drawnChunks = 0;
    planet::PopTotals pops{};
    std::uint64_t thrashes = 0;
    std::size_t unsettled = 0;

    planet::View viewOfFrame(const SuggestFrame& frame) const {
        if (!frame.keepsClear) return frame.view;
        const double radiusM = planet.tree().shape.radiusM;
        const Ground ground{radiusM, planet::residentHeightM(planet.tree(), frame.view.eyeM)};
        const Camera camera = keepInRange({frame.view.eyeM, frame.view.right, frame.view.back}, ground);
        return viewOf(camera, frame.view.horizontalFovRad, frame.view.widthPx, frame.view.heightPx);
    }

    planet::ViewInput inputOf(const planet::View& view) const {
        return {view, lodSettingsOf(settings), 1, colourSettingsOf(settings), normalSettingsOf(settings)};
    }

    void dropTiles() const {
        for (const planet::BlockKind kind : {planet::BlockKind::Colours, planet::BlockKind::Normals})
            planet.takeTileChanges(kind);
    }

    // A view that was settled for, and whether it was loaded within suggestSettleS.
    struct Settled {
        planet::View view;
        bool isLoaded = false;
    };
    Settled settle(const SuggestFrame& frame) const {
        constexpr int mostLifts = 5;  // loaded ground may lift the camera, which then needs more blocks
        Settled settled{viewOfFrame(frame)};
        for (int i = 0; i < mostLifts; ++i) {
            const planet::ViewInput input = inputOf(settled.view);
            settled.isLoaded = planet.settle({&input, 1}, planet::noUpload, suggestSettleS);
            dropTiles();
            const planet::View lifted = viewOfFrame(frame);
            if (lifted == settled.view) break;
            settled.view = lifted;
        }
        return settled;
    }

    // Costs and error of a view that is not loaded would be those of coarser chunks than it wants.
    void addUnsettled(const planet::View& view, std::size_t frame, LegValues& values) {
        for (std::vector<double>& of : values.of) of.push_back(std::numeric_limits<double>::quiet_NaN());
        values.views.push_back(view);
        values.frames.push_back(frame);
        ++unsettled;
        const planet::SelectionCounters& counters = planet.selection().counters;
        lateChunks += counters.waiting;
        drawnChunks += counters.drawn;
    }

    void addFrame(const planet::View& view, bool isFlown, std::size_t frame, LegValues& values) {
        const planet::Selection& selection = planet.selection();
        const planet::SelectionCounters& counters = selection.counters;
        const planet::PlanetShape& shape = planet.tree().shape;
        const auto triangles = static_cast<double>(counters.triangles());
        const std::size_t chunkBytes = planet::chunkBytesCpu(shape) + planet::chunkBytesGpu(shape);
        auto bytes = static_cast<double>(planet::neededChunks(selection) * chunkBytes);
        // Chunks of earlier viewpoints are resident by chance.
        if (isFlown) {
            const planet::PagingCounters& paging = planet.paging();
            bytes = std::max(bytes, static_cast<double>(paging.residentBytesCpu + paging.residentBytesGpu));
        }
        const auto add = [&](SuggestLimit limit, double value) {
            values.of[indexOf(limit)].push_back(value);
        };
        add(SuggestLimit::FrameMs, cost ? cost->ms(triangles) : std::numeric_limits<double>::quiet_NaN());
        add(SuggestLimit::Triangles, triangles);
        add(SuggestLimit::ResidentBytes, bytes);
        add(SuggestLimit::ErrorPx, drawnErrorPx(planet.tree(), selection, view, lodSettingsOf(settings)));
        values.views.push_back(view);
        values.frames.push_back(frame);
        lateChunks += counters.waiting;
        drawnChunks += counters.drawn;
    }

    Result<void> settleEach(const SuggestLeg& leg, std::size_t stride,
                            const std::function<bool(std::size_t)>& step, LegValues& values) {
        for (std::size_t i = 0; i < leg.frames.size(); i += stride) {
            if (!step(i)) return planet::cancelled();
            planet.tools().forgetSelections();
            const Settled settled = settle(leg.frames[i]);
            if (settled.isLoaded)
                addFrame(settled.view, leg.isFlown, i, values);
            else
                addUnsettled(settled.view, i, values);
        }
        return {};
    }

    Result<void> fly(const SuggestLeg& leg, const std::function<bool(std::size_t)>& step, LegValues& values) {
        planet::PopMeter meter;
        planet::LodChanges changes;
        double timeS = 0;
        planet::View before{};
        bool beginsLoaded = true;
        std::optional<double> seaM;
        for (std::size_t i = 0; i < leg.frames.size(); ++i) {
            if (!step(i)) return planet::cancelled();
            const SuggestFrame& frame = leg.frames[i];
            if (i == 0) {
                const Settled settled = settle(frame);
                before = settled.view;
                beginsLoaded = settled.isLoaded;
                const planet::gl::RenderSettings render = renderSettingsOf(settings, before, planet.tree());
                // The sea is drawn as with a GPU, so that pops are the same on any machine.
                if (planet::gl::isSeaSurfaceDrawn(render, /*software=*/false)) seaM = render.seaLevelM;
            }
            const planet::View view = i == 0 ? before : viewOfFrame(frame);
            const planet::ViewInput input = inputOf(view);
            const double elapsedS = i == 0 ? 0 : frame.elapsedS;
            planet.step({&input, 1}, planet::noUpload, elapsedS);
            dropTiles();
            timeS += elapsedS;
            if (i == 0 && !beginsLoaded)
                addUnsettled(view, i, values);
            else
                addFrame(view, true, i, values);
            const bool jumped =
                i > 0 && planet::isCameraJump(before.eyeM, view.eyeM, planet.tree().shape.radiusM, elapsedS);
            meter.add(planet.tree(), planet.selection(), view, input.lod, timeS,
                      {.cameraJumped = jumped, .seaM = seaM});
            changes.add(planet.selection(), timeS);
            before = view;
        }
        pops.counted += meter.totals().counted;
        pops.worstPx = std::max(pops.worstPx, meter.totals().worstPx);
        thrashes += changes.thrashTotal();
        return {};
    }
};

double angleDeg(const planet::View& a, const planet::View& b) {
    return glm::degrees(
        std::acos(std::clamp(glm::dot(glm::normalize(a.eyeM), glm::normalize(b.eyeM)), -1.0, 1.0)));
}

// Returns the frames with the largest values of a limit, of places apart from each other.
std::vector<SuggestWorst> worstOf(const std::vector<LegValues>& legs, SuggestLimit limit) {
    std::vector<SuggestWorst> all;
    for (std::size_t leg = 0; leg < legs.size(); ++leg) {
        const std::vector<double>& values = legs[leg].of[indexOf(limit)];
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (!std::isnan(values[i]))
                all.push_back({leg, legs[leg].frames[i], legs[leg].views[i], values[i]});
        }
    }
    std::ranges::stable_sort(all, [](const auto& a, const auto& b) { return a.value > b.value; });
    std::vector<SuggestWorst> worst;
    for (const SuggestWorst& one : all) {
        if (worst.size() == keptWorst) break;
        const bool isNear = std::ranges::any_of(worst, [&](const SuggestWorst& other) {
            const double altitudes = glm::length(one.view.eyeM) / glm::length(other.view.eyeM);
            return angleDeg(one.view, other.view) < apartDeg && std::abs(altitudes - 1) < 0.1;
        });
        if (!isNear) worst.push_back(one);
    }
    return worst;
}

SuggestMeasured gathered(const std::vector<SuggestLeg>& legs, const std::vector<LegValues>& values,
                         const Measuring& measured, SuggestScope scope) {
    SuggestMeasured result;
    SuggestFigures& figures = result.figures;
    std::vector<double> errors;
    for (std::size_t leg = 0; leg < legs.size(); ++leg) {
        const double share = legs[leg].isFlown && scope == SuggestScope::Whole ? suggestShare : 1;
        SuggestValues worst{};
        for (const SuggestLimit limit : suggestLimits) {
            std::vector<double> of = values[leg].of[indexOf(limit)];
            const bool isKnown = std::ranges::none_of(of, [](double value) { return std::isnan(value); });
            worst[indexOf(limit)] =
                isKnown ? planet::percentileOf(of, share) : std::numeric_limits<double>::quiet_NaN();
        }
        for (std::size_t i = 0; i < suggestLimitCount; ++i) {
            double& most = figures.values[i];
            most = std::isnan(most) || std::isnan(worst[i]) ? std::numeric_limits<double>::quiet_NaN()
                                                            : std::max(most, worst[i]);
        }
        result.byLeg.push_back(worst);
        const std::vector<double>& of = values[leg].of[indexOf(SuggestLimit::ErrorPx)];
        figures.frames += of.size();
        std::ranges::copy_if(of, std::back_inserter(errors), [](double error) { return !std::isnan(error); });
    }
    figures.unsettled = measured.unsettled;
    figures.p99ErrorPx =
        errors.empty() ? std::numeric_limits<double>::quiet_NaN() : planet::percentileOf(errors, 0.99);
    // A frame whose bound is useless, because the eye lies within a chunk's bounds, would hide all others.
    double sum = 0;
    for (const double error : errors) sum += std::min(error, figures.p99ErrorPx);
    figures.meanErrorPx = sum / static_cast<double>(errors.size());
    figures.worstPopPx = measured.pops.worstPx;
    figures.pops = measured.pops.counted;
    figures.thrashes = measured.thrashes;
    figures.lateShare = measured.drawnChunks > 0 ? measured.lateChunks / measured.drawnChunks : 0;
    if (scope == SuggestScope::Whole) {
        for (const SuggestLimit limit : suggestLimits) result.worst[indexOf(limit)] = worstOf(values, limit);
    }
    return result;
}

}  // namespace

Result<SuggestLeg> legOf(const FlightPath& path, double stepS, double radiusM, double fovDeg,
                         const PictureSize& size) {
    TRY_ASSIGN(const int count, flightViews(path, stepS, mostFlightViews));
    SuggestLeg leg{.name = path.name, .isFlown = true, .frames = {}};
    for (int i = 0; i < count; ++i) {
        const planet::CameraPose pose = poseAt(path, path.keys.front().timeS + i * stepS);
        leg.frames.push_back(
            {planet::viewFromPose(pose, radiusM, glm::radians(fovDeg), size.widthPx, size.heightPx), true,
             stepS});
    }
    return leg;
}

SuggestLeg legOf(const FlightRecord& record) {
    SuggestLeg leg{.name = record.name, .isFlown = true, .isRecorded = true, .frames = {}};
    for (const FlightFrame& frame : record.frames)
        leg.frames.push_back({frame.views[0].view, false, frame.elapsedS});
    return leg;
}

SuggestLeg legOf(const planet::Atlas& atlas) {
    SuggestLeg leg{.name = fmt::format("{} viewpoints of the whole planet", atlas.viewpoints.size()),
                   .isFlown = false,
                   .frames = {}};
    const planet::AtlasSurvey& survey = atlas.survey;
    for (const planet::AtlasViewpoint& viewpoint : atlas.viewpoints) {
        const planet::CameraPose pose = planet::poseOf(survey, viewpoint);
        leg.frames.push_back({planet::viewFromPose(pose, survey.radiusM, glm::radians(survey.fovDeg),
                                                   survey.widthPx, survey.heightPx),
                              false, 0});
    }
    return leg;
}

RegionSettings regionsWith(const RegionSettings& now, const std::vector<planet::Region>& more) {
    if (more.empty()) return now;
    RegionSettings all = now;
    std::vector<planet::Region> list = now.all();
    for (planet::Region& region : list) region.on &= now.on;
    list.insert(list.end(), more.begin(), more.end());
    all.list = std::make_shared<const std::vector<planet::Region>>(std::move(list));
    all.on = true;
    return all;
}

ViewSettings settingsWith(const ViewSettings& now, const SuggestCandidate& candidate) {
    ViewSettings settings = now;
    settings.lod.tauPx = candidate.tauPx;
    settings.lod.metric = candidate.metric;
    settings.lod.morphRange = candidate.morphRange;
    settings.paging.budgetMB = candidate.memoryMiB;
    settings.regions = regionsWith(now.regions, candidate.regions);
    // The governor would move τ.
    settings.budget.cpuMs = settings.budget.gpuMs = settings.budget.readMBs = 0;
    settings.budget.triangles = settings.budget.memoryMB = 0;
    return settings;
}

SuggestCandidate candidateOf(const ViewSettings& now) {
    return {.tauPx = now.lod.tauPx,
            .metric = now.lod.metric,
            .morphRange = now.lod.morphRange,
            .memoryMiB = now.paging.budgetMB};
}

double drawnErrorPx(const planet::ChunkTree& tree, const planet::Selection& selection,
                    const planet::View& view, const planet::LodSettings& lod) {
    const double scalePx = planet::screenScalePx(view);
    std::vector<planet::DrawItem> items = selection.draw;
    std::vector<double> spansM;
    spansM.reserve(items.size());
    for (planet::DrawItem& item : items) {
        const planet::ChunkNode& node = tree.nodes[item.node];
        spansM.push_back(planet::cellSpanM(tree.shape, node));
        item.deltaCM = node.deltaTightM;
        item.epsPx =
            static_cast<float>(planet::epsPxOf(node, view.eyeM, scalePx, planet::ErrorMetric::Tight));
        if (node.parent == planet::noNode) continue;
        const planet::ChunkNode& parent = tree.nodes[node.parent];
        item.parentDeltaM = parent.deltaTightM;
        item.parentEpsPx =
            static_cast<float>(planet::epsPxOf(parent, view.eyeM, scalePx, planet::ErrorMetric::Tight));
    }
    if (lod.morph) {
        planet::fillDrawnBounds(items, spansM, scalePx, planet::ErrorMetric::Tight,
                                lod.seams == planet::SeamMode::Stitched);
    }
    float most = 0;
    for (const planet::DrawItem& item : items)
        most = std::max(most, lod.morph ? item.drawnBoundPx : item.epsPx);
    return static_cast<double>(most);
}

SuggestMeter::SuggestMeter(std::unique_ptr<planet::Planet> planet, ViewSettings now,
                           std::vector<SuggestLeg> legs, std::optional<FrameCost> cost)
    : planet_(std::move(planet)), now_(std::move(now)), legs_(std::move(legs)), cost_(std::move(cost)) {}

Result<void> SuggestMeter::apply(const ViewSettings& settings) {
    planet_->tools().reset();
    planet_->setExaggeration(settings.surface.exaggeration);
    TRY(planet_->setRegions(settings.regions.applied()));
    TRY(planet_->setPaging(pagingSettingsOf(settings, false, planet::PagingTime::Simulated)));
    return {};
}

Result<std::vector<SuggestGround>> SuggestMeter::groundIn(const SuggestCandidate& candidate,
                                                          const planet::View& view) {
    const std::function<bool(double)> always = [](double) { return true; };
    const Measuring measuring{*planet_, settingsWith(now_, candidate), cost_, always};
    TRY(apply(measuring.settings));
    if (!measuring.settle({view, false, 0}).isLoaded) {
        return planet::badInput(
            fmt::format("the view was not loaded within {:g} s of the simulated disk; expected a faster one",
                        suggestSettleS));
    }
    const planet::ChunkTree& tree = planet_->tree();
    std::vector<SuggestGround> all;
    for (const planet::DrawItem& item : planet_->selection().draw) {
        const planet::ChunkNode& node = tree.nodes[item.node];
        const planet::FaceSquare square = planet::faceSquareOf(item.id);
        const auto at = [&](double u, double v) {
            return planet::sphereFromCube(
                planet::cubePoint(item.id.face, square.u + u * square.side, square.v + v * square.side));
        };
        SuggestGround ground{at(0.5, 0.5)};
        ground.angleRad = std::acos(std::clamp(glm::dot(ground.direction, at(0, 0)), -1.0, 1.0));
        ground.heightM = (static_cast<double>(node.minHeightM) + static_cast<double>(node.maxHeightM)) / 2 /
                         tree.exaggeration;
        all.push_back(ground);
    }
    return all;
}

Result<SuggestMeasured> SuggestMeter::measure(const SuggestCandidate& candidate, SuggestScope scope,
                                              const std::function<bool(double)>& goOn) {
    Measuring measuring{*planet_, settingsWith(now_, candidate), cost_, goOn};
    TRY(apply(measuring.settings));
    std::size_t total = 0, done = 0;
    const auto strideOf = [&](const SuggestLeg& leg) {
        return scope == SuggestScope::Sample ? std::max<std::size_t>(leg.frames.size() / sampledFrames, 1)
                                             : std::size_t{1};
    };
    for (const SuggestLeg& leg : legs_) total += leg.frames.size();
    std::vector<LegValues> values(legs_.size());
    for (std::size_t i = 0; i < legs_.size(); ++i) {
        const SuggestLeg& leg = legs_[i];
        const auto step = [&](std::size_t frame) {
            return goOn(static_cast<double>(done + frame) / static_cast<double>(total));
        };
        const bool flies = leg.isFlown && scope == SuggestScope::Whole;
        TRY(flies ? measuring.fly(leg, step, values[i])
                  : measuring.settleEach(leg, strideOf(leg), step, values[i]));
        done += leg.frames.size();
    }
    return gathered(legs_, values, measuring, scope);
}

}  // namespace worldy
