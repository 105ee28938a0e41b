// The six faces as an unfolded cube on which every chunk is a square: its layout, what each chunk's state is,
// and which rectangles of which colours show it. Pure functions, no ImGui.
//
//          z_pos
//   y_neg  x_pos  y_pos  x_neg
//          z_neg
//
// Every face stands upright, so that neighbours across the edges that the net has between two faces are
// neighbours on the planet: the middle row is the equator from 135 degrees west, with north up.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <unordered_set>
#include <vector>

#include "planet/chunk_explanation.h"
#include "planet/planet.h"
#include "ui/model/layout.h"
#include "ui/model/table_order.h"

namespace worldy::ui {

inline constexpr int netColumns = 4;
inline constexpr int netRows = 3;

// In faces from the net's top left: x to the right, [0, 4], y down, [0, 3].
struct NetPoint {
    double x = 0;
    double y = 0;
};
NetPoint netPoint(const planet::FacePoint& point);
NetPoint netPointOfDirection(const glm::dvec3& direction);
// Nothing beside the faces.
std::optional<planet::FacePoint> facePointOnNet(const NetPoint& point);

struct NetSquare {
    double x = 0;  // of its top left, in faces
    double y = 0;
    double side = 1;
};
NetSquare netSquare(const planet::ChunkId& id);

// Which part of the net is seen. zoom 1: all of it.
struct NetFocus {
    double zoom = 1;       // [1, netZoomMax]
    double centreX = 0.5;  // share of the net's width and height that is in the middle, [0, 1]
    double centreY = 0.5;
};
inline constexpr double netZoomMax = 65536;

// Where the net lies on the screen.
struct NetPlacement {
    double scalePx = 1;  // a face's side
    double originX = 0;  // of the net's top left, pixels
    double originY = 0;
};
NetPlacement placementOf(const NetFocus& focus, const Rect& area);
NetPoint onScreen(const NetPlacement& placement, const NetPoint& point);  // in pixels
NetPoint onNet(const NetPlacement& placement, double xPx, double yPx);
// What is under the pointer stays there.
NetFocus zoomedAbout(const NetFocus& focus, const Rect& area, double xPx, double yPx, double factor);
NetFocus movedBy(const NetFocus& focus, const Rect& area, double xPx, double yPx);
// A chunk in the middle, and zoomed in at least so far that it can be seen.
NetFocus centredOn(const NetFocus& focus, const Rect& area, const planet::ChunkId& id, double leastSidePx);

// What became of the nodes, by index: Drawn, Split or culled where selection visited them, else NotResident
// for "follows from the nodes above".
std::vector<planet::ChunkState> visitedStates(const planet::ChunkTree& tree,
                                              const planet::Selection& selection);
// The state of a node below one of a known state, given its own entry.
planet::ChunkState stateBelow(planet::ChunkState above, planet::ChunkState visited);
// The state of a node's four children where they are not resident: Requested, Loading, NotResident, Failed
// or NotInFile.
planet::ChunkState missingChildrenState(const planet::ChunkNode& node,
                                        std::span<const planet::ChunkId> loading);

// The parents of the blocks that are being read.
std::vector<planet::ChunkId> loadingParents(const planet::Planet& planet);

// What of a planet the net and the tree list show, gathered once a frame.
struct NetData {
    const planet::ChunkTree& tree;
    std::vector<planet::ChunkState> visited;
    std::vector<planet::ChunkId> loading;
    glm::dvec3 eyeM{0, 0, 0};
    double screenScalePx = 0;  // K'
    double tauPx = 1;
    planet::ErrorMetric metric = planet::ErrorMetric::Additive;
    double nowS = 0;  // since the planet was opened
};
NetData netDataOf(const planet::Planet& planet);
double epsPxOf(const NetData& data, const planet::ChunkNode& node);

enum class NetColour : std::uint8_t { State, Level, Error, DeltaC, Age, Tight };
struct NetColouring {
    NetColour by = NetColour::State;
    double errorScale = 1;  // as of OverlaySettings
    double deltaTopM = 1000;
    double ageTopS = 10;
    glm::vec3 ground{0, 0, 0};  // behind the net: what is not drawn is mixed with it
};

// Pixels; the colour as ImGui packs it, red in the lowest byte.
struct NetRect {
    float x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    std::uint32_t colour = 0;
};
// Squares smaller than this are not drawn; the chunk above them stands for them.
inline constexpr double netLeastSidePx = 3;
// Refills rects with what shows the net within an area, in drawing order. A drawn chunk whose children are
// resident too is a frame about them; children that are not resident are marks inside their quarters.
void fillNetRects(const NetData& data, const NetPlacement& placement, const Rect& area,
                  const NetColouring& colouring, std::vector<NetRect>& rects);

struct NetHit {
    planet::ChunkId id;
    planet::NodeIndex node = planet::noNode;  // none: not resident
    planet::ChunkState state = planet::ChunkState::Resident;
};
// The chunk whose square, frame or mark a point of the screen lies on.
std::optional<NetHit> netHit(const NetData& data, const NetPlacement& placement, double xPx, double yPx);

// A line over the sphere through directions, as pieces on the net: none joins what the net has apart.
struct NetSegment {
    NetPoint from;
    NetPoint to;
};
std::vector<NetSegment> netLine(std::span<const glm::dvec3> directions);

// The outline of what a view shows of a sphere: directions from its centre, closed; beyond the horizon the
// horizon itself. Empty where the sphere is not in view.
std::vector<glm::dvec3> footprintOf(const planet::View& view, double radiusM);

struct TreeRow {
    planet::ChunkId id;
    planet::NodeIndex node = planet::noNode;  // none: not resident
    planet::ChunkState state = planet::ChunkState::Resident;
    double epsPx = 0;      // of a resident one
    bool canOpen = false;  // has children in the file, and is resident
    bool open = false;
};
using OpenChunks = std::unordered_set<planet::ChunkId>;
// Returns the roots, and below each chunk that is open its children. sort orders the roots, and the children
// of each chunk, by a TreeColumn; without it they are in the order of the file.
enum class TreeColumn : std::uint8_t { Chunk, Eps, State };
std::vector<TreeRow> treeRows(const NetData& data, const OpenChunks& open,
                              const std::optional<TableSort>& sort = std::nullopt);
// So that a row shows it.
void openWayTo(const planet::ChunkId& id, OpenChunks& open);

}  // namespace worldy::ui
