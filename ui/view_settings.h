// What the panels edit about the view, in the user's units. Kept in the settings file.
#pragma once

#include "planet/gl/chunk_renderer.h"

namespace ui {

struct ViewSettings {
    double tauPx = 2;            // tolerance on screen, pixels, [0.1, 64]
    double skirtFactor = 1;      // skirt depth in units of the errors it has to hide, [0, 10]
    bool frustumCulling = true;  // leaves out what lies beside and behind the view
    bool horizonCulling = true;  // leaves out what the planet itself hides
    bool skirts = true;          // draws the curtains that hide cracks
    bool wireframe = false;      // draws edges only; not kept between sessions
    bool cube = false;           // draws the cube before it is blown up; not kept between sessions
    bool atmosphere = true;
    bool detail = true;    // roughens the ground between the samples; invented, only for the eye
    bool lighting = true;  // off: flat colour
    planet::gl::ColourBy colourBy = planet::gl::ColourBy::None;
    planet::gl::SurfaceColour surface = planet::gl::SurfaceColour::Image;
    double fovDeg = 60;           // horizontal field of view, degrees, [5, 150]
    bool sunFollows = true;       // the sun keeps to the camera's east, so that it is always day there
    double sunLatitudeDeg = 29;   // else: where the sun stands in the zenith, [-90, 90]
    double sunLongitudeDeg = 31;  // [-180, 180]
    int budgetMB = 256;           // memory for resident chunks, CPU and GPU together, MiB, [16, 65536]
    int loaderThreads = 1;        // threads that read chunks, [1, 64]
    double uploadLimitMs = 4;     // time a frame spent on loaded chunks, ms, [0.1, 100]
};

}  // namespace ui
