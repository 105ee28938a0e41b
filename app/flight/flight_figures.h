// The figures of one flight with one set of settings.
#pragma once

#include <cstdint>

namespace worldy {

// The cost and the error over the sample frames of a flight.
struct FlightFigures {
    int frames = 0;
    double meanGroundTriangles = 0;
    double meanSkirtTriangles = 0;
    double meanTriangles = 0;  // sum of ground and skirt triangles
    double mostTriangles = 0;
    double meanChunks = 0;
    double mostResidentMiB = 0;    // resident chunks, CPU and GPU together
    double medianFrameMs = 0;      // selecting and drawing, including the GPU
    double worstEpsPx = 0;         // predicted error of a chunk's own surface
    double worstDrawnBoundPx = 0;  // bound of what is drawn, morph included
    double worstMeasuredPx = 0;    // true error, as if the view faced it (planet/measure/true_error.h)
    double p99MeasuredPx = 0;      // over all chunks of all frames
    double worstScreenPx = 0;      // in the projected image
    std::uint64_t violations = 0;  // chunks whose true error exceeds the drawn bound
    std::uint64_t bytesRead = 0;   // from the chunk file, starting with the six root chunks

    bool operator==(const FlightFigures&) const = default;
};

}  // namespace worldy
