// Streamed colours from the tiles of the colour quadtree (tile_lookup.glsl).

uniform sampler2DArray colourTiles;   // one slot per layer; the sampler decodes sRGB
uniform usampler2DArray colourPages;  // tilePages(); a face per layer, a level per mipmap, finest first
uniform sampler2DArray colourRoots;   // one face per layer, with mipmaps

// Returns linear light. Two levels are mixed, as mipmaps are, so that no step is visible where the level
// changes. place: [0, 1] across the face.
vec3 streamedColours(vec2 place, float face) {
    vec2 dx = dFdx(place);
    vec2 dy = dFdy(place);
    float level = levelWanted(dx, dy, shading.colours);
    if (level <= 0.0) return rootTexel(colourRoots, place, face, dx, dy).rgb;
    int leaf = shading.colours.leafLevel;
    level = min(level, float(leaf));
    int coarser = int(level);
    int finer = min(coarser + 1, leaf);
    uvec4 pages = tilePages(colourPages, leaf, finer, place, face);
    vec3 fine = tileTexel(colourTiles, pages.xy, place, dx, dy).rgb;
    if (finer == coarser) return fine;
    vec3 coarse = tileTexel(colourTiles, pages.zw, place, dx, dy).rgb;
    return mix(coarse, fine, level - float(coarser));
}
