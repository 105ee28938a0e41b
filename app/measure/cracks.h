// The cracks instrument over an open planet: what the panel and `worldy cracks` share. Wants the scene's GL
// context current.
#pragma once

#include <optional>
#include <vector>

#include "app/measure/crack_measurement.h"
#include "app/scene/scene.h"

namespace worldy {

// Of the last selection, as the view sees it and the settings draw it. The picture on the cube is never
// measured: its chunks are taken as on the sphere.
planet::Result<CrackMeasurement> measureCracks(Scene& scene, const planet::View& view,
                                               const ViewSettings& settings);

// The smallest skirts of the last selection, drawn unstitched, that leave none of the cracks found open, but
// none smaller than those given: over a flight the largest of all frames is what the flight needs.
planet::Result<SmallestSkirts> smallestSkirts(Scene& scene, const planet::View& view,
                                              const CrackMeasurement& measured,
                                              const SmallestSkirts& atLeast = {});

// What the window remembers of the instrument.
struct CrackInstrument {
    std::optional<CrackMeasurement> measured;
    std::vector<planet::DrawItem> drawn;  // that it is of
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

// Paints the crack pixels into a picture of the same view: leaking ones and those that skirts hide, each in
// its colour, with a dark rim so that single pixels are found.
void markCracks(const planet::gl::CrackMap& map, Picture& picture);

}  // namespace worldy
