#include "planet/measure/atlas_viewpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>

#include "planet/base/result.h"
#include "planet/base/stopwatch.h"
#include "planet/base/try.h"
#include "planet/measure/atlas.h"
#include "planet/measure/ground_profile.h"
#include "planet/measure/lod_changes.h"
#include "planet/measure/pop_meter.h"
#include "planet/measure/true_error.h"
#include "planet/paging/finest_heights.h"
#include "planet/paging/paging_types.h"
#include "planet/planet.h"
#include "planet/planet_tools.h"
#include "planet/planet_types.h"
#include "planet/select/lod_types.h"
#include "planet/sphere/view.h"

namespace planet {

namespace {

constexpr double moveFrameS = 1.0 / 30;
constexpr int moveFramesAhead = 15;

// Returns the view after a rotation of eye and axes about the planet's centre that moves the eye ahead over the ground.
View movedAhead(const View& view, double angleRad) {
    const glm::dvec3 axis = -view.right;
    const auto turned = [&](const glm::dvec3& v) {  // Rodrigues' formula
        return v * std::cos(angleRad) + glm::cross(axis, v) * std::sin(angleRad) +
               axis * glm::dot(axis, v) * (1 - std::cos(angleRad));
    };
    View moved = view;
    moved.eyeM = turned(view.eyeM);
    moved.up = turned(view.up);
    moved.back = turned(view.back);
    return moved;
}

void setFigure(AtlasFigures& figures, AtlasMeasure measure, double value) {
    figures[static_cast<std::size_t>(measure)] = value;
}

}  // namespace

AtlasCosts& AtlasCosts::operator+=(const AtlasCosts& other) {
    groundS += other.groundS;
    settleS += other.settleS;
    errorS += other.errorS;
    moveS += other.moveS;
    return *this;
}

AtlasMeter::AtlasMeter(Planet& planet, FinestHeights& heights, const AtlasSurvey& survey,
                       const AtlasSettings& settings)
    : planet_(planet),
      heights_(heights),
      survey_(survey),
      settings_(settings),
      ground_(profileGroundOf(planet.tree(), {}, View{}, false)) {}

Result<AtlasViewpoint> AtlasMeter::measure(const AtlasPlace& place, std::optional<double> eyeM,
                                           const std::function<bool()>& goOn) {
    if (!goOn()) return cancelled();
    AtlasViewpoint viewpoint{.place = place};
    viewpoint.figures.fill(std::numeric_limits<double>::quiet_NaN());
    if (!eyeM) {
        TRY_ASSIGN(eyeM, eyeOver(place));
    }
    viewpoint.eyeM = *eyeM;
    const View view = viewOf(viewpoint);
    TRY(measureStill(view, viewpoint.figures, goOn));
    TRY(measureMove(view, survey_.grid.altitudesM[place.altitude], viewpoint.figures, goOn));
    return viewpoint;
}

Result<double> AtlasMeter::eyeOver(const AtlasPlace& place) {
    const Stopwatch watch;
    const glm::dvec3 direction = middleOf(place.cell);
    TRY_ASSIGN(const GroundProfile profile, groundProfile(ground_, heights_, direction, direction, 2));
    costs_.groundS += watch.elapsedS();
    const double groundM = profile.points.front().finestM;
    return std::max(groundM, settings_.seaM.value_or(groundM)) + survey_.grid.altitudesM[place.altitude];
}

View AtlasMeter::viewOf(const AtlasViewpoint& viewpoint) const {
    return viewFromPose(poseOf(survey_, viewpoint), survey_.radiusM, glm::radians(survey_.fovDeg),
                        survey_.widthPx, survey_.heightPx);
}

void AtlasMeter::step(const View& view, double elapsedS) {
    ViewInput input = settings_.input;
    input.lodView = view;
    planet_.step({&input, 1}, noUpload, elapsedS);
    for (const BlockKind kind : {BlockKind::Colours, BlockKind::Normals}) planet_.takeTileChanges(kind);
}

Result<void> AtlasMeter::measureStill(const View& view, AtlasFigures& figures,
                                      const std::function<bool()>& goOn) {
    Stopwatch watch;
    planet_.tools().reset();
    ViewInput input = settings_.input;
    input.lodView = view;
    const std::uint64_t bytesBefore = planet_.paging().bytesRead();
    // A single call would not return soon enough after goOn has returned false.
    constexpr int slices = 16;
    bool isSharp = false;
    for (int i = 0; i < slices && !isSharp; ++i) {
        if (!goOn()) return cancelled();
        isSharp = planet_.settle({&input, 1}, noUpload, atlasTimeoutS / slices);
    }
    for (const BlockKind kind : {BlockKind::Colours, BlockKind::Normals}) planet_.takeTileChanges(kind);
    const SelectionCounters& drawn = planet_.selection().counters;
    const double scalePx = screenScalePx(view);
    setFigure(figures, AtlasMeasure::EpsPx, atlasBoundPx(static_cast<double>(drawn.worstEpsPx), scalePx));
    setFigure(figures, AtlasMeasure::DrawnBoundPx,
              atlasBoundPx(static_cast<double>(drawn.worstDrawnBoundPx), scalePx));
    setFigure(figures, AtlasMeasure::Triangles, static_cast<double>(drawn.triangles()));
    if (isSharp) {
        setFigure(figures, AtlasMeasure::BytesRead,
                  static_cast<double>(planet_.paging().bytesRead() - bytesBefore));
        setFigure(figures, AtlasMeasure::SharpS, planet_.inspect().sinceResetS());
    }
    costs_.settleS += watch.elapsedS();
    if (!survey_.measuresError) return {};
    watch = {};
    const DrawnSnapshot snapshot =
        snapshotOf(planet_.tree(), planet_.selection().draw, view, settings_.stitched);
    TRY_ASSIGN(const TrueErrorReport report,
               measureTrueError(snapshot, heights_, [&](std::uint64_t, std::uint64_t) { return goOn(); }));
    setFigure(figures, AtlasMeasure::MeasuredPx, report.worstFacingPx);
    costs_.errorS += watch.elapsedS();
    return {};
}

Result<void> AtlasMeter::measureMove(const View& view, double aheadM, AtlasFigures& figures,
                                     const std::function<bool()>& goOn) {
    const Stopwatch watch;
    const double angleRad = aheadM / glm::length(view.eyeM);
    PopMeter pops;
    LodChanges changes;
    for (int frame = 0; frame <= 2 * moveFramesAhead; ++frame) {
        if (!goOn()) return cancelled();
        const int ahead = moveFramesAhead - std::abs(frame - moveFramesAhead);
        const View moved = movedAhead(view, angleRad * ahead / moveFramesAhead);
        step(moved, frame == 0 ? 0 : moveFrameS);
        pops.add(planet_.tree(), planet_.selection(), moved, settings_.input.lod, frame * moveFrameS,
                 {.cameraJumped = false, .seaM = settings_.seaM});
        changes.add(planet_.selection(), frame * moveFrameS);
    }
    setFigure(figures, AtlasMeasure::PopPx, pops.totals().worstPx);
    setFigure(figures, AtlasMeasure::Thrashes, static_cast<double>(changes.thrashTotal()));
    costs_.moveS += watch.elapsedS();
    return {};
}

}  // namespace planet
