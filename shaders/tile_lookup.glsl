// Finding the tile of a quadtree that lies over a place, and what it shows there: of colours as of normals.
// planet/gl/store/tile_pool.h says what the textures hold.

// Where a place within a tile, [0, 1], lies on its texture: vertices are the middles of texels.
vec2 onTile(vec2 within) {
    return (float(tileBorderBefore) + 0.5 + within * float(tileCells)) / float(tileTexels);
}

// Slot and level of the finest resident tile for a level. place: [0, 1] across the face.
uvec2 tilePage(usampler2DArray pages, int leafLevel, int level, vec2 place, float face) {
    int across = 1 << level;
    ivec2 cell = clamp(ivec2(place * float(across)), ivec2(0), ivec2(across - 1));
    return texelFetch(pages, ivec3(cell, int(face + 0.5)), leafLevel - level).rg;
}

// dx, dy: the place's change from pixel to pixel.
vec4 tileTexel(sampler2DArray slots, uvec2 page, vec2 place, vec2 dx, vec2 dy) {
    float tiles = float(1 << int(page.g));
    vec2 tile = clamp(floor(place * tiles), vec2(0.0), vec2(tiles - 1.0));
    float scale = tiles * float(tileCells) / float(tileTexels);
    return textureGrad(slots, vec3(onTile(place * tiles - tile), float(page.r)), dx * scale, dy * scale);
}

// Of a face's own tile, with mipmaps.
vec4 rootTexel(sampler2DArray roots, vec2 place, float face, vec2 dx, vec2 dy) {
    float scale = float(tileCells) / float(tileTexels);
    return textureGrad(roots, vec3(onTile(place), face), dx * scale, dy * scale);
}

// Returns the level that has as many texels per pixel as wanted. An anisotropic sampler takes several texels
// along the longer side.
float levelWanted(vec2 dx, vec2 dy, TileSampling sampling) {
    float longest = max(dot(dx, dx), dot(dy, dy));
    float shortest = min(dot(dx, dx), dot(dy, dy));
    float pixel = sqrt(max(longest / (sampling.anisotropy * sampling.anisotropy), shortest));
    return -log2(max(pixel * float(tileCells), 1e-20)) + sampling.extraLevels;
}
