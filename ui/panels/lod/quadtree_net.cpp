#include "ui/panels/lod/quadtree_net.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/scene/overlay_colours.h"
#include "planet/planet_tools.h"
#include "planet/select/screen_error.h"
#include "ui/model/explanation_text.h"

namespace worldy::ui {

using planet::ChunkId;
using planet::ChunkNode;
using planet::ChunkState;
using planet::NodeIndex;

namespace {

constexpr bool isCulled(ChunkState state) {
    return state == ChunkState::CulledFrustum || state == ChunkState::CulledHorizon;
}

constexpr bool isSeen(ChunkState state) {
    return state == ChunkState::Drawn || state == ChunkState::Split;
}

constexpr std::size_t shadeCount = 256;
constexpr float dimming = 0.62f;  // mix of the background into chunks that are not drawn

// All colours of a net, computed once per fill.
class NetPalette {
public:
    NetPalette(const NetData& data, const NetColouring& colouring) : data_(data), colouring_(colouring) {
        for (std::size_t i = 0; i < states_.size(); ++i) {
            states_[i] = packedColour(stateColour(static_cast<ChunkState>(i)));
        }
        for (std::size_t i = 0; i < shadeCount; ++i) {
            const glm::vec3 colour = shade(i);
            seen_[i] = packedColour(colour);
            unseen_[i] = packedColour(glm::mix(colour, colouring.ground, dimming));
        }
    }

    // Nodes are far apart in memory, and with tens of thousands of squares most of the time goes into
    // fetching them. So state and level are passed in, not read from the node.
    std::uint32_t of(NodeIndex index, int level, ChunkState state) const {
        if (colouring_.by == NetColour::State) return states_[static_cast<std::size_t>(state)];
        if (colouring_.by == NetColour::Region || colouring_.by == NetColour::Atlas) {
            const ChunkNode& node = data_.tree.nodes[index];
            const glm::vec3 colour = colouring_.by == NetColour::Region
                                         ? demandColour(data_.tree, node.demand)
                                         : atlasColour(data_.atlas, node.id);
            return packedColour(isSeen(state) ? colour : glm::mix(colour, colouring_.ground, dimming));
        }
        const std::size_t shade = colouring_.by == NetColour::Level ? static_cast<std::size_t>(level)
                                                                    : shadeOf(data_.tree.nodes[index]);
        return isSeen(state) ? seen_[shade] : unseen_[shade];
    }

    std::uint32_t ofState(ChunkState state) const { return states_[static_cast<std::size_t>(state)]; }

private:
    glm::vec3 shade(std::size_t index) const {
        const double share = static_cast<double>(index) / (shadeCount - 1);
        if (colouring_.by == NetColour::Level) return levelColour(static_cast<int>(index));
        if (colouring_.by == NetColour::Error) return errorColour(2 * share);
        return rampColour(share);
    }

    std::size_t shadeOf(const ChunkNode& node) const {
        double share = 0;
        if (colouring_.by == NetColour::Error) {
            share = epsPxOf(data_, node) / (2 * data_.tauPx * colouring_.errorScale);
        } else if (colouring_.by == NetColour::DeltaC) {
            share = deltaShare(static_cast<double>(node.deltaCM), colouring_.deltaTopM);
        } else if (colouring_.by == NetColour::Tight) {
            share = deltaShare(static_cast<double>(node.deltaTightM), colouring_.deltaTopM);
        } else {
            share = ageShare(data_.nowS - node.loadedAtS, colouring_.ageTopS);
        }
        return static_cast<std::size_t>(std::lround(std::clamp(share, 0.0, 1.0) * (shadeCount - 1)));
    }

    const NetData& data_;
    const NetColouring& colouring_;
    std::array<std::uint32_t, static_cast<std::size_t>(ChunkState::NotInFile) + 1> states_{};
    std::array<std::uint32_t, shadeCount> seen_{};
    std::array<std::uint32_t, shadeCount> unseen_{};
};

struct ScreenSquare {
    double x, y, side;

