// Streamed colours from a clipmap instead of from the tiles themselves: planet/surface/colour_clipmap.h says where its windows
// stand, planet/gl/store/colour_clipmap.h what the textures hold.

uniform sampler2DArray clipmapStack;  // a window a layer, wrapped around; sRGB decoded by the sampler
uniform sampler2DArray clipmapBase;   // a face a layer: the levels that are kept whole, side by side

layout(std140) uniform Clipmap {
    vec4 clipmapWindows[66];  // of each face, then each level: first column and row, layer or -1; unused
    vec4 clipmapCentre;       // xyz: the viewer's place on the cube; unused
    vec4 clipmapUp;           // xyz: its face's normal, without sign; unused
    vec4 clipmapSizes;        // texels a window side; reach of level 0; 1 / share of it that fades; finest level
    ivec4 clipmapWhole;       // finest level kept whole; unused
};

// clipmapDistance of planet/surface/colour_clipmap.h.
float clipmapDistance(vec2 place, int face) {
    vec3 outward = abs(faces[face].normal.xyz);
    vec3 point = faces[face].normal.xyz + (2.0 * place.x - 1.0) * faces[face].u.xyz +
                 (2.0 * place.y - 1.0) * faces[face].v.xyz;
    vec3 apart = abs(point - clipmapCentre.xyz);
    vec3 up = clipmapUp.xyz;
    float down = dot(apart, up);
    if (dot(up, outward) > 0.5) {
        vec3 along = apart * (1.0 - up);
        return max(max(along.x, along.y), along.z) + down;
    }
    vec3 side = 1.0 - up - outward;
    float corner = abs(2.0 * dot(point, side) - dot(clipmapCentre.xyz, side)) - 1.0;
    return max(max(down + dot(apart, outward), dot(apart, side)), down + corner);
}

// clipmapFinest of planet/surface/colour_clipmap.h.
float finestOfClipmap(float away) {
    float level = log2(clipmapSizes.y / max(away, 1e-9));
    float holding = floor(level);
    float inside = 1.0 - exp2(holding - level);
    float finest = holding - 1.0 + min(inside * clipmapSizes.z, 1.0);
    return clamp(finest, float(clipmapWhole.x), clipmapSizes.w);
}

// The finest whole level lies in the corner, the others in a row above it.
vec3 coloursOfBase(int level, vec2 place, float face, vec2 dx, vec2 dy) {
    int whole = clipmapWhole.x;
    float aside = tileTexels - tileCells;
    float cells = tileCells * float(1 << level);
    vec2 corner = vec2(0.0);
    if (level < whole) {
        corner.x = tileCells * float((1 << whole) - (2 << level)) + aside * float(whole - 1 - level);
        corner.y = tileCells * float(1 << whole) + aside;
    }
    vec2 size = vec2(textureSize(clipmapBase, 0).xy);
    vec2 at = corner + tileBorder + 0.5 + place * cells;
    return textureGrad(clipmapBase, vec3(at / size, face), dx * cells / size, dy * cells / size).rgb;
}

vec3 coloursOfClipmap(int level, vec2 place, float face, vec2 dx, vec2 dy) {
    if (level <= clipmapWhole.x) return coloursOfBase(level, place, face, dx, dy);
    vec4 window = clipmapWindows[int(face + 0.5) * 11 + level];
    if (window.z < 0.0) return coloursOfBase(clipmapWhole.x, place, face, dx, dy);
    float cells = tileCells * float(1 << level);
    float size = clipmapSizes.x;
    // Where the window begins on the torus comes last: places are large beside a texel.
    vec2 at = place * cells - window.xy + (window.xy - size * floor(window.xy / size)) + 0.5;
    float scale = cells / size;
    return textureGrad(clipmapStack, vec3(at / size, window.z), dx * scale, dy * scale).rgb;
}

// As streamedColours, but no finer than the windows that hold the place.
vec3 clipmapColours(vec2 place, float face) {
    vec2 dx = dFdx(place);
    vec2 dy = dFdy(place);
    float level = levelWanted(dx, dy, colourFilter);
    if (level <= 0.0) return rootTexel(colourRoots, place, face, dx, dy).rgb;
    level = min(level, finestOfClipmap(clipmapDistance(place, int(face + 0.5))));
    int coarser = int(floor(level));
    vec3 coarse = coloursOfClipmap(coarser, place, face, dx, dy);
    float finer = level - float(coarser);
    if (finer == 0.0) return coarse;
    return mix(coarse, coloursOfClipmap(coarser + 1, place, face, dx, dy), finer);
}
