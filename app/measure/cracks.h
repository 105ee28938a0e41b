// The cracks instrument over an open planet, for the panel and the command. The scene's GL context must be
// current.
#pragma once

#include <optional>
#include <vector>

#include "app/base/picture.h"
#include "app/measure/crack_measurement.h"
#include "app/scene/scene.h"

namespace worldy {

// Measures the cracks of the last selection in a view. Chunks are always measured on the sphere, never on the
// cube.
planet::Result<CrackMeasurement> measureCracks(Scene& scene, const planet::View& view,
                                               const ViewSettings& settings);

// Returns the smallest skirts, at least atLeast, that cover all measured cracks of the last selection without
// stitching. A flight needs the largest of all its frames.
planet::Result<SmallestSkirts> smallestSkirts(Scene& scene, const planet::View& view,
                                              const CrackMeasurement& measured,
                                              const SmallestSkirts& atLeast = {});

// The state of the instrument in the window.
struct CrackInstrument {
    std::optional<CrackMeasurement> measured;
    std::vector<planet::DrawItem> drawn;  // the chunks drawn when measured
    std::optional<SmallestSkirts> smallest;
};

// Returns true if the view, the settings and the drawn chunks are still those that were measured.
bool isCurrent(const CrackInstrument& instrument, const Scene& scene, const planet::View& view,
               const ViewSettings& settings);

// Measures the current view. On an Error the instrument stays as it was.
planet::Result<void> measureNow(CrackInstrument& instrument, Scene& scene, const planet::View& view,
                                const ViewSettings& settings);
// Finds the smallest skirts for the measured cracks. Does nothing if the measurement is no longer current.
planet::Result<void> findSmallestNow(CrackInstrument& instrument, Scene& scene, const planet::View& view,
                                     const ViewSettings& settings);

// Paints the crack pixels into a picture of the same view, in one colour for uncovered and one for covered
// pixels. A dark rim makes single pixels visible.
void markCracks(const planet::gl::CrackMap& map, Picture& picture);

}  // namespace worldy