    // Returns the square of a quadrant; v points up, the screen's y down.
    ScreenSquare quarter(int quadrant) const {
        const double half = side / 2;
        return {x + ((quadrant & 1) != 0 ? half : 0), y + ((quadrant & 2) != 0 ? 0 : half), half};
    }
    ScreenSquare shrunk(double share) const {
        return {x + side * share, y + side * share, side * (1 - 2 * share)};
    }
    bool holds(double px, double py) const { return px >= x && px < x + side && py >= y && py < y + side; }
};

ScreenSquare squareOf(const NetPlacement& placement, const ChunkId& id) {
    const NetSquare square = netSquare(id);
    return {placement.originX + square.x * placement.scalePx,
            placement.originY + square.y * placement.scalePx, square.side * placement.scalePx};
}

// The frame of a drawn chunk around its resident children, on whole pixels.
struct NetFrame {
    double x0, y0, x1, y1;  // outside
    double width;

    explicit NetFrame(const ScreenSquare& square)
        : x0(std::round(square.x)),
          y0(std::round(square.y)),
          x1(std::round(square.x + square.side) - 1),
          y1(std::round(square.y + square.side) - 1),
          width(std::clamp(std::round(square.side * 0.07), 1.0, 5.0)) {}

    bool isInside(double px, double py) const {
        return px >= x0 + width && px < x1 - width && py >= y0 + width && py < y1 - width;
    }
};

// Returns the free margin around a child's mark, as a share of its quarter. Children that nobody requested
// get a small mark.
constexpr double markInset(ChunkState state) {
    return state == ChunkState::NotResident ? 0.4 : 0.27;
}
constexpr double leastMarkedSidePx = 7;   // of a quarter with a mark
constexpr double leastAbsentSidePx = 14;  // of a quarter whose mark says that nobody requested the child

bool hasMarks(ChunkState children, double quarterSidePx) {
    if (children == ChunkState::NotInFile) return false;
    return quarterSidePx >= (children == ChunkState::NotResident ? leastAbsentSidePx : leastMarkedSidePx);
}

class NetFiller {
public:
    NetFiller(const NetData& data, const Rect& area, const NetPalette& palette, std::vector<NetRect>& rects)
        : data_(data),
          palette_(palette),
          rects_(rects),
          left_(static_cast<double>(area.x)),
          top_(static_cast<double>(area.y)),
          right_(static_cast<double>(area.x + area.width)),
          bottom_(static_cast<double>(area.y + area.height)) {}

    void node(NodeIndex index, int level, const ScreenSquare& square, ChunkState above) {
        if (square.x >= right_ || square.y >= bottom_ || square.x + square.side <= left_ ||
            square.y + square.side <= top_) {
            return;
        }
        const ChunkState state = stateBelow(above, data_.visited[index]);
        if (square.side < 2 * netLeastSidePx) return fill(square, palette_.of(index, level, state));
        const ChunkNode& node = data_.tree.nodes[index];
        if (node.childrenState != planet::ChildrenState::Resident) {
            fill(square, palette_.of(index, level, state));
            return marks(node, square);
        }
        for (int q = 0; q < planet::quadrantCount; ++q) {
            this->node(node.firstChild + static_cast<NodeIndex>(q), level + 1, square.quarter(q), state);
        }
        if (state == ChunkState::Drawn) frame(square, palette_.of(index, level, state));
    }

private:
    // Fills the square on whole pixels, with a 1 px gap to the right and below if it is large enough.
    void fill(const ScreenSquare& square, std::uint32_t colour) {
        const double gap = square.side >= 2 * netLeastSidePx ? 1 : 0;
        add(std::round(square.x), std::round(square.y), std::round(square.x + square.side) - gap,
            std::round(square.y + square.side) - gap, colour);
    }

    void frame(const ScreenSquare& square, std::uint32_t colour) {
        const NetFrame f(square);
        add(f.x0, f.y0, f.x1, f.y0 + f.width, colour);
        add(f.x0, f.y1 - f.width, f.x1, f.y1, colour);
        add(f.x0, f.y0 + f.width, f.x0 + f.width, f.y1 - f.width, colour);
        add(f.x1 - f.width, f.y0 + f.width, f.x1, f.y1 - f.width, colour);
    }

    void marks(const ChunkNode& node, const ScreenSquare& square) {
        if (square.side < 2 * leastMarkedSidePx || node.childrenState == planet::ChildrenState::None) return;
        const ChunkState children = missingChildrenState(node, data_.loading);
        if (!hasMarks(children, square.side / 2)) return;
        for (int q = 0; q < planet::quadrantCount; ++q) {
            fill(square.quarter(q).shrunk(markInset(children)), palette_.ofState(children));
        }
    }

