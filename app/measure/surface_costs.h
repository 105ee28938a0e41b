// What each part of the picture costs: the frame with it against the frame without it, drawn in turn, so that
// a busy machine slows both. Wants the scene's GL context current.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "app/scene/costly_parts.h"
#include "app/scene/scene.h"
#include "planet/gl/device/render_target.h"

namespace worldy {

// Nothing but the lit ground; then with each part, and with all of them.
struct PartSettings {
    const char* name;
    ViewSettings settings;
};
ViewSettings barePicture(const ViewSettings& settings);
// What is paged, and so is there to be drawn only where the planet has it and its paging was told.
struct PartsThere {
    bool colours = true;
    bool normals = true;
};
std::vector<PartSettings> partsOf(const ViewSettings& settings, const PartsThere& there);

class CostMeter {
public:
    // Of the scene's last selection from a view. rounds: at least 1. The Error says what the context cannot
    // do.
    static planet::Result<CostMeter> create(const Scene& scene, const planet::View& view,
                                            const ViewSettings& settings, int rounds);

    // Draws a part once without and once with it; true while there is more to do. Counters of the scene and
    // the framebuffer that is bound stay as they are.
    bool step(Scene& scene);
    double share() const;  // done, [0, 1]
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

// What the window remembers of it.
struct CostInstrument {
    std::optional<CostMeter> meter;  // while it measures
    std::vector<PartCost> costs;
};

}  // namespace worldy
