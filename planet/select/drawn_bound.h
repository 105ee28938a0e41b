// The bound of the drawn surface, pixels: an upper bound of its distance from the finest data, including the
// morph of the chunk, the morphs of its edges, and stitched edges. ε bounds the chunk's own surface only;
// without morph and stitched edges the two are equal.
//
// Let a chunk have the error δ and the morph m, and its parent the error δ_P. Let s be the longest slide of a
// vertex at morph 1. Vertices are finest samples, so s <= δ_P. With the additive metric, δ_P is at least the
// parent's own step plus δ, so s <= δ_P - δ.
//
//   inside          (1 - m) ε + m ε_P
//                   Each drawn point is a share m of the way from the chunk's surface to its parent's. ε_P is
//                   the parent's ε, or δ_P K' / D if that is less, because only the chunk's part is visible,
//                   and it is no nearer than D.
//   along an edge   An edge e has its own morph m_e. Its vertices also lie on the neighbour, so their slide
//                   s_e is at most s, at most the s of a neighbour of the same level, and at most the δ of
//                   a coarser neighbour, or of the data beside it if that is finer (rimDeltaM); and they are
//                   no nearer than the neighbour. So everything in the
//                   cells along the edge is at least D_e = max(D, D of the neighbour - L) away, where L is
//                   the largest distance of two points of a cell. A triangle there mixes vertices of the
//                   edge with others, so the smaller of two bounds holds:
//                     ((1 - m) δ + m δ_P + |m_e - m| s_e) K' / D_e
//                     (δ + max(m s, m_e s_e)) K' / D_e
//
// D is the distance to the chunk's box, or nearestSampleM if that is larger. The box of a large chunk extends
// far above and below its ground, and may contain an eye that is kilometres away from any sample.
//
// Along an edge that is stitched to a coarser chunk, a triangle has two of that chunk's vertices and one of
// its own, so both errors are added. The error of the coarser edge is that against the data on this side.
// While vertices are gathered (drawn_surface.h), s_e is added again. In these cells this is not a proven
// bound, because their triangles extend over several cells of the chunk, which no δc measures.
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

// Returns L above, metres: an upper bound of the distance of two points of one cell, drawn or true.
double cellSpanM(const PlanetShape& shape, const ChunkNode& node);

// Returns a lower bound of the distance to the chunk's finest samples, metres. It is computed from the range
// of heights, and for a leaf nearer than cellSpanM from the samples.
double nearestSampleM(const PlanetShape& shape, const ChunkNode& node, const glm::dvec3& eyeM);

// Fills DrawItem::drawnBoundPx. cellSpansM: L of each item, infinity if unknown. screenScalePx: K'. stitched:
// drawn with RenderSettings::stitched.
void fillDrawnBounds(std::span<DrawItem> items, std::span<const DrawnNeighbours> neighbours,
                     std::span<const double> cellSpansM, double screenScalePx, ErrorMetric metric,
                     bool stitched);
// Does the same for items in any order: it looks up the neighbours among them.
void fillDrawnBounds(std::span<DrawItem> items, std::span<const double> cellSpansM, double screenScalePx,
                     ErrorMetric metric, bool stitched);

}  // namespace planet
