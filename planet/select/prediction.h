// Predicts where a camera will be, and which blocks it will want there, so that they can be loaded early.
//
// Motion is measured over the last half second and continued on the sphere: the eye goes on around the
// planet's centre at its angular speed, its track keeps turning at its rate, its height keeps growing or
// shrinking by the same factor per second, and the camera keeps rotating relative to the track. A camera that
// moves in a straight line, on a circle or not at all is predicted exactly, apart from rounding.
//
// Pure functions, any thread.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "planet/select/lod_types.h"
#include "planet/sphere/view.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

struct TimedView {
    View view;
    double timeS = 0;
};

// The last views of a camera, oldest first, over at most half a second.
using ViewHistory = std::vector<TimedView>;

// Adds a view at a time that is not earlier than the last one. A jump (isCameraJump) forgets the views before
// it.
void addView(ViewHistory& history, const View& view, double timeS, double radiusM);

// How a camera moves. Axes are unit vectors.
struct Motion {
    glm::dvec3 travelAxis{0, 0, 1};  // orthogonal to the eye; the eye moves around it, by the right-hand rule
    double travelRadS = 0;           // rad/s, >= 0
    double turnRadS = 0;             // of the track, to the left, rad/s
    double climbPerS = 0;            // growth of the logarithm of the height, 1/s
    glm::dvec3 lookAxis{0, 0, 1};    // the camera rotates around it relative to the track
    double lookRadS = 0;             // rad/s, >= 0
};

// Returns a motion without any rate if the history is shorter than two views.
Motion motionOf(const ViewHistory& history, double radiusM);
bool isStill(const Motion& motion);

// Returns the view of a moving camera after a time, s, >= 0. The picture keeps its size and its field of view.
View viewAfter(const View& now, const Motion& motion, double seconds, double radiusM);

// Visits the nodes that a view draws if nothing is missing, as selectChunks does without memory and without
// stitching. Appends the blocks that it lacks and can request, and all visited nodes, parents first.
void collectRequests(const ChunkTree& tree, const View& view, const LodSettings& settings,
                     std::vector<ChildrenRequest>& requests, std::vector<NodeIndex>& touched);

}  // namespace planet
