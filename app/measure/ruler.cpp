#include "app/measure/ruler.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "app/scene/camera_control.h"
#include "app/scene/error_measurement.h"
#include "app/settings/camera_text.h"
#include "planet/sphere/cube_sphere.h"

namespace worldy {

namespace {

constexpr int profilePoints = 513;
constexpr double leastIntervalS = 0.5;
constexpr planet::LineColour rulerColour{255, 196, 64, 255};
constexpr planet::LineColour pointedColour{255, 255, 255, 255};

planet::ProfileGround groundOf(const planet::Planet& planet) {
    const planet::ViewInput& input = planet.views()[0].input;
    return planet::profileGroundOf(planet.tree(), planet.selection().draw, input.lodView,
                                   input.lod.seams == planet::SeamMode::Stitched);
}

void takeResult(Ruler& ruler) {
    if (!ruler.job) return;
    auto result = ruler.job->takeResult();
    if (!result) return;
    ruler.job.reset();
    ruler.problem.clear();
    if (!*result) {
        ruler.problem = result->error().message;
        return;
    }
    ruler.last = std::exchange(ruler.running, {});
    ruler.last->profile = std::move(**result);
    ruler.last->summary = planet::summaryOf(ruler.last->profile);
}

bool isOf(const MeasuredGround& last, const Ruler& ruler, const planet::Planet& planet) {
    const auto reaches = [](const planet::ProfilePoint& point, const glm::dvec3& endM) {
        return glm::distance(point.direction, glm::normalize(endM)) < 1e-12;
    };
    return ruler.ends.size() == 2 && last.exaggeration == planet.tree().exaggeration &&
           reaches(last.profile.points.front(), ruler.ends[0]) &&
           reaches(last.profile.points.back(), ruler.ends[1]) &&
           drawnAlike(last.drawn, planet.selection().draw);
}

}  // namespace

void placeRulerEnd(Ruler& ruler, const glm::dvec3& positionM) {
    if (ruler.ends.size() >= 2) clearRuler(ruler);
    ruler.ends.push_back(positionM);
}

std::vector<planet::CameraPose> rulerPlaces(const Ruler& ruler, double radiusM) {
    std::vector<planet::CameraPose> places;
    for (const glm::dvec3& endM : ruler.ends) {
        const planet::Geographic place = planet::geographicFromDirection(glm::normalize(endM));
        places.push_back(roundedPose({.latitudeDeg = glm::degrees(place.latitudeRad),
                                      .longitudeDeg = glm::degrees(place.longitudeRad),
                                      .altitudeM = glm::length(endM) - radiusM}));
    }
    return places;
}

void setRulerPlaces(Ruler& ruler, std::span<const planet::CameraPose> places, double radiusM) {
    clearRuler(ruler);
    for (const planet::CameraPose& place : places.first(std::min<std::size_t>(places.size(), 2))) {
        const glm::dvec3 direction = planet::directionFromGeographic(
            {glm::radians(place.latitudeDeg), glm::radians(place.longitudeDeg)});
        placeRulerEnd(ruler, (radiusM + place.altitudeM) * direction);
    }
}

void swapRulerEnds(Ruler& ruler) {
    if (ruler.ends.size() == 2) std::swap(ruler.ends[0], ruler.ends[1]);
}

void clearRuler(Ruler& ruler) {
    ruler.ends.clear();
    ruler.job.reset();
    ruler.last.reset();
    ruler.problem.clear();
}

void forgetGround(Ruler& ruler) {
    ruler = {.takesClicks = ruler.takesClicks, .ends = std::move(ruler.ends)};
}

void advanceRuler(const planet::Planet& planet, double timeS, Ruler& ruler) {
    takeResult(ruler);
    ruler.current = ruler.last && isOf(*ruler.last, ruler, planet);
    if (ruler.ends.size() < 2 || ruler.current || ruler.job || !ruler.problem.empty() || !planet.settled())
        return;
    if (ruler.startedAtS != 0 && timeS - ruler.startedAtS < leastIntervalS) return;
    ruler.startedAtS = timeS;
    if (!ruler.heights)
        ruler.heights =
            std::make_shared<planet::FinestHeights>(std::make_shared<const planet::ChunkFile>(planet.file()));
    ruler.running = {{}, {}, planet.selection().draw, planet.tree().exaggeration};
    ruler.job = std::make_unique<Job<planet::Result<planet::GroundProfile>>>(
        [ground = groundOf(planet), heights = ruler.heights, from = ruler.ends[0],
         to = ruler.ends[1]](const std::stop_token& stop) {
            return planet::groundProfile(ground, *heights, from, to, profilePoints,
                                         [&] { return !stop.stop_requested(); });
        });
}

RulerEndInPicture rulerEndIn(const planet::View& view, const glm::dvec3& endM) {
    return {pixelOf(view, endM), glm::distance(view.eyeM, endM) / planet::screenScalePx(view)};
}

planet::Lines rulerLines(const Ruler& ruler, const planet::View& view, double radiusM) {
    planet::Lines lines;
    const double pixelRad = 1 / planet::screenScalePx(view);
    const auto lifted = [&](const glm::dvec3& pointM, double px) {
        return pointM + glm::normalize(pointM) * (px * pixelRad * glm::distance(view.eyeM, pointM));
    };
    constexpr double postPx = 24;
    for (const glm::dvec3& endM : ruler.ends) {
        lines.push_back({endM, rulerColour});
        lines.push_back({lifted(endM, postPx), rulerColour});
    }
    if (ruler.ends.size() < 2 || !ruler.last) return lines;
    constexpr double abovePx = 2;
    const auto over = [&](const planet::ProfilePoint& point) {
        const double heightM = std::max(point.finestM, point.drawnM.value_or(point.finestM));
        return point.direction * (radiusM + heightM);
    };
    const std::vector<planet::ProfilePoint>& points = ruler.last->profile.points;
    for (std::size_t i = 1; i < points.size(); ++i) {
        for (const planet::ProfilePoint* point : {&points[i - 1], &points[i]})
            lines.push_back({lifted(over(*point), abovePx), rulerColour});
    }
    if (ruler.pointed && *ruler.pointed < points.size()) {
        const glm::dvec3 groundM = over(points[*ruler.pointed]);
        constexpr double armPx = 7;
        const double armM = armPx * pixelRad * glm::distance(view.eyeM, groundM);
        for (const glm::dvec3& arm : {armM * view.right, armM * view.up}) {
            lines.push_back({lifted(groundM, abovePx) - arm, pointedColour});
            lines.push_back({lifted(groundM, abovePx) + arm, pointedColour});
        }
    }
    return lines;
}

}  // namespace worldy
