// Measures the cost of each feature: the frame with and without it, drawn in alternation, so that a busy
// machine slows both. The scene's GL context must be current.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "app/scene/costly_parts.h"
#include "app/scene/scene.h"
#include "planet/gl/device/render_target.h"

namespace worldy {

// The settings that draw the lit ground with one feature.
struct PartSettings {
    const char* name;
    ViewSettings settings;
};
// The paged data that the planet has.
struct PartsThere {
    bool colours = true;
    bool normals = true;
};
// Returns settings with each feature, then with all of them.
std::vector<PartSettings> partsOf(const ViewSettings& settings, const PartsThere& there);

class CostMeter {
public:
    // Measures the scene's last selection in a view. rounds: at least 1.
    static planet::Result<CostMeter> create(const Scene& scene, const planet::View& view,
                                            const ViewSettings& settings, int rounds);

    // Draws once without and once with a feature. Returns true while there is more to measure. The counters
    // of the scene and the bound framebuffer stay unchanged.
    bool step(Scene& scene);
    double share() const;  // completed share, [0, 1]
    std::vector<PartCost> costs() const;

private:
    struct Part {
        PartSettings settings;
        std::vector<double> withoutMs, withMs;
    };
    CostMeter(planet::gl::RenderTarget target, const planet::View& view, ViewSettings bare,
              std::vector<Part> parts, int rounds);
    double drawnMs(Scene& scene, const ViewSettings& settings) const;

    planet::gl::RenderTarget target_;
    planet::View view_;
    ViewSettings bare_;
    std::vector<Part> parts_;
    std::size_t done_ = 0;
    std::size_t wanted_ = 0;
};

// The state of the instrument in the window.
struct CostInstrument {
    std::optional<CostMeter> meter;  // set while measuring
    std::vector<PartCost> costs;
};

}  // namespace worldy
