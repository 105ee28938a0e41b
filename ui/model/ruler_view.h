// The state of the Ruler panel.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "app/measure/ruler.h"

namespace worldy::ui {

struct RulerView {
    bool takesClicks = false;
    std::span<const glm::dvec3> ends{};        // at most two, metres from the planet's centre
    const MeasuredGround* measured = nullptr;  // between the two ends; null: not measured yet
    bool current = false;                      // measured is of these ends and of what is drawn
    bool running = false;
    std::string problem{};
    std::vector<RulerEndInPicture> inPicture{};  // the ends in the main picture
};

}  // namespace worldy::ui
