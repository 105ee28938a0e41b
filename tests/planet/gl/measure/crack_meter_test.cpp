#include "planet/gl/measure/crack_meter.h"

#include <algorithm>
#include <glm/common.hpp>
#include <set>
#include <utility>

#include "planet/select/drawn_surface.h"
#include "tests/planet/gl/mixed_levels.h"
#include "tests/support/sudden_lod.h"

namespace planet::gl {
namespace {

LodSettings seamSettings(SeamMode seams, bool morph, double tauPx = 2) {
    LodSettings settings = suddenLod();
    settings.tauPx = tauPx;
    settings.seams = seams;
    settings.morph = morph;
    return settings;
}

class CrackMeter : public GlTest {
protected:
    CrackMeter() { target_.bind(); }
    RenderTarget target_ = valueOf(RenderTarget::create(8, 8));  // a context alone has nothing to draw into
    std::mt19937 random_{11};
};

TEST_F(CrackMeter, OneLevelEverywhereReadsZero) {
    MixedLevels planet = MixedLevels::whole();
    LodSettings settings = seamSettings(SeamMode::Skirts, false, 1e-6);
    settings.maxLevel = 2;
    for (int i = 0; i < 30; ++i) {
        const View view = planet.viewFromAbove(random_, 160, 100);
        const std::vector<DrawItem> items = planet.select(view, settings);
        const CrackMap map = planet.measure(view, items, false);
        EXPECT_EQ(map.pixels.size(), 0u) << i;
        EXPECT_EQ(map.leaking, 0) << i;
    }
}

TEST_F(CrackMeter, StitchedWithoutSkirtsReadsZero) {
    std::set<std::pair<int, bool>> met;  // difference of levels, and whether across faces
    for (const unsigned seed : {1u, 2u, 3u}) {
        MixedLevels planet = MixedLevels::patchy(seed);
        for (int i = 0; i < 12; ++i) {
            const View view =
                i < 4 ? planet.viewFromAbove(random_, 160, 100) : planet.seamView(random_, 160, 100);
            const std::vector<DrawItem> items =
                planet.select(view, seamSettings(SeamMode::Stitched, i % 2 == 0, i % 3 == 0 ? 0.01 : 4));
            EXPECT_EQ(planet.measure(view, items, true).pixels.size(), 0u) << seed << " " << i;
            for (const DrawnPair& pair : drawnPairs(items)) {
                const ChunkId& finer = items[pair.finer].id;
                const ChunkId& coarser = items[pair.coarser].id;
                met.insert({finer.level - coarser.level, finer.face != coarser.face});
            }
        }
    }
    for (const int levels : {0, 1, 2, 3}) {
        for (const bool acrossFaces : {false, true})
            EXPECT_TRUE(met.contains({levels, acrossFaces})) << levels << acrossFaces;
    }
}

TEST_F(CrackMeter, AutomaticSkirtsLeakNothing) {
    std::size_t cracks = 0;
    for (const unsigned seed : {4u, 5u}) {
        MixedLevels planet = MixedLevels::patchy(seed);
        for (int i = 0; i < 30; ++i) {
            const View view =
                i < 4 ? planet.viewFromAbove(random_, 200, 125) : planet.seamView(random_, 200, 125);
            const std::vector<DrawItem> items =
                planet.select(view, seamSettings(SeamMode::Skirts, i % 2 == 0, i % 3 == 0 ? 1 : 4));
            const CrackMap map = planet.measure(view, items, false);
            EXPECT_EQ(map.leaking, 0) << seed << " " << i;
            cracks += map.pixels.size();
        }
    }
    EXPECT_GT(cracks, 200u) << "what the skirts hide";
}

std::set<std::pair<int, int>> crackPlaces(const CrackMap& map) {
    std::set<std::pair<int, int>> places;
    for (const CrackPixel& pixel : map.pixels) places.insert({pixel.x, pixel.y});
    return places;
}

TEST_F(CrackMeter, EveryCrackLeaksWithoutSkirts) {
    MixedLevels planet = MixedLevels::patchy(6);
    std::size_t cracks = 0;
    for (int i = 0; i < 20; ++i) {
        const View view = planet.seamView(random_, 160, 100);
        const std::vector<DrawItem> items = planet.select(view, seamSettings(SeamMode::None, i % 2 == 0));
        const CrackMap map = planet.measure(view, items, false);
        EXPECT_EQ(static_cast<std::size_t>(map.leaking), map.pixels.size());
        EXPECT_TRUE(std::ranges::all_of(map.pixels, &CrackPixel::leaks));
        EXPECT_EQ(crackPlaces(map).size(), map.pixels.size()) << "a pixel twice";
        cracks += map.pixels.size();
    }
    EXPECT_GT(cracks, 50u);
}

// A view that looks at a place from a direction's side: low, from beyond the other chunk.
View lookingAt(const glm::dvec3& placeM, const glm::dvec3& fromM, double distanceM) {
    const glm::dvec3 up = glm::normalize(placeM);
    const glm::dvec3 back = glm::normalize(glm::normalize(fromM - placeM) + 0.35 * up);
    View view;
    view.eyeM = placeM + distanceM * back;
    view.back = back;
    view.right = glm::normalize(glm::cross(up, back));
    view.up = glm::cross(back, view.right);
    view.widthPx = 400;
    view.heightPx = 300;
    return view;
}

// A planet, all of it drawn and stitched so that nothing parts, and a pair of which the finer one is given a
// fault.
struct Planted {
    std::vector<DrawItem> items;
    DrawnPair pair;
    int column = 0;  // of the vertex in the middle of the edge
    int row = 0;
    glm::dvec3 placeM{0, 0, 0};  // where it was
    // It and the vertices beside it on the edge as drawn, before and after.
    std::vector<glm::dvec3> cornersM;
    View view;
};

glm::dvec2 pixelOf(const View& view, const glm::dvec3& placeM) {
    const glm::dvec3 fromEye = placeM - view.eyeM;
    const double scale = screenScalePx(view) / -glm::dot(fromEye, view.back);
    return {view.widthPx / 2.0 + scale * glm::dot(fromEye, view.right),
            view.heightPx / 2.0 - scale * glm::dot(fromEye, view.up)};
}

// Nothing where the planet has no such pair.
std::optional<Planted> plant(MixedLevels& planet, int levels, bool acrossFaces, std::int16_t steps) {
    LodSettings settings = seamSettings(SeamMode::Stitched, false, 0.01);
    settings.frustumCulling = settings.horizonCulling = false;
    const PlanetShape& shape = planet.tree().shape;
    const View above =
        viewFromPose({.latitudeDeg = 10, .longitudeDeg = 40, .altitudeM = 2e5}, shape.radiusM, 1, 400, 300);
    Planted made;
    made.items = planet.select(above, settings);
    bool found = false;
    for (const DrawnPair& pair : drawnPairs(made.items)) {
        const ChunkId& finer = made.items[pair.finer].id;
        const ChunkId& coarser = made.items[pair.coarser].id;
        if (finer.level - coarser.level != levels || (finer.face != coarser.face) != acrossFaces) continue;
        made.pair = pair;
        found = true;
        break;
    }
    if (!found) return std::nullopt;
    const int cells = chunkCells(shape);
    const Edge edge = made.pair.finerEdge;
    made.column = edge == Edge::West ? 0 : edge == Edge::East ? cells : cells / 2;
    made.row = edge == Edge::South ? 0 : edge == Edge::North ? cells : cells / 2;
    const DrawItem& finer = made.items[made.pair.finer];
    const ChunkNode& node = planet.tree().nodes[finer.node];
    made.placeM = drawnVertex(shape, finer, *node.heights, true, made.column, made.row).positionM;
    const ChunkId& coarser = made.items[made.pair.coarser].id;
    const FaceSquare square = faceSquareOf(coarser);
    const glm::dvec3 middle =
        sphereFromCube(cubePoint(coarser.face, square.u + square.side / 2, square.v + square.side / 2));
    made.view = lookingAt(made.placeM, (shape.radiusM + 8000) * middle, 12000);
    const bool upright = edge == Edge::West || edge == Edge::East;
    const auto addCorners = [&] {
        for (const int beside : {-(1 << levels), 0, 1 << levels}) {
            const int column = made.column + (upright ? 0 : beside);
            const int row = made.row + (upright ? beside : 0);
            made.cornersM.push_back(
                drawnVertex(shape, finer, *planet.tree().nodes[finer.node].heights, true, column, row)
                    .positionM);
        }
    };
    addCorners();
    planet.moveVertex(finer.node, made.column, made.row, steps);
    addCorners();
    return made;
}

TEST_F(CrackMeter, AMovedVertexIsAGapOfItsHeightAndACrackThereOnly) {
    for (const auto& [levels, acrossFaces, seed] :
         {std::tuple{1, false, 7u}, {1, true, 8u}, {2, false, 8u}, {3, true, 7u}}) {
        MixedLevels planet = MixedLevels::patchy(seed);
        const std::int16_t steps = 2000;
        const double heightM = steps * planet.tree().shape.quantumM;
        const std::optional<Planted> found = plant(planet, levels, acrossFaces, steps);
        ASSERT_TRUE(found) << levels << acrossFaces;
        const Planted& planted = *found;
        const auto pairs = drawnPairs(planted.items);
        const auto gaps = edgeGaps(planet.ground(planted.items, true), pairs, planted.view);
        EXPECT_NEAR(gaps[0].gapM, heightM, 0.02 * heightM);
        EXPECT_NEAR(gaps[0].finerAboveM, heightM, 0.02 * heightM);
        EXPECT_EQ(gaps[0].coarserAboveM, 0);
        EXPECT_EQ(gaps[0].pair.finer, planted.pair.finer);
        EXPECT_EQ(gaps[0].pair.coarser, planted.pair.coarser);
        EXPECT_LT(glm::length(gaps[0].placeM - planted.placeM), 1.01 * heightM);
        const glm::dvec3 was = glm::normalize(planted.cornersM[1] - planted.view.eyeM);
        const glm::dvec3 is = glm::normalize(planted.cornersM[4] - planted.view.eyeM);
        EXPECT_NEAR(gaps[0].facingPx, std::acos(glm::dot(was, is)) * screenScalePx(planted.view), 0.1);
        EXPECT_EQ(gaps[1].gapM, 0) << toString(gaps[1].finer) << " " << toString(gaps[1].coarser);

        const CrackMap map = planet.measure(planted.view, planted.items, true);
        ASSERT_GT(map.pixels.size(), 20u) << levels << acrossFaces;
        EXPECT_EQ(static_cast<std::size_t>(map.leaking), map.pixels.size()) << "stitched: there is no skirt";
        for (const CrackPixel& pixel : map.pixels) {
            EXPECT_EQ(pixel.item, planted.pair.finer) << "the higher one's skirt shows";
            ASSERT_NE(pixel.pair, noPair);
            EXPECT_EQ(pairs[pixel.pair].finer, planted.pair.finer);
            EXPECT_EQ(pairs[pixel.pair].coarser, planted.pair.coarser);
        }
        glm::dvec2 low(1e9);
        glm::dvec2 high(-1e9);
        for (const glm::dvec3& corner : planted.cornersM) {
            low = glm::min(low, pixelOf(planted.view, corner));
            high = glm::max(high, pixelOf(planted.view, corner));
        }
        const auto spots = crackSpots(map.pixels, map.widthPx, map.heightPx);
        for (const CrackSpot& spot : spots) {
            EXPECT_GE(spot.from.x, low.x - 1);
            EXPECT_GE(spot.from.y, low.y - 1);
            EXPECT_LE(spot.to.x, high.x + 1);
            EXPECT_LE(spot.to.y, high.y + 1);
        }
        // As high as the vertex was moved, where it was.
        const glm::dvec2 before = pixelOf(planted.view, planted.cornersM[1]);
        const glm::dvec2 after = pixelOf(planted.view, planted.cornersM[4]);
        EXPECT_NEAR(gaps[0].screenPx, glm::length(after - before), 0.1);
        const auto inItsColumn = std::count_if(map.pixels.begin(), map.pixels.end(), [&](const auto& pixel) {
            return pixel.x == static_cast<int>(before.x);
        });
        // Where it is lowest a classic depth buffer cannot tell it from what lies behind it.
        EXPECT_NEAR(static_cast<double>(inItsColumn), before.y - after.y, hasClipControl() ? 2 : 4);
    }
}

TEST_F(CrackMeter, ASkirtCutShortLeaksBesideItsChunkOnly) {
    MixedLevels planet = MixedLevels::patchy(8);
    int cut = 0;
    for (int i = 0; i < 8; ++i) {
        const View view = planet.seamView(random_, 240, 160);
        std::vector<DrawItem> items = planet.select(view, seamSettings(SeamMode::Skirts, i % 2 == 0, 4));
        const CrackMap before = planet.measure(view, items, false);
        ASSERT_EQ(before.leaking, 0);
        std::vector<int> pixelsOf(items.size(), 0);
        for (const CrackPixel& pixel : before.pixels) ++pixelsOf[pixel.item];
        ASSERT_FALSE(items.empty());
        const auto most = std::max_element(pixelsOf.begin(), pixelsOf.end());
        if (*most < 5) continue;
        const auto victim = static_cast<std::uint32_t>(most - pixelsOf.begin());
        items[victim].skirtDepthM = 0;
        const CrackMap after = planet.measure(view, items, false);
        EXPECT_EQ(after.pixels.size(), before.pixels.size()) << "cracks do not depend on the skirts as set";
        EXPECT_EQ(after.leaking, *most);
        const auto pairs = drawnPairs(items);
        for (const CrackPixel& pixel : after.pixels) {
            EXPECT_EQ(pixel.leaks, pixel.item == victim);
            if (!pixel.leaks || pixel.pair == noPair) continue;
            EXPECT_TRUE(pairs[pixel.pair].finer == victim || pairs[pixel.pair].coarser == victim);
        }
        ++cut;
    }
    EXPECT_GE(cut, 3);
}

// Rays through pixels' centres against every triangle that faces the eye, in doubles and without anything of
// the meter's.
class RayCaster {
public:
    RayCaster(const DrawnGround& ground, const View& view, double shellDepthM)
        : view_(view), scalePx_(screenScalePx(view)) {
        for (const DrawItem& item : ground.items) {
            const DrawnGrid grid = drawnGrid(ground.shape, item, ground.heights(item), ground.stitched);
            addChunk(grid, shellDepthM);
        }
    }

