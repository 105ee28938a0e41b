// The bound of the drawn surface, pixels: its largest possible distance from the finest data, with the morph
// of the chunk, the morphs of its edges, and stitched edges. eps bounds the chunk's own surface only; without
// morph and stitched edges the two are equal.
//
// A chunk has the error delta and the morph m, its parent the error delta_P; s is the farthest that a vertex
// slides at morph 1. A vertex is a finest sample, so s <= delta_P; by the additive metric delta_P is at least
// the parent's own step plus delta, so s <= delta_P - delta.
//
//   inside          (1 - m) eps + m eps_P      since each point is drawn so far on the way from the chunk's
//                                              surface to its parent's; eps_P is the parent's own eps, or
//                                              delta_P K' / D where that is less: only what the chunk covers
//                                              is seen, and it is no nearer than D
//   along an edge   an edge e has a morph m_e of its own. Its vertices lie on the chunk beside it too, so s_e
//   is
//                   at most s, at most the same of a neighbour of the chunk's level, and at most the delta of
//                   a coarser neighbour; and they are no nearer than that chunk. So what lies in the cells
//                   along the edge is at least D_e = max(D, D of the neighbour - L) away, L being the
//                   farthest that two points of a cell are apart. A triangle there mixes vertices of the edge
//                   with others, so the smaller of two bounds holds:
//                     ((1 - m) delta + m delta_P + |m_e - m| s_e) K' / D_e
//                     (delta + max(m s, m_e s_e)) K' / D_e
//
// D is the distance to the chunk's box, or nearestSampleM if that is larger. The box of a large chunk reaches
// far above its ground and below it, and may hold an eye that is kilometres away from any sample.
//
// Along an edge that is stitched to a coarser chunk, a triangle has two of that chunk's vertices and one of
// its own, so both errors are added; while vertices are gathered (drawn_surface.h), s_e is added again. This
// is not a proven bound in those cells, because their triangles reach over several cells of the chunk, which
// no delta_c measures.
//
// Pure functions, any thread.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "planet/select/lod_types.h"
#include "planet/sphere/planet_shape.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

inline constexpr std::uint32_t noNeighbour = ~std::uint32_t{0};

// The drawn neighbours by edge, west to north: the index of a chunk of the same level or coarser, or
// noNeighbour.
using DrawnNeighbours = std::array<std::uint32_t, edgeCount>;

// Returns L above, metres: no two points of one of the chunk's cells, drawn or true, are farther apart.
double cellSpanM(const PlanetShape& shape, const ChunkNode& node);

// Returns a distance that no finest sample of the chunk is nearer than, metres: by its range of heights, and
// of a leaf nearer than cellSpanM by its samples.
double nearestSampleM(const PlanetShape& shape, const ChunkNode& node, const glm::dvec3& eyeM);

// Fills DrawItem::drawnBoundPx. cellSpansM: L of each item, infinity where it is not known. screenScalePx:
// K'. stitched: drawn with RenderSettings::stitched.
void fillDrawnBounds(std::span<DrawItem> items, std::span<const DrawnNeighbours> neighbours,
                     std::span<const double> cellSpansM, double screenScalePx, ErrorMetric metric,
                     bool stitched);
// Does the same for items in any order; looks up their neighbours among them.
void fillDrawnBounds(std::span<DrawItem> items, std::span<const double> cellSpansM, double screenScalePx,
                     ErrorMetric metric, bool stitched);

}  // namespace planet
