// Streamed colours: which tile of the colour quadtree lies over a place, and what it shows there
// (tile_lookup.glsl).

uniform sampler2DArray colourTiles;   // sRGB decoded by the sampler; a slot a layer
uniform usampler2DArray colourPages;  // a face a layer, a level a mipmap, the finest first: slot, level
uniform sampler2DArray colourRoots;   // a face a layer, with mipmaps

// What is resident for a level. place: [0, 1] across the face; dx, dy: its change from pixel to pixel.
vec3 coloursOfLevel(int level, vec2 place, float face, vec2 dx, vec2 dy) {
    uvec2 page = tilePage(colourPages, frame.colours.leafLevel, level, place, face);
    return tileTexel(colourTiles, page, place, dx, dy).rgb;
}

// Linear light. Two levels are mixed, as mipmaps are, so that no step shows where the level changes.
vec3 streamedColours(vec2 place, float face) {
    vec2 dx = dFdx(place);
    vec2 dy = dFdy(place);
    float level = levelWanted(dx, dy, frame.colours);
    if (level <= 0.0) return rootTexel(colourRoots, place, face, dx, dy).rgb;
    level = min(level, float(frame.colours.leafLevel));
    int coarser = int(floor(level));
    vec3 coarse = coloursOfLevel(coarser, place, face, dx, dy);
    float finer = level - float(coarser);
    if (finer == 0.0) return coarse;
    return mix(coarse, coloursOfLevel(coarser + 1, place, face, dx, dy), finer);
}