    // Clips to the area, since float precision would misplace the edges of far larger squares.
    void add(double x0, double y0, double x1, double y1, std::uint32_t colour) {
        x0 = std::max(x0, left_);
        y0 = std::max(y0, top_);
        x1 = std::min(x1, right_);
        y1 = std::min(y1, bottom_);
        if (x1 <= x0 || y1 <= y0) return;
        rects_.push_back({static_cast<float>(x0), static_cast<float>(y0), static_cast<float>(x1),
                          static_cast<float>(y1), colour});
    }

    const NetData& data_;
    const NetPalette& palette_;
    std::vector<NetRect>& rects_;
    double left_, top_, right_, bottom_;
};

double apart(const NetPoint& a, const NetPoint& b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

// Longer segments are halved. A segment that is still longer after mostHalvings halvings crosses an edge at
// which the net is cut open, and is left out.
constexpr double longestPiece = 0.03;
constexpr int mostHalvings = 12;

void appendLine(const glm::dvec3& from, const glm::dvec3& to, int halvings, std::vector<NetSegment>& out) {
    const NetPoint a = netPointOfDirection(from);
    const NetPoint b = netPointOfDirection(to);
    if (apart(a, b) <= longestPiece) {
        out.push_back({a, b});
        return;
    }
    const glm::dvec3 middle = from + to;
    if (halvings == mostHalvings || glm::dot(middle, middle) < 1e-12) return;
    appendLine(from, glm::normalize(middle), halvings + 1, out);
    appendLine(glm::normalize(middle), to, halvings + 1, out);
}

struct SphereRay {
    glm::dvec3 direction;  // from the sphere's centre, unit length
    bool hits = false;     // false: the direction is on the horizon
};

SphereRay meetSphere(const glm::dvec3& eyeM, const glm::dvec3& ray, double radiusM) {
    const double along = glm::dot(eyeM, ray);
    const double root = along * along - (glm::dot(eyeM, eyeM) - radiusM * radiusM);
    if (root >= 0 && along < 0) return {glm::normalize(eyeM + (-along - std::sqrt(root)) * ray), true};
    const double distance = glm::length(eyeM);
    const glm::dvec3 up = eyeM / distance;
    glm::dvec3 aside = ray - glm::dot(ray, up) * up;
    const double length = glm::length(aside);
    if (length < 1e-9) return {up, false};
    aside /= length;
    const double cosine = radiusM / distance;
    return {cosine * up + std::sqrt(std::max(0.0, 1 - cosine * cosine)) * aside, false};
}

// Returns points along the border of the picture, anticlockwise, x and y in [-1, 1].
std::vector<std::pair<double, double>> borderPoints(int perSide) {
    std::vector<std::pair<double, double>> points;
    for (int i = 0; i < perSide; ++i) points.emplace_back(-1 + 2.0 * i / perSide, -1);
    for (int i = 0; i < perSide; ++i) points.emplace_back(1, -1 + 2.0 * i / perSide);
    for (int i = 0; i < perSide; ++i) points.emplace_back(1 - 2.0 * i / perSide, 1);
    for (int i = 0; i < perSide; ++i) points.emplace_back(-1, 1 - 2.0 * i / perSide);
    return points;
}

TreeRow residentRow(const NetData& data, NodeIndex index, ChunkState above, const OpenChunks& open) {
    const ChunkNode& node = data.tree.nodes[index];
    TreeRow row{.id = node.id, .node = index};
    row.state = stateBelow(above, data.visited[index]);
    row.epsPx = epsPxOf(data, node);
    row.canOpen = node.childrenState != planet::ChildrenState::None;
    row.open = row.canOpen && open.contains(node.id);
    return row;
}

std::vector<TreeRow> childRows(const NetData& data, const TreeRow& parent, const OpenChunks& open) {
    const ChunkNode& node = data.tree.nodes[parent.node];
    const bool resident = node.childrenState == planet::ChildrenState::Resident;
    std::vector<TreeRow> rows;
    for (int q = 0; q < planet::quadrantCount; ++q) {
        if (resident)
            rows.push_back(
                residentRow(data, node.firstChild + static_cast<NodeIndex>(q), parent.state, open));
        else
            rows.push_back({.id = childOf(node.id, q), .state = missingChildrenState(node, data.loading)});
    }
    return rows;
}

SortKey sortKeyOf(const TreeRow& row, TreeColumn column) {
    switch (column) {
        case TreeColumn::Chunk:
            return sortKey(row.id);
        case TreeColumn::State:
            return std::string(stateText(row.state));
        case TreeColumn::Eps:
            break;
    }
    return row.node == planet::noNode ? -1.0 : row.epsPx;
}

void appendRows(const NetData& data, const std::vector<TreeRow>& siblings, const OpenChunks& open,
                const std::optional<TableSort>& sort, std::vector<TreeRow>& rows) {
    const auto key = [&](std::size_t row, std::size_t column) {
        return sortKeyOf(siblings[row], static_cast<TreeColumn>(column));
    };
    for (const std::size_t i : tableOrder(siblings.size(), sort, key)) {
        rows.push_back(siblings[i]);
        if (siblings[i].open) appendRows(data, childRows(data, siblings[i], open), open, sort, rows);
    }
}

}  // namespace

NetPoint netPoint(const planet::FacePoint& point) {
    const NetCell& cell = cellOf(point.face);
    return {cell.column + (point.u + 1) / 2, cell.row + (1 - point.v) / 2};
}

NetPoint netPointOfDirection(const glm::dvec3& direction) {
    return netPoint(planet::facePointFromDirection(direction));
}

std::optional<planet::FacePoint> facePointOnNet(const NetPoint& point) {
    for (const planet::Face face : planet::allFaces) {
        const NetCell& cell = cellOf(face);
        const double x = point.x - cell.column;
        const double y = point.y - cell.row;
        if (x >= 0 && x < 1 && y >= 0 && y < 1) return planet::FacePoint{face, 2 * x - 1, 1 - 2 * y};
    }
    return std::nullopt;
}

NetFocus centredOn(const NetFocus& focus, const Rect& area, const ChunkId& id, double leastSidePx) {
    const NetSquare square = netSquare(id);
    const NetPoint middle{square.x + square.side / 2, square.y + square.side / 2};
    return centredOn(netSize, focus, area, middle, square.side, leastSidePx);
}

std::vector<ChunkState> visitedStates(const planet::ChunkTree& tree, const planet::Selection& selection) {
    constexpr std::array fates = {ChunkState::Drawn, ChunkState::Split, ChunkState::CulledFrustum,
                                  ChunkState::CulledHorizon};
    std::vector<ChunkState> states(tree.nodes.size(), ChunkState::NotResident);
    for (const planet::VisitedNode& visited : selection.touched) {
        // The selection may be older than the tree: paging may have evicted nodes since.
        if (visited.node < states.size())
            states[visited.node] = fates[static_cast<std::size_t>(visited.fate)];
    }
    return states;
}

ChunkState stateBelow(ChunkState above, ChunkState visited) {
    if (visited != ChunkState::NotResident) return visited;
    return isCulled(above) ? above : ChunkState::Resident;
}

ChunkState missingChildrenState(const ChunkNode& node, std::span<const ChunkId> loading) {
    switch (node.childrenState) {
        case planet::ChildrenState::None:
            return ChunkState::NotInFile;
        case planet::ChildrenState::Requested:
            return std::find(loading.begin(), loading.end(), node.id) != loading.end()
                       ? ChunkState::Loading
                       : ChunkState::Requested;
        case planet::ChildrenState::AwaitingRetry:
        case planet::ChildrenState::Failed:
            return ChunkState::Failed;
        case planet::ChildrenState::Absent:
        case planet::ChildrenState::Resident:
            break;
    }
    return ChunkState::NotResident;
}

std::vector<ChunkId> loadingParents(const planet::Planet& planet) {
    std::vector<ChunkId> parents;
    for (const planet::LoadInProgress& load : planet.inspect().loadingNow()) parents.push_back(load.parent);
    return parents;
}

NetData netDataOf(const planet::Planet& planet) {
    const planet::View& lodView = planet.views()[0].input.lodView;
    return {.tree = planet.tree(),
            .visited = visitedStates(planet.tree(), planet.selection()),
            .loading = loadingParents(planet),
            .eyeM = lodView.eyeM,
            .screenScalePx = screenScalePx(lodView),
            .tauPx = planet.views()[0].input.lod.tauPx,
            .metric = planet.views()[0].input.lod.metric,
            .nowS = planet.lastStep().nowS};
}

double epsPxOf(const NetData& data, const ChunkNode& node) {
    return planet::epsPxOf(node, data.eyeM, data.screenScalePx, data.metric);
}

void fillNetRects(const NetData& data, const NetPlacement& placement, const Rect& area,
                  const NetColouring& colouring, std::vector<NetRect>& rects) {
    rects.clear();
    const NetPalette palette(data, colouring);
    NetFiller filler(data, area, palette, rects);
    for (NodeIndex root = 0; root < planet::faceCount; ++root) {
        filler.node(root, 0, squareOf(placement, data.tree.nodes[root].id), ChunkState::Resident);
    }
}

std::optional<NetHit> netHit(const NetData& data, const NetPlacement& placement, double xPx, double yPx) {
    const std::optional<planet::FacePoint> point = facePointOnNet(onPlan(placement, xPx, yPx));
    if (!point) return std::nullopt;
    auto index = static_cast<NodeIndex>(point->face);
    ChunkState above = ChunkState::Resident;
    for (;;) {
        const ChunkNode& node = data.tree.nodes[index];
        const ScreenSquare square = squareOf(placement, node.id);
        const NetHit hit{node.id, index, stateBelow(above, data.visited[index])};
        if (square.side < 2 * netLeastSidePx || node.childrenState == planet::ChildrenState::None) return hit;
        const ChunkId child = chunkAt(*point, node.id.level + 1);
        const ScreenSquare quarter = square.quarter(quadrantOf(child));
        if (node.childrenState != planet::ChildrenState::Resident) {
            const ChunkState state = missingChildrenState(node, data.loading);
            if (!hasMarks(state, quarter.side) || !quarter.shrunk(markInset(state)).holds(xPx, yPx))
                return hit;
            return NetHit{child, planet::noNode, state};
        }
        if (hit.state == ChunkState::Drawn && !NetFrame(square).isInside(xPx, yPx)) return hit;
        above = hit.state;
        index = node.firstChild + static_cast<NodeIndex>(quadrantOf(child));
    }
}

std::vector<NetSegment> netLine(std::span<const glm::dvec3> directions) {
    std::vector<NetSegment> segments;
    for (std::size_t i = 1; i < directions.size(); ++i) {
        appendLine(glm::normalize(directions[i - 1]), glm::normalize(directions[i]), 0, segments);
    }
    return segments;
}

std::vector<glm::dvec3> footprintOf(const planet::View& view, double radiusM) {
    const double radius = std::min(radiusM, 0.999999 * glm::length(view.eyeM));
    const double tanX = std::tan(view.horizontalFovRad / 2);
    const double tanY = tanX * view.heightPx / view.widthPx;
    std::vector<glm::dvec3> outline;
    bool anyHit = false;
    for (const auto& [x, y] : borderPoints(16)) {
        const glm::dvec3 ray = glm::normalize(x * tanX * view.right + y * tanY * view.up - view.back);
        const SphereRay met = meetSphere(view.eyeM, ray, radius);
        anyHit = anyHit || met.hits;
        outline.push_back(met.direction);
    }
    // No border ray hits the sphere: it is wholly inside the picture or outside it.
    if (!anyHit) {
        for (const planet::Plane& plane : frustumOf(view)) {
            if (plane.offsetM < 0) return {};
        }
    }
    outline.push_back(outline.front());
    return outline;
}

std::vector<TreeRow> treeRows(const NetData& data, const OpenChunks& open,
                              const std::optional<TableSort>& sort) {
    std::vector<TreeRow> roots;
    for (NodeIndex root = 0; root < planet::faceCount; ++root)
        roots.push_back(residentRow(data, root, ChunkState::Resident, open));
    std::vector<TreeRow> rows;
    appendRows(data, roots, open, sort, rows);
    return rows;
}

void openWayTo(const ChunkId& id, OpenChunks& open) {
    ChunkId at = id;
    while (at.level > 0) {
        at = parentOf(at);
        open.insert(at);
    }
}

}  // namespace worldy::ui
