// The net of faces (ui/model/net_cells.h) with the state of each chunk, and the coloured rectangles that show it. Pure
// functions, no ImGui.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <unordered_set>
#include <vector>

#include "app/scene/atlas_drape.h"
#include "planet/chunk_explanation.h"
#include "planet/planet.h"
#include "ui/model/net_cells.h"
#include "ui/model/table_order.h"

namespace worldy::ui {

using NetPoint = PlanPoint;  // in faces, x in [0, 4], y in [0, 3]
using NetFocus = PlanFocus;
using NetPlacement = PlanPlacement;
NetPoint netPoint(const planet::FacePoint& point);
NetPoint netPointOfDirection(const glm::dvec3& direction);
// Returns none for a point outside the faces.
std::optional<planet::FacePoint> facePointOnNet(const NetPoint& point);

// Centres a chunk, and zooms in if needed until its side is at least leastSidePx.
NetFocus centredOn(const NetFocus& focus, const Rect& area, const planet::ChunkId& id, double leastSidePx);

// Returns a state for each node, by index: Drawn, Split or culled for nodes that the selection visited;
// NotResident for the others, whose state follows from the nodes above them.
std::vector<planet::ChunkState> visitedStates(const planet::ChunkTree& tree,
                                              const planet::Selection& selection);
// Returns the state of a node from the state of its parent and its own entry of visitedStates().
planet::ChunkState stateBelow(planet::ChunkState above, planet::ChunkState visited);
// Returns the state of a node's four children if they are not resident: Requested, Loading, NotResident,
// Failed or NotInFile.
planet::ChunkState missingChildrenState(const planet::ChunkNode& node,
                                        std::span<const planet::ChunkId> loading);

// Returns the parents of the blocks that are being read.
std::vector<planet::ChunkId> loadingParents(const planet::Planet& planet);

// The data of a planet that the net and the tree list show, gathered once per frame.
struct NetData {
    const planet::ChunkTree& tree;
    std::vector<planet::ChunkState> visited;
    std::vector<planet::ChunkId> loading;
    glm::dvec3 eyeM{0, 0, 0};
    double screenScalePx = 0;  // K'
    double tauPx = 1;
    planet::ErrorMetric metric = planet::ErrorMetric::Additive;
    double nowS = 0;                    // seconds since the planet was opened
    const AtlasDrape* atlas = nullptr;  // for NetColour::Atlas; null without one
};
NetData netDataOf(const planet::Planet& planet);
double epsPxOf(const NetData& data, const planet::ChunkNode& node);

enum class NetColour : std::uint8_t { State, Level, Error, DeltaC, Age, Tight, Region, Atlas };
struct NetColouring {
    NetColour by = NetColour::State;
    double errorScale = 1;  // OverlaySettings::errorScale
    double deltaTopM = 1000;
    double ageTopS = 10;
    glm::vec3 ground{0, 0, 0};  // background of the net; chunks that are not drawn are mixed with it
};

// A rectangle in pixels. The colour is packed for ImGui, red in the lowest byte.
struct NetRect {
    float x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    std::uint32_t colour = 0;
};
// Squares smaller than this are not drawn; their parent is drawn instead.
inline constexpr double netLeastSidePx = 3;
// Refills rects with the rectangles that show the net within an area, in drawing order. A drawn chunk with
// resident children is a frame around them; children that are not resident are marks inside their quarters.
void fillNetRects(const NetData& data, const NetPlacement& placement, const Rect& area,
                  const NetColouring& colouring, std::vector<NetRect>& rects);

struct NetHit {
    planet::ChunkId id;
    planet::NodeIndex node = planet::noNode;  // none: not resident
    planet::ChunkState state = planet::ChunkState::Resident;
};
// Returns the chunk whose square, frame or mark is at a point of the screen.
std::optional<NetHit> netHit(const NetData& data, const NetPlacement& placement, double xPx, double yPx);

// Converts a line on the sphere through directions into segments on the net. No segment crosses an edge at
// which the net is cut open.
struct NetSegment {
    NetPoint from;
    NetPoint to;
};
std::vector<NetSegment> netLine(std::span<const glm::dvec3> directions);

// Returns the outline of the part of a sphere that a view shows, as a closed line of directions from the
// sphere's centre. Rays that miss the sphere give points on the horizon. Empty if the sphere is not in view.
std::vector<glm::dvec3> footprintOf(const planet::View& view, double radiusM);

struct TreeRow {
    planet::ChunkId id;
    planet::NodeIndex node = planet::noNode;  // none: not resident
    planet::ChunkState state = planet::ChunkState::Resident;
    double epsPx = 0;      // of a resident chunk
    bool canOpen = false;  // has children in the file, and is resident
    bool open = false;
};
using OpenChunks = std::unordered_set<planet::ChunkId>;
// Returns the roots, and below each chunk that is open its children. sort orders the roots, and the children
// of each chunk, by a TreeColumn; without it they are in the order of the file.
enum class TreeColumn : std::uint8_t { Chunk, Eps, State };
std::vector<TreeRow> treeRows(const NetData& data, const OpenChunks& open,
                              const std::optional<TableSort>& sort = std::nullopt);
// Opens all parents of a chunk, so that it has a row.
void openWayTo(const planet::ChunkId& id, OpenChunks& open);

}  // namespace worldy::ui