    // The first thing seen, metres along the ray; infinity: nothing.
    double cast(double xPx, double yPx, bool withWalls) const {
        const glm::dvec3 ray =
            glm::normalize((xPx - view_.widthPx / 2.0) / scalePx_ * view_.right +
                           (view_.heightPx / 2.0 - yPx) / scalePx_ * view_.up - view_.back);
        double nearest = std::numeric_limits<double>::infinity();
        for (const Chunk& chunk : chunks_) {
            const double along = glm::dot(chunk.middle, ray);
            const double aside = glm::dot(chunk.middle, chunk.middle) - along * along;
            if (aside > chunk.radius * chunk.radius) continue;
            const std::size_t count = withWalls ? chunk.corners.size() : chunk.groundCorners;
            for (std::size_t i = 0; i < count; i += 3)
                nearest =
                    std::min(nearest, hit(ray, chunk.corners[i], chunk.corners[i + 1], chunk.corners[i + 2]));
        }
        return nearest;
    }

private:
    struct Chunk {
        std::vector<glm::dvec3> corners;  // from the eye, three a triangle, the ground's first
        std::size_t groundCorners = 0;
        glm::dvec3 middle{0, 0, 0};
        double radius = 0;
    };

    static double hit(const glm::dvec3& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        const double none = std::numeric_limits<double>::infinity();
        const glm::dvec3 ab = b - a;
        const glm::dvec3 ac = c - a;
        const double facing = -glm::dot(glm::cross(ab, ac), ray);
        if (facing <= 0) return none;
        const glm::dvec3 turned = glm::cross(-a, ray);
        const double toB = glm::dot(ac, turned) / facing;
        const double toC = -glm::dot(ab, turned) / facing;
        if (toB < 0 || toC < 0 || toB + toC > 1) return none;
        const double along = -glm::dot(-a, glm::cross(ab, ac)) / -facing;
        return along > 0 ? along : none;
    }

