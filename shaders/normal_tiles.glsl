// Normals finer than the mesh: slopes from tiles at the heights' own resolution, as far as the screen
// resolves them (planet/paging/normal_tile.h).
//
// A tile is used if it is at least as fine as the chunk's mesh; elsewhere the mesh's normal is used. At one
// level both are the same central differences. From pixels as wide as the mesh's cells to finer ones, the two
// are mixed as levels are, so that no transition is visible.

uniform sampler2DArray normalTiles;   // dh/du and dh/dv over the radius; one slot per layer
uniform usampler2DArray normalPages;  // tilePages(); a face per layer, a level per mipmap, finest first
uniform sampler2DArray normalRoots;   // one face per layer, with mipmaps

// Returns in xy the slopes times z, and in z the share of the tile; 0 if no tile is fine enough.
vec3 slopeOfLevel(int level, float meshLevel, vec2 place, float face, vec2 dx, vec2 dy) {
    uvec2 page = tilePages(normalPages, frame.normals.leafLevel, level, place, face).xy;
    if (page.r == noTile || float(page.g) < meshLevel) return vec3(0.0);
    return vec3(tileTexel(normalTiles, page, place, dx, dy).rg, 1.0);
}

vec3 slopeAt(float meshLevel, vec2 place, float face) {
    vec2 dx = dFdx(place);
    vec2 dy = dFdy(place);
    float level = levelWanted(dx, dy, frame.normals);
    if (level <= 0.0) {
        bool isThere = meshLevel <= 0.0 && tilePages(normalPages, frame.normals.leafLevel, 0, place, face).x != noTile;
        return isThere ? vec3(rootTexel(normalRoots, place, face, dx, dy).rg, 1.0) : vec3(0.0);
    }
    level = min(level, float(frame.normals.leafLevel));
    int coarser = int(floor(level));
    float finer = level - float(coarser);
    vec3 slope = (1.0 - finer) * slopeOfLevel(coarser, meshLevel, place, face, dx, dy);
    if (finer > 0.0) slope += finer * slopeOfLevel(coarser + 1, meshLevel, place, face, dx, dy);
    return slope;
}

// Returns the direction by Nowell's mapping.
vec3 directionOf(int face, vec2 c) {
    vec3 roots = sqrt(vec3(1.0 - 0.5 * dot(c, c) + c.x * c.x * c.y * c.y * (1.0 / 3.0),
                           0.5 - c.y * c.y * (1.0 / 6.0), 0.5 - c.x * c.x * (1.0 / 6.0)));
    return fromFace(face, vec3(roots.x, c * roots.yz));
}

// Returns the normal. meshNormal: unit vector, used where no tile applies. meshLevel: level of the tiles
// whose texels are the mesh's vertices. place: (u, v) in [0, 1], height in metres, face.
vec3 normalFromTiles(vec3 meshNormal, float meshLevel, vec4 place) {
    vec3 slope = slopeAt(meshLevel, place.xy, place.w);
    if (slope.z <= 0.0) return meshNormal;
    int face = int(place.w + 0.5);
    vec2 coordinates = 2.0 * place.xy - 1.0;
    vec2 heightSlope = slope.xy / slope.z * (frame.normalRiseM * frame.reliefBoost);
    vec3 normal = switchCube
                      ? fromFace(face, vec3(frame.cubeHalfM, -heightSlope))
                      : normalOnSphere(face, coordinates, directionOf(face, coordinates), frame.radiusM + place.z,
                                       heightSlope);
    return normalize(mix(meshNormal, normalize(normal), slope.z));
}
