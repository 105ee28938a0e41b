#include "ui/model/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/base/glossary.h"
#include "app/base/text.h"
#include "planet/sphere/cube_sphere.h"

namespace worldy::ui {

namespace {

// Formats errors from micrometres to metres.
std::string errorText(double metres) {
    const double millimetres = 1000 * metres;
    return millimetres < 1000 ? fmt::format("{:.3f} mm", millimetres) : distanceText(metres);
}

std::string errorPxText(double px) {
    return fmt::format("{:.4f} px", px);
}

std::string stepText(double metres) {
    if (!std::isfinite(metres)) return "none";
    return metres < 1 ? errorText(metres) : distanceText(metres);
}

std::string slopeText(double slopeRad) {
    // Three decimals, and never "-0.000".
    const auto rounded = [](double value) { return std::round(1000 * value) / 1000 + 0.0; };
    return fmt::format("{:.3f}° ({:.3f} %)", rounded(glm::degrees(slopeRad)),
                       rounded(100 * std::tan(slopeRad)));
}

std::string lengthText(double metres) {
    return std::abs(metres) < 10'000 ? fmt::format("{:.2f} m", metres)
                                     : fmt::format("{:.3f} km", metres / 1000);
}

std::string endText(const glm::dvec3& endM) {
    const planet::Geographic place = planet::geographicFromDirection(endM);
    return placeText(glm::degrees(place.latitudeRad), glm::degrees(place.longitudeRad), 6);
}

void addPixelFigures(const RulerEndInPicture& a, const RulerEndInPicture& b, Figures& figures) {
    figures.push_back({"On screen",
                       a.atPx && b.atPx ? pixelsText(glm::distance(*a.atPx, *b.atPx)) : "behind the camera",
                       "Distance of A and B in the picture of the planet, in its pixels."});
    const auto pixelText = [](double metres) {
        return metres < 1 ? fmt::format("{:.3f} m", metres) : lengthText(metres);
    };
    figures.push_back({"A pixel at A, at B", fmt::format("{}, {}", pixelText(a.pixelM), pixelText(b.pixelM)),
                       "Length across the line of sight that covers one pixel in the middle of the picture, "
                       "at the distance of each end."});
}

void addLengthFigures(const planet::ProfileSummary& summary, Figures& figures) {
    figures.push_back({"Distance", lengthText(summary.arcM),
                       "Along the great circle from A to B, at the radius of the planet, height 0."});
    figures.push_back({"Along the ground", lengthText(summary.onGroundM),
                       "Along the finest data, through 513 places at equal steps. Relief between two of them "
                       "is not counted."});
    figures.push_back({"Straight line", lengthText(summary.straightM),
                       "From A to B through space, between the finest heights."});
    figures.push_back({"Height difference", heightText(summary.riseM),
                       "Height of B minus height of A, in the finest data."});
    figures.push_back({"Slope", slopeText(summary.slopeRad),
                       "Of the straight line from A to B, against the horizontal in its middle; upwards is "
                       "positive."});
    figures.push_back({"Steepest", slopeText(summary.steepestRad),
                       "Between two neighbouring places of the profile, the one of the largest magnitude."});
    figures.push_back({"Ascent, descent",
                       fmt::format("{}, {}", heightText(summary.ascentM), heightText(summary.descentM)),
                       "Sums of all rises and of all falls on the way from A to B."});
    figures.push_back({"Lowest, highest",
                       fmt::format("{}, {}", heightText(summary.lowestM), heightText(summary.highestM)),
                       "Heights of the finest data along the way."});
}

void addDrawnFigures(const MeasuredGround& measured, Figures& figures) {
    const planet::ProfileSummary& summary = measured.summary;
    const std::size_t points = measured.profile.points.size();
    figures.push_back({"Largest error",
                       summary.drawn == 0 ? "nothing is drawn"
                                          : fmt::format("{} at {}", lengthText(summary.worstErrorM),
                                                        lengthText(summary.worstAlongM)),
                       "Largest height difference of the drawn surface from the finest data along the way, "
                       "and its distance from A. Places without a drawn chunk are not counted."});
    if (summary.drawn == 0 || summary.drawn >= points) return;
    figures.push_back(
        {"Drawn",
         fmt::format("{:.0f} %", 100.0 * static_cast<double>(summary.drawn) / static_cast<double>(points)),
         "Share of the places at which a chunk is drawn; the rest is culled.", FigureMood::Warning});
}

}  // namespace

std::string finePx(double px, const char* unit) {
    return fmt::format("{:.3g}{}", px, unit);
}

std::string popPxText(double px) {
    return px < leastPopPx ? fmt::format("< {} px", leastPopPx)
           : px < 0.01     ? fmt::format("{:.3f} px", px)
                           : pixelsText(px);
}

std::string factorText(double factor) {
    return std::isfinite(factor) ? fmt::format("{:.3f}", factor) : std::string("none");
}

Figures errorFigures(const ErrorMeasurement& measured) {
    const planet::TrueErrorReport& report = measured.report;
    const bool wrong = report.violations > 0;
    Figures figures;
    figures.push_back({"Violations", fmt::format("{}", report.violations),
                       "Chunks whose measured error exceeds the drawn bound, in facing pixels. Must be 0.",
                       wrong ? FigureMood::Bad : FigureMood::Good});
    if (report.violationsInSeams > 0)
        figures.push_back(
            {"  beside seams", fmt::format("{}", report.violationsInSeams),
             "Violations whose largest error lies in a cell beside an edge stitched to a coarser chunk. "
             "Triangles there span several cells, which δc does not cover.",
             FigureMood::Bad});
    figures.push_back(
        {"Geometric max error", finePx(report.worstFacingPx),
         "Largest error of any finest sample, in pixels, as if the view faced it: K' times the angle "
         "between its true and its drawn position. The drawn bound bounds this error."});
    figures.push_back(
        {"Screen-space max error", finePx(report.worstScreenPx),
         "Largest error in the projected image, in pixels, of the samples inside it, including hidden ones. "
         "The projection stretches towards the corners, so this can exceed the geometric error."});
    figures.push_back(
        {"99th percentile", finePx(report.p99FacingPx),
         "99 % of the chunks have no larger error, as if the view faced it; each chunk counts once."});
    figures.push_back({"Max \u03b5", finePx(report.worstEpsPx),
                       "Largest predicted error of a drawn chunk's own surface, in pixels. Compared with τ. "
                       "Excludes morph."});
    figures.push_back({"Max drawn bound", finePx(report.worstDrawnBoundPx), terms::drawnBoundPx.meaning});
    figures.push_back(
        {"Slack", fmt::format("{:.0f} %", 100 * report.meanSlack),
         "1 - measured / bound, mean over the chunks. Larger: more triangles than the tolerance needs."});
    figures.push_back(
        {terms::drawnChunks.name, fmt::format("{}", report.chunks.size()), "Chunks drawn in that frame."});
    figures.push_back(
        {"Samples", countText(static_cast<double>(report.samples)), "Number of finest samples compared."});
    return figures;
}

Figures crackFigures(const CrackMeasurement& measured) {
    Figures figures;
    figures.push_back(
        {"Crack pixels", fmt::format("{}", measured.map.pixels.size()),
         "Pixels whose depth differs between rendering with full-depth skirts and without skirts."});
    figures.push_back({"Uncovered pixels", fmt::format("{}", measured.map.leaking),
                       "Crack pixels that the current skirts do not cover. Must be 0.",
                       measured.map.leaking == 0 ? FigureMood::Good : FigureMood::Bad});
    figures.push_back({"Crack clusters", fmt::format("{}", measured.spots.size()),
                       "Connected crack pixels between the same two chunks."});
    figures.push_back({"LOD seams", fmt::format("{}", measured.levelPairs),
                       "Pairs of adjacent drawn chunks with different levels."});
    return figures;
}

Figures skirtFigures(const CrackMeasurement& measured, const SmallestSkirts* smallest) {
    Figures figures = {{"Required depth (max gap)", distanceText(measured.required.depthM),
                        "Largest height difference between two adjacent edges, in metres."},
                       {"Required factor (max gap)", factorText(measured.required.factor),
                        "Smallest automatic factor whose skirts reach every adjacent edge."}};
    if (!smallest) return figures;
    figures.push_back(
        {"Smallest depth", distanceText(smallest->depthM),
         "Smallest fixed skirt depth that leaves no uncovered pixel in this view; within 0.5 %."});
    figures.push_back(
        {"Smallest factor", factorText(smallest->factor),
         "Smallest automatic factor that leaves no uncovered pixel in this view; within 0.5 %."});
    return figures;
}

Figures popFigures(const planet::PopMeter& meter, double medianPx) {
    const planet::PopTotals& t = meter.totals();
    const auto count = [](std::uint64_t value) { return countText(static_cast<double>(value)); };
    constexpr std::array<const char*, planet::popCauseCount> meanings = {
        "The chunk's screen-space error crossed the tolerance because the camera moved.",
        "A setting that affects LOD selection was changed: tolerance, hysteresis, metric, max LOD level, "
        "culling, stitched seams, field of view, picture size or exaggeration. A level change that fades "
        "keeps this cause.",
        "The chunk was drawn too coarse until its children were loaded.",
        "The chunk's children were evicted although they were needed: the memory budget is too small.",
        "Stitched seams limit the level difference of neighbours, and a neighbour changed.",
        "Stitched seams limit the level difference of neighbours, and a neighbour entered or left the view."};
    Figures figures;
    for (std::size_t i = 0; i < planet::popCauseCount; ++i)
        figures.push_back(
            {planet::popCauseName(static_cast<planet::PopCause>(i)), count(t.byCause[i]), meanings[i]});
    figures.push_back(
        {"median jump", popPxText(medianPx), "Median of the level changes in the histogram, in pixels."});
    figures.push_back(
        {"max jump", popPxText(t.worstPx),
         "Largest jump of the level changes that count since the list was cleared, in pixels."});
    figures.push_back(
        {"max adjacent jump", popPxText(t.worstBesidePx),
         "Largest jump along an edge of an unchanged chunk adjacent to a level change, in pixels; the "
         "edge follows its neighbour."});
    figures.push_back(
        {"late now", count(meter.lateOpen()),
         "Chunks drawn although their error exceeds the tolerance, because their children are not loaded.",
         meter.lateOpen() > 0 ? FigureMood::Warning : FigureMood::Plain});
    figures.push_back({"late, total", count(t.late), "Late chunks since the list was cleared."});
    figures.push_back(
        {"not measured", count(t.notMeasured),
         "Level changes in a frame in which the exaggeration changed too: all heights jump there, so no "
         "jump is measured. They count only in the totals by cause."});
    figures.push_back({"outside picture", count(t.outsidePicture),
                       "Level changes outside the picture; they count only in the totals by cause."});
    figures.push_back(
        {"under sea", count(t.underSea),
         "Level changes of the sea bed under a sea that is drawn as water. They are not visible and "
         "count only "
         "in the totals by cause."});
    figures.push_back(
        {"after jump", count(t.afterJump),
         "Level changes caused by a camera jump or by the start of the measurement: the loads and fades that "
         "were due then. They are listed last and count only in the totals by cause."});
    return figures;
}

Figures precisionFigures(const planet::VertexPrecision& p) {
    Figures figures;
    figures.push_back({"Vertex", fmt::format("{}, {}", p.vertex.x, p.vertex.y),
                       "Column and row in the chunk, from its south-west corner."});
    figures.push_back({"Distance", distanceText(p.distanceM), "Distance from the camera."});
    figures.push_back(
        {"x", fmt::format("{:.4f} m", p.positionM.x),
         "Double-precision position of the drawn vertex, including morph and stitched edges, in metres "
         "from the planet's centre. x points to latitude 0, longitude 0."});
    figures.push_back(
        {"y", fmt::format("{:.4f} m", p.positionM.y), "y points to latitude 0, longitude 90° E."});
    figures.push_back({"z", fmt::format("{:.4f} m", p.positionM.z), "z points to the north pole."});
    figures.push_back(
        {"Camera-relative float error", errorText(p.shader.errorM),
         "Camera-relative rendering: error of the vertex shader's single-precision position, in "
         "millimetres. The same computation "
         "is done in floats, relative to the camera and a nearby reference point."});
    figures.push_back(
        {"Camera-relative error in px", errorPxText(p.shader.errorPx),
         "The error in screen space: K' |a/|a| - b/|b||, with a and b relative to the camera. Above "
         "about 0.5 px vertices jitter.",
         p.shader.errorPx > 0.5 ? FigureMood::Bad : FigureMood::Plain});
    figures.push_back(
        {"Planet-origin float error", errorText(p.fromCentre.errorM),
         "For comparison: the error with float positions relative to the planet's centre minus a float "
         "camera position."});
    figures.push_back({"Planet-origin error in px", errorPxText(p.fromCentre.errorPx),
                       "The error in screen space.",
                       p.fromCentre.errorPx > 0.5 ? FigureMood::Warning : FigureMood::Plain});
    return figures;
}

Figures depthFigures(const DepthSteps& depth) {
    Figures figures;
    figures.push_back({"View depth", distanceText(depth.aheadM),
                       "Distance along the view direction, from which depth is computed."});
    const char* inUse = depth.reversedInUse ? "Reversed Z, in use" : "Reversed Z";
    figures.push_back(
        {inUse, stepText(depth.reversedFloatM),
         "Distance in metres between adjacent values of a float depth buffer, with 1 at the near plane "
         "and 0 at infinity. Closer surfaces may z-fight."});
    figures.push_back(
        {depth.reversedInUse ? "Non-reversed Z" : "Non-reversed Z, in use", stepText(depth.fallbackM),
         "Distance in metres between adjacent depth values with conventional OpenGL depth, used without clip "
         "control; the near plane follows the height above ground. None: outside the near and far planes."});
    return figures;
}

std::string heightText(double metres) {
    return std::abs(metres) < 100 ? fmt::format("{:.2f} m", metres) : fmt::format("{:.0f} m", metres);
}

Figures rulerFigures(const RulerView& ruler) {
    Figures figures;
    constexpr std::array names = {"A", "B"};
    for (std::size_t i = 0; i < std::min(ruler.ends.size(), names.size()); ++i)
        figures.push_back({names[i], endText(ruler.ends[i]), "Latitude and longitude of this end."});
    if (ruler.inPicture.size() == 2) addPixelFigures(ruler.inPicture[0], ruler.inPicture[1], figures);
    if (!ruler.measured) return figures;
    addLengthFigures(ruler.measured->summary, figures);
    addDrawnFigures(*ruler.measured, figures);
    return figures;
}

Figures costFigures(const std::vector<PartCost>& costs) {
    Figures figures;
    for (const PartCost& cost : costs)
        figures.push_back({cost.part,
                           fmt::format("{:+.1f} ms, {:.2f} x", cost.withMs - cost.withoutMs,
                                       cost.withMs / std::max(cost.withoutMs, 1e-6)),
                           "Additional frame time compared with the lit ground alone, which is 1."});
    return figures;
}

}  // namespace worldy::ui