    void addChunk(const DrawnGrid& grid, double shellDepthM) {
        const int side = grid.cells + 1;
        const auto at = [&](int column, int row) {
            return grid.positionM[static_cast<std::size_t>(row * side + column)];
        };
        Chunk chunk;
        const auto add = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
            for (const glm::dvec3& corner : {a, b, c}) chunk.corners.push_back(corner - view_.eyeM);
        };
        for (int row = 0; row < grid.cells; ++row) {
            for (int column = 0; column < grid.cells; ++column) {
                add(at(column, row), at(column + 1, row), at(column + 1, row + 1));
                add(at(column, row), at(column + 1, row + 1), at(column, row + 1));
            }
        }
        chunk.groundCorners = chunk.corners.size();
        const auto wall = [&](const glm::dvec3& top, const glm::dvec3& next) {
            const glm::dvec3 under = top * (1 - shellDepthM / glm::length(top));
            const glm::dvec3 underNext = next * (1 - shellDepthM / glm::length(next));
            add(under, underNext, next);
            add(under, next, top);
        };
        const int last = grid.cells;
        for (int i = 0; i < last; ++i) {
            wall(at(i, 0), at(i + 1, 0));
            wall(at(last, i), at(last, i + 1));
            wall(at(i + 1, last), at(i, last));
            wall(at(0, i + 1), at(0, i));
        }
        for (const glm::dvec3& corner : chunk.corners) chunk.middle += corner;
        chunk.middle /= static_cast<double>(chunk.corners.size());
        for (const glm::dvec3& corner : chunk.corners)
            chunk.radius = std::max(chunk.radius, glm::length(corner - chunk.middle));
        chunks_.push_back(std::move(chunk));
    }

