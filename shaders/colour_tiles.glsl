// Streamed colours: which tile of the colour quadtree lies over a place, and what it shows there. planet/gl/
// colour_pool.h says what the textures hold.

uniform sampler2DArray colourTiles;   // sRGB decoded by the sampler; a slot a layer
uniform usampler2DArray colourPages;  // a face a layer, a level a mipmap, the finest first: slot, level
uniform sampler2DArray colourRoots;   // a face a layer, with mipmaps

// planet/colour_tile.h.
const float tileCells = 256.0;
const float tileBorder = 7.0;
const float tileTexels = 272.0;

// Where a place within a tile, [0, 1], lies on its texture: vertices are the middles of texels.
vec2 onTile(vec2 within) {
    return (tileBorder + 0.5 + within * tileCells) / tileTexels;
}

// What is resident for a level. place: [0, 1] across the face; dx, dy: its change from pixel to pixel.
vec3 coloursOfLevel(int level, vec2 place, float face, vec2 dx, vec2 dy) {
    int leafLevel = colouring.x;
    int across = 1 << level;
    ivec2 cell = clamp(ivec2(place * float(across)), ivec2(0), ivec2(across - 1));
    uvec2 page = texelFetch(colourPages, ivec3(cell, int(face + 0.5)), leafLevel - level).rg;
    float tiles = float(1 << int(page.g));
    vec2 tile = clamp(floor(place * tiles), vec2(0.0), vec2(tiles - 1.0));
    float scale = tiles * tileCells / tileTexels;
    return textureGrad(colourTiles, vec3(onTile(place * tiles - tile), float(page.r)), dx * scale, dy * scale).rgb;
}

// The level with as many texels a pixel as are wanted; 0 or less where a whole face is small.
float wantedLevel(vec2 dx, vec2 dy) {
    float longest = max(dot(dx, dx), dot(dy, dy));
    float shortest = min(dot(dx, dx), dot(dy, dy));
    // An anisotropic sampler takes several texels along the longer side.
    float pixel = sqrt(max(longest / (colourFilter.x * colourFilter.x), shortest));
    return -log2(max(pixel * tileCells, 1e-20)) + colourFilter.y;
}

vec3 coloursOfRoot(vec2 place, float face, vec2 dx, vec2 dy) {
    float scale = tileCells / tileTexels;
    return textureGrad(colourRoots, vec3(onTile(place), face), dx * scale, dy * scale).rgb;
}

// Linear light. Two levels are mixed, as mipmaps are, so that no step shows where the level changes.
vec3 streamedColours(vec2 place, float face) {
    vec2 dx = dFdx(place);
    vec2 dy = dFdy(place);
    float level = wantedLevel(dx, dy);
    if (level <= 0.0) return coloursOfRoot(place, face, dx, dy);
    float finest = float(colouring.x);
    level = min(level, finest);
    int coarser = int(floor(level));
    vec3 coarse = coloursOfLevel(coarser, place, face, dx, dy);
    float finer = level - float(coarser);
    if (finer == 0.0) return coarse;
    return mix(coarse, coloursOfLevel(coarser + 1, place, face, dx, dy), finer);
}
