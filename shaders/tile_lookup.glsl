// Finds the tile of a quadtree at a place and samples it, for colours and normals.
// planet/gl/store/tile_pool.h describes the contents of the textures.

// Returns the texture coordinates of a place within a tile, [0, 1]. Vertices are centres of texels.
vec2 onTile(vec2 within) {
    return (float(tileBorderBefore) + 0.5) * (1.0 / float(tileTexels)) +
           within * (float(tileCells) / float(tileTexels));
}

// Returns slot and level of the finest resident tile for a level, and in zw those for the level above. place: [0, 1]
// across the face.
uvec4 tilePages(usampler2DArray pages, int leafLevel, int level, vec2 place, float face) {
    int across = 1 << level;
    ivec2 cell = clamp(ivec2(place * float(across)), ivec2(0), ivec2(across - 1));
    return texelFetch(pages, ivec3(cell, int(face + 0.5)), leafLevel - level);
}

// Returns the texture coordinates of a place in the tile of a page.
vec3 onTileOf(uvec2 page, vec2 place) {
    float tiles = float(1 << int(page.g));
    vec2 tile = clamp(floor(place * tiles), vec2(0.0), vec2(tiles - 1.0));
    return vec3(onTile(place * tiles - tile), float(page.r));
}

// Samples a tile. dx, dy: screen-space derivatives of the place.
vec4 tileTexel(sampler2DArray slots, uvec2 page, vec2 place, vec2 dx, vec2 dy) {
    vec3 at = onTileOf(page, place);
    // Tiles have no mipmaps, so derivatives matter to an anisotropic sampler only.
    if (!switchAnisotropy) return textureLod(slots, at, 0.0);
    float scale = float(1 << int(page.g)) * (float(tileCells) / float(tileTexels));
    return textureGrad(slots, at, dx * scale, dy * scale);
}

// Samples a face's root tile, with mipmaps.
vec4 rootTexel(sampler2DArray roots, vec2 place, float face, vec2 dx, vec2 dy) {
    float scale = float(tileCells) / float(tileTexels);
    return textureGrad(roots, vec3(onTile(place), face), dx * scale, dy * scale);
}

// Returns the level with the wanted number of texels per pixel. An anisotropic sampler takes several texels
// along the longer side.
float levelWanted(vec2 dx, vec2 dy, TileSampling sampling) {
    float longest = max(dot(dx, dx), dot(dy, dy));
    float shortest = min(dot(dx, dx), dot(dy, dy));
    float squared = switchAnisotropy ? max(longest / (sampling.anisotropy * sampling.anisotropy), shortest) : longest;
    return -0.5 * log2(max(squared * float(tileCells * tileCells), 1e-38)) + sampling.extraLevels;
}