    View view_;
    double scalePx_;
    std::vector<Chunk> chunks_;
};

// 1 a crack, 0 none, -1 it depends on where within a few hundredths of a pixel one looks.
int verdict(const RayCaster& rays, int x, int y) {
    int cracks = 0;
    for (const glm::dvec2 aside : {glm::dvec2(0, 0), {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}) {
        const glm::dvec2 at = glm::dvec2(x + 0.5, y + 0.5) + aside * 0.02;
        const double closed = rays.cast(at.x, at.y, true);
        const double open = rays.cast(at.x, at.y, false);
        cracks += closed * (1 + 1e-9) < open;
    }
    return cracks == 0 ? 0 : cracks == 5 ? 1 : -1;
}

TEST_F(CrackMeter, CrackPixelsAreWhereRaysInDoublesSeeThem) {
    MixedLevels planet = MixedLevels::patchy(9);
    int certainCracks = 0;
    int certainGround = 0;
    int uncertain = 0;
    for (int i = 0; i < 20; ++i) {
        const View view = planet.seamView(random_, 160, 100);
        const std::vector<DrawItem> items = planet.select(view, seamSettings(SeamMode::None, i % 2 == 0, 4));
        const CrackMap map = planet.measure(view, items, false);
        const std::set<std::pair<int, int>> cracks = crackPlaces(map);
        const RayCaster rays(planet.ground(items, false), view, innerShellDepthM(planet.tree()));
        const auto compare = [&](int x, int y) {
            const int expected = verdict(rays, x, y);
            if (expected < 0) {
                ++uncertain;
                return;
            }
            EXPECT_EQ(cracks.contains({x, y}) ? 1 : 0, expected)
                << "view " << i << " pixel " << x << " " << y;
            ++(expected == 1 ? certainCracks : certainGround);
        };
        // All that are marked, up to a number; what lies beside them; and any.
        const std::size_t every = std::max<std::size_t>(map.pixels.size() / 25, 1);
        for (std::size_t p = 0; p < map.pixels.size(); p += every) {
            compare(map.pixels[p].x, map.pixels[p].y);
            compare(std::min(map.pixels[p].x + 1, 159), map.pixels[p].y);
            compare(map.pixels[p].x, std::min(map.pixels[p].y + 1, 99));
        }
        for (int any = 0; any < 40; ++any)
            compare(static_cast<int>(random_() % 160), static_cast<int>(random_() % 100));
    }
    EXPECT_GT(certainCracks, 50);
    EXPECT_GT(certainGround, 300);
    EXPECT_LT(uncertain, certainCracks + certainGround);
}

TEST_F(CrackMeter, LeavesTheFramebuffersAndTheViewportAsTheyWere) {
    MixedLevels planet = MixedLevels::patchy(10);
    const View view = planet.viewFromAbove(random_, 64, 48);
    target_.bind();
    glViewport(1, 2, 3, 4);
    planet.measure(view, planet.select(view, seamSettings(SeamMode::Skirts, false)), false);
    GLint framebuffer = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
    EXPECT_EQ(static_cast<GLuint>(framebuffer), target_.framebuffer());
    GLint viewport[4] = {};
    glGetIntegerv(GL_VIEWPORT, viewport);
    EXPECT_EQ(viewport[0], 1);
    EXPECT_EQ(viewport[3], 4);
}

}  // namespace
}  // namespace planet::gl
