// The figures of measurements as texts with units, for the panels and the session report alike. Pure functions.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/measure/probed_vertex.h"
#include "ui/model/cracks_view.h"
#include "ui/model/errors_view.h"
#include "ui/model/light_view.h"
#include "ui/model/pops_view.h"
#include "ui/model/ruler_view.h"

namespace worldy::ui {

enum class FigureMood : std::uint8_t { Plain, Good, Warning, Bad };

struct Figure {
    std::string name;
    std::string value;
    std::string explanation;  // one or two sentences
    FigureMood mood = FigureMood::Plain;
};
using Figures = std::vector<Figure>;

Figures errorFigures(const ErrorMeasurement& measured);
// Counts of crack pixels and clusters; then the depths and factors that hide all cracks. smallest: null if they were not
// searched for.
Figures crackFigures(const CrackMeasurement& measured);
Figures skirtFigures(const CrackMeasurement& measured, const SmallestSkirts* smallest);
// medianPx: PopMeter::percentilePx(0.5), which takes longer than a frame should.
Figures popFigures(const planet::PopMeter& meter, double medianPx);
Figures precisionFigures(const planet::VertexPrecision& precision);
Figures depthFigures(const DepthSteps& depth);
Figures costFigures(const std::vector<PartCost>& costs);
// Returns the figures of the ends that there are, and of the ground between them once it is measured.
Figures rulerFigures(const RulerView& ruler);

// Returns a height with all metres, and with centimetres below 100 m: "8849 m", "12.34 m".
std::string heightText(double metres);
// Formats with more digits than pixelsText(), because the errors compared are often 0.1 px.
std::string finePx(double px, const char* unit = " px");
inline constexpr double leastPopPx = 0.001;  // smaller jumps are all shown as less than this
std::string popPxText(double px);            // "< 0.001 px", "0.004 px", "1.3 px"
std::string factorText(double factor);       // "1.250"; "none" if there is none

}  // namespace worldy::ui
