// Streamed colours from the tiles of the colour quadtree (tile_lookup.glsl).

uniform sampler2DArray colourTiles;   // one slot per layer; the sampler decodes sRGB
uniform usampler2DArray colourPages;  // tilePages(); a face per layer, a level per mipmap, finest first
uniform sampler2DArray colourRoots;   // one face per layer, with mipmaps

// Returns the texture coordinates of a place in a mipmap of its face's root. mip: [1, coarsestRootMipmap]. TilePool places the
// mipmaps of a face side by side in one of the layers behind the slots.
vec3 inMipmap(int mip, vec2 place, float face) {
    float side = float(tileTexels >> mip);
    vec2 within = clamp(onTile(place) * side, vec2(0.5), vec2(side - 0.5));
    within.x += float(tileTexels - (tileTexels >> (mip - 1)));
    return vec3(within * (1.0 / float(tileTexels)), float(textureSize(colourTiles, 0).z - faceCount) + face);
}

// Returns the texture coordinates of a place in the root or in its mipmap, for a level of 0 or coarser. root: page of the
// root.
vec3 inRoot(float level, uvec2 root, vec2 place, float face) {
    int mip = clamp(int(0.5 - level), 0, coarsestRootMipmap);
    return mip > 0 ? inMipmap(mip, place, face) : onTileOf(root, place);
}

// Returns the colour of the roots for such a level.
vec3 rootColour(float level, vec2 place, float face, vec2 dx, vec2 dy) {
    if (!switchMipmapsInTiles) return rootTexel(colourRoots, place, face, dx, dy).rgb;
    uvec2 root = tilePages(colourPages, shading.colours.leafLevel, 0, place, face).xy;
    return textureLod(colourTiles, inRoot(level, root, place, face), 0.0).rgb;
}

// Returns what streamedColours() does, with as few samples as a pixel needs. llvmpipe executes both sides of a condition,
// but it leaves a loop as soon as none of eight pixels remains in it. So the second sample costs nothing where no pixel needs
// it. The loop tests its condition at the end, because otherwise its body would be executed once more.
vec3 coloursInFewSamples(float level, vec2 place, float face) {
    int leaf = shading.colours.leafLevel;
    float within = clamp(level, 0.0, float(leaf));
    int coarser = int(within);
    int finer = min(coarser + 1, leaf);
    uvec4 pages = tilePages(colourPages, leaf, finer, place, face);
    bool inRoots = level <= 0.0;
    vec3 at = inRoots ? inRoot(level, pages.zw, place, face) : onTileOf(pages.xy, place);
    float weight = inRoots || finer == coarser ? 1.0 : within - float(coarser);
    float left = 1.0;
    vec3 sum = vec3(0.0);
    do {
        sum += weight * textureLod(colourTiles, at, 0.0).rgb;
        left -= weight;
        weight = left;
        at = onTileOf(pages.zw, place);
    } while (left > 0.0);
    return sum;
}

// Returns linear light. Two levels are mixed, as mipmaps are, so that no step is visible where the level
// changes. place: [0, 1] across the face.
vec3 streamedColours(vec2 place, float face) {
    vec2 dx = dFdx(place);
    vec2 dy = dFdy(place);
    float level = levelWanted(dx, dy, shading.colours);
    if (switchMipmapsInTiles) return coloursInFewSamples(level, place, face);
    if (level <= 0.0) return rootColour(level, place, face, dx, dy);
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
