#include "ui/model/note_subjects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/base/text.h"
#include "app/scene/camera_control.h"
#include "planet/measure/pick.h"
#include "planet/sphere/cube_sphere.h"
#include "ui/model/figures.h"

namespace worldy::ui {

namespace {

// A note at a place that is given in metres from the planet's centre.
Note noteAt(const EditorView& view, const glm::dvec3& placeM, double exaggeration) {
    Note note;
    const planet::Geographic place = planet::geographicFromDirection(placeM);
    const double radiusM = view.planet->tree().shape.radiusM;
    note.latitudeDeg = glm::degrees(place.latitudeRad);
    note.longitudeDeg = glm::degrees(place.longitudeRad);
    note.heightM = (glm::length(placeM) - radiusM) / exaggeration;
    note.camera = view.camera.pose;
    return note;
}

Note about(Note note, const char* what, std::string measurement) {
    note.about = what;
    note.measurement = std::move(measurement);
    return note;
}

NoteSubject chunkSubject(const EditorView& view, double exaggeration) {
    NoteSubject subject{"the selected chunk", std::nullopt, "Select a chunk first."};
    if (!view.focus.selected) return subject;
    const planet::ChunkId& id = *view.focus.selected;
    const double side = std::ldexp(2.0, -id.level);
    const double u = -1 + side * (id.x + 0.5), v = -1 + side * (id.y + 0.5);
    const glm::dvec3 direction = planet::sphereFromCube(planet::cubePoint(id.face, u, v));
    const planet::ChunkTree& tree = view.planet->tree();
    const double distanceM = tree.shape.radiusM + planet::sampledHeightM(tree, direction);
    subject.note = about(noteAt(view, direction * distanceM, exaggeration), "chunk", "");
    subject.note->chunk = planet::toString(id);
    return subject;
}

NoteSubject errorSubject(const EditorView& view, double exaggeration) {
    NoteSubject subject{"the largest true error", std::nullopt, "Measure the true error first."};
    const ErrorMeasurement* const last = view.instruments.errors.last;
    if (!last || last->worstFirst.empty()) return subject;
    const planet::ChunkError& worst = last->report.chunks[last->worstFirst.front()];
    if (worst.facingPx <= 0) return {subject.label, std::nullopt, "The true error is 0 everywhere."};
    subject.note = about(noteAt(view, worst.worstM, exaggeration), "true error",
                         fmt::format("measured {:.3g} px, drawn bound {:.3g} px, error {}", worst.facingPx,
                                     worst.drawnBoundPx, distanceText(worst.errorM)));
    subject.note->chunk = planet::toString(worst.id);
    return subject;
}

NoteSubject crackSubject(const EditorView& view, double exaggeration) {
    NoteSubject subject{"the largest edge gap", std::nullopt, "Measure the cracks first."};
    const CrackMeasurement* const measured = view.instruments.cracks.measured;
    if (!measured) return subject;
    if (measured->gaps.empty()) return {subject.label, std::nullopt, "All adjacent edges match."};
    const planet::EdgeGap& gap = measured->gaps.front();
    subject.note = about(noteAt(view, gap.placeM, exaggeration), "cracks",
                         fmt::format("gap {}, {}; {} uncovered pixels in the view", distanceText(gap.gapM),
                                     pixelsText(gap.facingPx), measured->map.leaking));
    subject.note->chunk = planet::toString(gap.finer);
    return subject;
}

NoteSubject popSubject(const EditorView& view, double exaggeration) {
    NoteSubject subject{"the largest pop", std::nullopt, "No level change that counts was measured."};
    if (!view.instruments.pops.meter) return subject;
    const auto& events = view.instruments.pops.meter->events();
    const planet::PopEvent* worst = nullptr;
    for (const planet::PopEvent& event : events) {
        if (planet::counts(event) && (!worst || planet::isWorsePop(event, *worst))) worst = &event;
    }
    if (!worst) return subject;
    const glm::dvec3& placeM = worst->jump.worstPlaceM;
    subject.note = about(noteAt(view, placeM, exaggeration), "pops",
                         fmt::format("jump {}, level {} to {}, {}", pixelsText(worst->jump.largestPx),
                                     worst->fromLevel, worst->toLevel, planet::popCauseName(worst->cause)));
    subject.note->camera = planet::poseFromView(worst->view, view.planet->tree().shape.radiusM);
    subject.note->chunk = planet::toString(worst->chunk);
    return subject;
}

// A note about figures that have no place of their own lies where the view looks.
NoteSubject subjectInView(const EditorView& view, const glm::dvec3& middleM, double exaggeration,
                          const char* label, const char* what, std::string measurement, const char* whyNot) {
    NoteSubject subject{label, std::nullopt, whyNot};
    if (measurement.empty()) return subject;
    // Longer texts would be refused.
    if (measurement.size() > longestNoteBytes)
        measurement = measurement.substr(0, measurement.rfind("; ", longestNoteBytes - 5)) + "; ...";
    subject.note = about(noteAt(view, middleM, exaggeration), what, std::move(measurement));
    return subject;
}

std::string joined(const std::vector<std::string>& parts) {
    return fmt::format("{}", fmt::join(parts, "; "));
}

std::string rulerText(const RulerView& ruler) {
    if (!ruler.measured) return {};
    std::vector<std::string> parts;
    for (const Figure& figure : rulerFigures(ruler))
        parts.push_back(fmt::format("{} {}", figure.name, figure.value));
    return joined(parts);
}

std::string costsText(const std::vector<PartCost>& costs) {
    std::vector<std::string> parts;
    for (const Figure& figure : costFigures(costs))
        parts.push_back(fmt::format("{} {}", figure.name, figure.value));
    return joined(parts);
}

// The points on the front of triangles and true error, and the suggested tolerances.
std::string sweepText(const SweepView& sweep) {
    std::vector<std::string> parts;
    if (sweep.table && !sweep.table->points.empty()) {
        std::vector<SweepPoint> points = sweep.table->points;
        markFront(points, SweepCost::Triangles);
        parts.push_back(fmt::format("over {}, {} points{}, on the front", sweep.table->flight, points.size(),
                                    sweep.table->whole ? "" : " of an incomplete sweep"));
        for (const SweepPoint& point : points) {
            if (!point.onFront) continue;
            parts.push_back(fmt::format("{}: {} triangles, max true error {:.3g} px",
                                        settingText(point.chunkSize, point.metric, point.tauPx, "τ"),
                                        countText(point.figures.meanTriangles),
                                        point.figures.worstMeasuredPx));
        }
    }
    for (const SweepSuggestion& one : sweep.suggestions)
        parts.push_back(fmt::format("{}, chunk size {}: {}", metricName(one.metric), one.chunkSize,
                                    suggestionText(one.goal, one.found, "τ")));
    return joined(parts);
}

// The figures over the last flight, or else those of the current view.
std::string comparisonText(const CompareView& compare) {
    const bool isOfFlight = compare.flight.last != nullptr;
    if (!isOfFlight && !compare.on) return {};
    const std::array<ComparedFigures, 2>& sides = isOfFlight ? *compare.flight.last : compare.now;
    std::vector<std::string> parts;
    parts.push_back(isOfFlight ? compare.flight.lastName : fmt::format("this view, B: {}", compare.origin));
    for (const CompareRow& row : compareRows()) {
        const auto& a = sides[0].*row.value;
        const auto& b = sides[1].*row.value;
        if (!(isOfFlight ? row.flight : row.live) || !a || !b) continue;
        parts.push_back(fmt::format("{} {}, {}", row.name, figureText(row, a), figureText(row, b)));
    }
    return joined(parts);
}

NoteSubject precisionSubject(const EditorView& view, double exaggeration) {
    NoteSubject subject{"the vertex last under the pointer", std::nullopt,
                        "Show the Precision panel and point at the ground."};
    const std::optional<ProbedVertex>& vertex = view.instruments.probe.vertex;
    if (!vertex) return subject;
    const planet::VertexPrecision& precision = vertex->precision;
    subject.note = about(noteAt(view, precision.positionM, exaggeration), "precision",
                         fmt::format("camera-relative float error {:.3g} mm, {:.3g} px",
                                     1000 * precision.shader.errorM, precision.shader.errorPx));
    subject.note->chunk = planet::toString(precision.chunk);
    return subject;
}

}  // namespace

glm::dvec3 groundInMiddle(const planet::View& view, const planet::ChunkTree& tree,
                          std::span<const planet::DrawItem> drawn) {
    if (const auto hit = planet::pickSurface(tree, drawn, view.eyeM, -view.back)) return hit->positionM;
    const glm::dvec3 below = glm::normalize(view.eyeM);
    return below * (tree.shape.radiusM + planet::sampledHeightM(tree, below));
}

glm::dvec3 placeOfNote(const Note& note, double radiusM, double exaggeration) {
    const glm::dvec3 direction =
        planet::directionFromGeographic({glm::radians(note.latitudeDeg), glm::radians(note.longitudeDeg)});
    return direction * (radiusM + note.heightM * exaggeration);
}

std::optional<glm::dvec2> pinInPicture(const planet::View& view, const glm::dvec3& placeM, double radiusM) {
    // Behind the horizon: the way from the eye to the place goes through the planet, or through the ground below the
    // place if that lies lower.
    const glm::dvec3 towards = placeM - view.eyeM;
    const double opaqueM = std::min(radiusM, glm::length(placeM)) * (1 - 1e-6);
    const double length2 = glm::dot(towards, towards);
    const double nearest = std::clamp(-glm::dot(view.eyeM, towards) / length2, 0.0, 1.0);
    if (glm::length(view.eyeM + nearest * towards) < opaqueM && glm::length(view.eyeM) > opaqueM)
        return std::nullopt;
    const std::optional<glm::dvec2> at = pixelOf(view, placeM);
    if (!at || at->x < 0 || at->y < 0 || at->x > view.widthPx || at->y > view.heightPx) return std::nullopt;
    return at;
}

bool isCoveredPin(const planet::ChunkTree& tree, std::span<const planet::DrawItem> drawn,
                  const planet::View& view, const glm::dvec3& placeM) {
    // The ray ends above the foot, so that the drawn level may differ from the ground by some pixels.
    constexpr double aboveFootPx = 8;
    const double pixelRad = 2 * std::tan(view.horizontalFovRad / 2) / std::max(view.widthPx, 1);
    const double aboveFootM = aboveFootPx * pixelRad * glm::distance(placeM, view.eyeM);
    const glm::dvec3 seen = placeM + aboveFootM * glm::normalize(placeM);
    const double distanceM = glm::distance(seen, view.eyeM);
    if (distanceM == 0) return false;
    const auto hit = planet::pickSurface(tree, drawn, view.eyeM, seen - view.eyeM);
    return hit && hit->distanceM < distanceM;
}

std::vector<NoteSubject> noteSubjects(const EditorView& view, double exaggeration) {
    if (!view.planet) return {};
    const glm::dvec3 middle =
        groundInMiddle(view.camera.renderView, view.planet->tree(), view.planet->selection().draw);
    std::vector<NoteSubject> subjects = {{"this view", noteAt(view, middle, exaggeration)}};
    subjects.push_back(chunkSubject(view, exaggeration));
    subjects.push_back(errorSubject(view, exaggeration));
    subjects.push_back(crackSubject(view, exaggeration));
    subjects.push_back(popSubject(view, exaggeration));
    subjects.push_back(precisionSubject(view, exaggeration));
    const RulerView& ruler = view.instruments.ruler;
    subjects.push_back(subjectInView(view, ruler.ends.empty() ? middle : ruler.ends.front(), exaggeration,
                                     "the ruler", "ruler", rulerText(ruler),
                                     "Measure the ground between two places in the Ruler panel first."));
    subjects.push_back(subjectInView(view, middle, exaggeration, "the costs of features", "costs",
                                     costsText(view.instruments.light.costs),
                                     "Measure the features in the Frame panel first."));
    subjects.push_back(subjectInView(view, middle, exaggeration, "the sweep", "sweep", sweepText(view.sweep),
                                     "Run a sweep or search for a tolerance in the Sweep panel first."));
    subjects.push_back(subjectInView(view, middle, exaggeration, "the comparison", "comparison",
                                     comparisonText(view.compare),
                                     "Compare with another planet in the Compare panel first."));
    return subjects;
}

}  // namespace worldy::ui
