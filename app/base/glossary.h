// The terms for the quantities that Worldy counts and measures: one name per quantity in the window, in JSON
// and in CSV. app/README.md holds the same table and explains the prefixes of keys.
#pragma once

#include <array>

namespace worldy {

struct Term {
    const char* key;      // in JSON and CSV
    const char* name;     // in the window
    const char* meaning;  // one or two full sentences
};

namespace terms {

inline constexpr Term drawnChunks{"drawn_chunks", "Drawn chunks",
                                  "Number of chunks drawn for the LOD view. Excludes the observer."};
inline constexpr Term groundTriangles{
    "ground_triangles", "Ground triangles",
    "Triangles of the chunks drawn for the LOD view. Excludes skirts and the observer."};
inline constexpr Term skirtTriangles{"skirt_triangles", "Skirt triangles",
                                     "Triangles of the skirts of the same chunks; 0 without skirts."};
inline constexpr Term triangles{"triangles", "Triangles", "The sum of ground triangles and skirt triangles."};
inline constexpr Term epsPx{"eps_px", "Screen-space error \u03b5",
                            "Predicted error of a chunk's own surface, \u03b4c K' / D, pixels. Compared with "
                            "\u03c4. Excludes morph."};
inline constexpr Term drawnBoundPx{
    "drawn_bound_px", "Drawn bound",
    "Bound of the error of what is drawn, pixels: the chunk's own \u03b5 and its parent's, weighted by the "
    "morph, including edge morphs. Without morph and stitched edges it is \u03b5."};
inline constexpr Term measuredPx{"measured_px", "Measured error",
                                 "Largest distance between a finest sample and the drawn surface at the same "
                                 "place, pixels, as if the view faced "
                                 "it. Never exceeds the drawn bound."};
inline constexpr Term screenPx{"screen_px", "Measured screen-space error",
                               "The same distance in the projected image, pixels, for samples inside it; "
                               "larger towards the corners."};

inline constexpr Term tauPx{"tau_px", "Tolerance \u03c4",
                            "Tolerance that the frame was selected with, pixels. A budget moves it."};
inline constexpr Term budgetUse{
    "budget_use", "Budget use",
    "Cost of the frame as a share of the budget that binds: times as medians of three frames, bytes read as "
    "means of half a second."};
inline constexpr Term budgetBinds{"budget_binds", "Binds",
                                  "Budget that needs the largest tolerance, or the limit of the tolerance."};

inline constexpr Term lateChunkS{"late_chunk_s", "Late chunk-seconds",
                                 "Drawn chunks that are coarser than \u03c4 because their children are not "
                                 "resident, times the seconds for "
                                 "which they are drawn."};
inline constexpr Term prefetchedBlocks{"prefetched_blocks", "Prefetched",
                                       "Blocks that became resident before any view wanted them."};
inline constexpr Term prefetchHits{"prefetch_hits", "Hits",
                                   "Prefetched blocks that a view has wanted since."};
inline constexpr Term prefetchWaste{"prefetch_waste", "Waste",
                                    "Prefetched blocks that were evicted before any view wanted them."};
inline constexpr Term prefetchUnused{
    "prefetch_unused", "Unused",
    "Prefetched blocks that are resident and that no view has wanted yet: prefetched - hits - waste."};

}  // namespace terms

inline constexpr std::array glossary = {
    terms::drawnChunks,      terms::groundTriangles, terms::skirtTriangles,
    terms::triangles,        terms::epsPx,           terms::drawnBoundPx,
    terms::measuredPx,       terms::screenPx,        terms::tauPx,
    terms::budgetUse,        terms::budgetBinds,     terms::lateChunkS,
    terms::prefetchedBlocks, terms::prefetchHits,    terms::prefetchWaste,
    terms::prefetchUnused};

}  // namespace worldy
