// Streamed colours from a clipmap instead of the tiles. planet/surface/colour_clipmap.h describes the places
// of its windows, planet/gl/store/colour_clipmap.h the contents of the textures.

uniform sampler2DArray clipmapStack;  // one window per layer, wrapped around; the sampler decodes sRGB
uniform sampler2DArray clipmapBase;   // one face per layer: the levels that are kept whole, side by side

// planet/gl/store/colour_clipmap.h has structs with the same members.
struct ClipmapWindow {
    vec2 first;  // column and row
    int layer;   // -1: none
};

layout(std140) uniform Clipmap {
    ClipmapWindow windows[faceCount * (maxColourLevel + 1)];  // by face, then by level
    vec3 centre;     // the viewer's place on the cube
    float sizePx;    // side of a window, texels
    vec3 up;         // absolute normal of the viewer's face
    float reach;     // of level 0
    float perFade;   // 1 / the share of its reach over which a window fades
    int finestLevel;
    int wholeLevel;  // the finest level that is kept whole
} clipmap;

// Returns the distance of a place, [0, 1] across a face, from the viewer, in half sides of a face: along the
// larger axis on the viewer's face, and summed across the edge on the next face. Two faces that meet next to
// a corner of the viewer's face must agree on their common edge, so the distance there is the larger of the
// two, in addition to the distance on the unfolded cube. tests/support/clipmap_levels.h has the same formula.
float clipmapDistance(vec2 place, int face) {
    vec3 outward = abs(fromFace(face, vec3(1.0, 0.0, 0.0)));
    vec3 point = fromFace(face, vec3(1.0, 2.0 * place - 1.0));
    vec3 apart = abs(point - clipmap.centre);
    vec3 up = clipmap.up;
    float down = dot(apart, up);
    if (dot(up, outward) > 0.5) {
        vec3 along = apart * (1.0 - up);
        return max(max(along.x, along.y), along.z) + down;
    }
    vec3 side = 1.0 - up - outward;
    float corner = abs(2.0 * dot(point, side) - dot(clipmap.centre, side)) - 1.0;
    return max(max(down + dot(apart, outward), dot(apart, side)), down + corner);
}

// Returns the finest level that may be drawn at a distance. A fraction mixes two levels, so that a window's
// border is invisible.
float finestOfClipmap(float away) {
    float level = log2(clipmap.reach / max(away, 1e-9));
    float holding = floor(level);
    float inside = 1.0 - exp2(holding - level);
    float finest = holding - 1.0 + min(inside * clipmap.perFade, 1.0);
    return clamp(finest, float(clipmap.wholeLevel), float(clipmap.finestLevel));
}

// Samples the base. The finest whole level lies in the corner, the others in a row above it.
vec3 coloursOfBase(int level, vec2 place, float face, vec2 dx, vec2 dy) {
    int whole = clipmap.wholeLevel;
    float aside = float(tileTexels - tileCells);
    float cells = float(tileCells << level);
    vec2 corner = vec2(0.0);
    if (level < whole) {
        corner.x = float(tileCells * ((1 << whole) - (2 << level))) + aside * float(whole - 1 - level);
        corner.y = float(tileCells << whole) + aside;
    }
    vec2 size = vec2(textureSize(clipmapBase, 0).xy);
    vec2 at = corner + float(tileBorderBefore) + 0.5 + place * cells;
    return textureGrad(clipmapBase, vec3(at / size, face), dx * cells / size, dy * cells / size).rgb;
}

vec3 coloursOfClipmap(int level, vec2 place, float face, vec2 dx, vec2 dy) {
    if (level <= clipmap.wholeLevel) return coloursOfBase(level, place, face, dx, dy);
    ClipmapWindow window = clipmap.windows[int(face + 0.5) * (maxColourLevel + 1) + level];
    if (window.layer < 0) return coloursOfBase(clipmap.wholeLevel, place, face, dx, dy);
    float cells = float(tileCells << level);
    float size = clipmap.sizePx;
    // The window's origin on the torus is added last, because places are large compared with a texel.
    vec2 at = place * cells - window.first + (window.first - size * floor(window.first / size)) + 0.5;
    float scale = cells / size;
    return textureGrad(clipmapStack, vec3(at / size, float(window.layer)), dx * scale, dy * scale).rgb;
}

// Returns the streamed colours, no finer than the windows that contain the place.
vec3 clipmapColours(vec2 place, float face) {
    vec2 dx = dFdx(place);
    vec2 dy = dFdy(place);
    float level = levelWanted(dx, dy, shading.colours);
    if (level <= 0.0) return rootColour(level, place, face, dx, dy);
    level = min(level, finestOfClipmap(clipmapDistance(place, int(face + 0.5))));
    int coarser = int(floor(level));
    vec3 coarse = coloursOfClipmap(coarser, place, face, dx, dy);
    float finer = level - float(coarser);
    if (finer == 0.0) return coarse;
    return mix(coarse, coloursOfClipmap(coarser + 1, place, face, dx, dy), finer);
}
