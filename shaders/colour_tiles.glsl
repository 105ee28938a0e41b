// Streamed colours from the tiles of the colour quadtree (tile_lookup.glsl).

uniform sampler2DArray colourTiles;   // one slot per layer; the sampler decodes sRGB
uniform usampler2DArray colourPages;  // slot, level; a face per layer, a level per mipmap, finest first
uniform sampler2DArray colourRoots;   // one face per layer, with mipmaps

// Returns the best resident colour for a level. place: [0, 1] across the face. dx, dy: its screen-space
// derivatives.
vec3 coloursOfLevel(int level, vec2 place, float face, vec2 dx, vec2 dy) {
    uvec2 page = tilePage(colourPages, shading.colours.leafLevel, level, place, face);
    return tileTexel(colourTiles, page, place, dx, dy).rgb;
}

// Returns linear light. Two levels are mixed, as mipmaps are, so that no step is visible where the level
// changes.
vec3 streamedColours(vec2 place, float face) {
    vec2 dx = dFdx(place);
    vec2 dy = dFdy(place);
    float level = levelWanted(dx, dy, shading.colours);
    if (level <= 0.0) return rootTexel(colourRoots, place, face, dx, dy).rgb;
    level = min(level, float(shading.colours.leafLevel));
    int coarser = int(floor(level));
    vec3 coarse = coloursOfLevel(coarser, place, face, dx, dy);
    float finer = level - float(coarser);
    if (finer == 0.0) return coarse;
    return mix(coarse, coloursOfLevel(coarser + 1, place, face, dx, dy), finer);
}
