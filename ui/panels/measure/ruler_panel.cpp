#include "ui/panels/measure/ruler_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "app/base/text.h"
#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/panels/measure/ruler_profile.h"

namespace worldy::ui {

namespace {

std::string slopeText(double slopeRad) {
    // Three decimals, and never "-0.000".
    const auto rounded = [](double value) { return std::round(1000 * value) / 1000 + 0.0; };
    return fmt::format("{:.3f}° ({:.3f} %)", rounded(glm::degrees(slopeRad)),
                       rounded(100 * std::tan(slopeRad)));
}

std::string metresText(double metres) {
    return std::abs(metres) < 10'000 ? fmt::format("{:.2f} m", metres)
                                     : fmt::format("{:.3f} km", metres / 1000);
}

std::string endText(const glm::dvec3& endM) {
    const planet::Geographic place = planet::geographicFromDirection(endM);
    return placeText(glm::degrees(place.latitudeRad), glm::degrees(place.longitudeRad), 6);
}

void controls(const RulerView& ruler, Commands& commands) {
    bool takesClicks = ruler.takesClicks;
    if (ImGui::Checkbox("Click places", &takesClicks)) commands.push_back(TakeRulerClicks{takesClicks});
    noteItem("Click places");
    tooltip(
        "Clicks on the ground in the viewport place the two ends, A and B, instead of selecting chunks. A "
        "third click "
        "begins again with A.");
    beginGrey(ruler.ends.size() < 2, "There are no two ends yet.");
    sameLineForButton("Swap");
    if (button("Swap", "Measures from B to A.")) commands.push_back(SwapRulerEnds{});
    endGrey();
    beginGrey(ruler.ends.empty(), "There is no end yet.");
    sameLineForButton("Clear");
    if (button("Clear", "Removes both ends.")) commands.push_back(ClearRuler{});
    endGrey();
}

void endRows(const RulerView& ruler) {
    const char* names[] = {"A", "B"};
    for (std::size_t i = 0; i < ruler.ends.size(); ++i)
        valueRow(names[i], endText(ruler.ends[i]), "Latitude and longitude of this end.");
}

void lengthRows(const planet::ProfileSummary& summary) {
    valueRow("Distance", metresText(summary.arcM),
             "Along the great circle from A to B, at the radius of the planet, height 0.");
    valueRow("Along the ground", metresText(summary.onGroundM),
             "Along the finest data, through 513 places at equal steps. Relief between two of them is not "
             "counted.");
    valueRow("Straight line", metresText(summary.straightM),
             "From A to B through space, between the finest heights.");
    valueRow("Height difference", heightText(summary.riseM),
             "Height of B minus height of A, in the finest data.");
    valueRow("Slope", slopeText(summary.slopeRad),
             "Of the straight line from A to B, against the horizontal in its middle; upwards is positive.");
    valueRow("Steepest", slopeText(summary.steepestRad),
             "Between two neighbouring places of the profile, the one of the largest magnitude.");
    valueRow("Ascent, descent",
             fmt::format("{}, {}", heightText(summary.ascentM), heightText(summary.descentM)),
             "Sums of all rises and of all falls on the way from A to B.");
    valueRow("Lowest, highest",
             fmt::format("{}, {}", heightText(summary.lowestM), heightText(summary.highestM)),
             "Heights of the finest data along the way.");
}

void drawnRow(const MeasuredGround& measured) {
    const planet::ProfileSummary& summary = measured.summary;
    const std::size_t points = measured.profile.points.size();
    const std::string error = summary.drawn == 0 ? "nothing is drawn"
                                                 : fmt::format("{} at {}", metresText(summary.worstErrorM),
                                                               metresText(summary.worstAlongM));
    valueRow("Largest error", error,
             "Largest height difference of the drawn surface from the finest data along the way, and its "
             "distance from A. "
             "Places without a drawn chunk are not counted.");
    if (summary.drawn > 0 && summary.drawn < points) {
        valueRow(
            "Drawn",
            fmt::format("{:.0f} %", 100.0 * static_cast<double>(summary.drawn) / static_cast<double>(points)),
            "Share of the places at which a chunk is drawn; the rest is culled.", &palette().warning);
    }
}

void pixelRows(const RulerEndInPicture& a, const RulerEndInPicture& b) {
    valueRow("On screen",
             a.atPx && b.atPx ? pixelsText(glm::distance(*a.atPx, *b.atPx)) : "behind the camera",
             "Distance of A and B in the picture of the planet, in its pixels.");
    const auto pixelText = [](double metres) {
        return metres < 1 ? fmt::format("{:.3f} m", metres) : metresText(metres);
    };
    valueRow("A pixel at A, at B", fmt::format("{}, {}", pixelText(a.pixelM), pixelText(b.pixelM)),
             "Length across the line of sight that covers one pixel in the middle of the picture, at the "
             "distance of each "
             "end.");
}

const char* hintOf(const RulerView& ruler) {
    if (!ruler.takesClicks) return "Turn on \"Click places\", then click two places on the ground.";
    return ruler.ends.empty() ? "Click the first place, A, on the ground." : "Click the second place, B.";
}

}  // namespace

void rulerPanel(const EditorView& view, Commands& commands) {
    if (!view.planet) return emptyState("No planet is open. Open one to measure its ground.");
    const RulerView& ruler = view.instruments.ruler;
    controls(ruler, commands);
    if (!ruler.problem.empty()) wrappedText(ruler.problem, palette().bad);
    if (ruler.ends.size() < 2) wrappedText(hintOf(ruler), palette().dim);
    if (beginValues("ruler")) {
        endRows(ruler);
        if (ruler.inPicture.size() == 2) pixelRows(ruler.inPicture[0], ruler.inPicture[1]);
        if (ruler.measured) {
            lengthRows(ruler.measured->summary);
            drawnRow(*ruler.measured);
        }
        endValues();
    }
    if (ruler.ends.size() == 2 && !ruler.current && ruler.problem.empty()) {
        wrappedText(
            ruler.measured
                ? "The drawn chunks have changed; the profile is measured again when they have loaded."
                : "Measuring the ground...",
            palette().dim);
    }
    if (ruler.measured) rulerProfile(ruler.measured->profile, ruler.measured->summary, 9);
}

}  // namespace worldy::ui
