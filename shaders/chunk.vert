// One vertex of the grid that all chunks share.

layout(location = 0) in uvec4 gridVertex;  // column; row; 1 at the skirt's lower end; unused
layout(location = 1) in uvec4 chunk;       // face + 8 level; x; y; slot
layout(location = 2) in uvec4 beside;      // slots of the chunks of the same level to the west, east, south, north
layout(location = 3) in float skirtDepth;  // metres
layout(location = 4) in vec4 chunkTint;    // colour, sRGB, and its strength

uniform isampler2DArray heightPool;

out vec4 surface;         // position relative to the eye; height, metres
out vec3 surfaceNormal;   // not unit
out vec3 gridCoordinate;  // column and row for the wireframe; 1 at the skirt's lower end
flat out vec4 tint;
out vec3 finestCell;  // column and row among the finest cells, from a far corner; cells to the face's edge

invariant gl_Position;

const uint noSlot = 0xFFFFFFFFu;  // not drawn, or on another face

// Texel of a slot's first height: column and row in its page, and the page.
ivec3 slotCorner(uint slot, int last) {
    return ivec3(ivec2(int(slot & 0x3FFu), int((slot >> 10u) & 0x3FFu)) * (last + 1), int(slot >> 20u));
}

int stepAt(ivec3 corner, ivec2 vertex) {
    return texelFetch(heightPool, corner + ivec3(vertex, 0), 0).r;
}

// Steps a cell along one axis: a central difference, across the chunk's border too where the chunk beside it is
// drawn at the same level. Elsewhere on the border second order and one-sided, so that both sides agree as far
// as their heights tell.
float slope(ivec3 corner, ivec2 vertex, ivec2 axis, int last, int here, uint slotBefore, uint slotAfter) {
    int at = vertex.x * axis.x + vertex.y * axis.y;
    bool first = at == 0;
    bool final = at == last;
    uint slotBeside = first ? slotBefore : final ? slotAfter : noSlot;
    bool oneSided = (first || final) && slotBeside == noSlot;
    int stepBack = -1;
    int stepOn = 1;
    ivec3 cornerBack = corner;
    ivec3 cornerOn = corner;
    if (oneSided && first) stepBack = 2;
    if (oneSided && final) stepOn = -2;
    if (!oneSided && first) {
        cornerBack = slotCorner(slotBeside, last);
        stepBack = last - 1;
    }
    if (!oneSided && final) {
        cornerOn = slotCorner(slotBeside, last);
        stepOn = 1 - last;
    }
    int before = stepAt(cornerBack, vertex + axis * stepBack);
    int after = stepAt(cornerOn, vertex + axis * stepOn);
    int twice = !oneSided ? after - before
                : first   ? 4 * after - 3 * here - before
                          : 3 * here - 4 * before + after;
    return 0.5 * float(twice);
}

// The cross product of the tangents of (R + h) d(u, v), divided by R + h.
vec3 normalOnSphere(FaceFrame face, GridPlace place, float radius, vec2 heightSlope) {
    float u = place.coordinates.x;
    float v = place.coordinates.y;
    vec3 roots = place.roots;
    vec3 d = face.direction.xyz + place.turn;
    float cross6 = -u * v * (1.0 / 6.0);
    vec3 along = vec3(u * (v * v * (1.0 / 3.0) - 0.5) / roots.x, roots.y, cross6 / roots.z);
    vec3 across = vec3(v * (u * u * (1.0 / 3.0) - 0.5) / roots.x, cross6 / roots.y, roots.z);
    mat3 world = mat3(face.normal.xyz, face.u.xyz, face.v.xyz);
    vec3 du = world * along;
    vec3 dv = world * across;
    return radius * cross(du, dv) + heightSlope.x * cross(d, dv) + heightSlope.y * cross(du, d);
}

void main() {
    FaceFrame face = faces[chunk.x & 7u];
    int level = int(chunk.x >> 3u);
    int cellsLog2 = grid.y;
    int last = 1 << cellsLog2;
    ivec2 vertex = ivec2(gridVertex.xy);
    int spacing = fineGridLog2 - cellsLog2 - level;
    GridPlace place = gridPlace(face, (ivec2(chunk.yz) * last + vertex) << spacing);

    ivec3 corner = slotCorner(chunk.w, last);
    int heightStep = stepAt(corner, vertex);
    float drop = gridVertex.z == 0u ? 0.0 : skirtDepth;
    float rise = float(heightStep - grid.x) * planet.y - drop;
    float height = heights.x + float(heightStep) * planet.y;

    vec3 position = isOn(switchCube) ? positionOnCube(face, place, height - drop)
                                     : positionOnSphere(face, place, rise);
    vec3 normal = face.direction.xyz + place.turn;
    if (isOn(switchLighting)) {
        vec2 steps = vec2(slope(corner, vertex, ivec2(1, 0), last, heightStep, beside.x, beside.y),
                          slope(corner, vertex, ivec2(0, 1), last, heightStep, beside.z, beside.w));
        vec2 heightSlope = steps * (planet.y * heights.z) / (float(1 << spacing) * fineCell);
        normal = isOn(switchCube) ? face.normal.xyz * planet.w - heightSlope.x * face.u.xyz -
                                        heightSlope.y * face.v.xyz
                                  : normalOnSphere(face, place, planet.z + rise, heightSlope);
        normal *= inversesqrt(dot(normal, normal));
    }

    // Counted from a corner that is far off but the same for all chunks near here, so that a float holds fractions.
    const int period = 4096;
    ivec2 chunkPlace = ((ivec2(chunk.yz) * last) << spacing) >> grid.z;
    vec2 withinChunk = vec2(vertex) * exp2(float(spacing - grid.z));
    vec2 cells = vec2(chunkPlace) + withinChunk;
    vec2 toEdge = min(cells, exp2(float(fineGridLog2 - grid.z)) - cells);
    finestCell = vec3(vec2(chunkPlace & (period - 1)) + withinChunk, min(toEdge.x, toEdge.y));

    surface = vec4(position, height);
    surfaceNormal = normal;
    gridCoordinate = vec3(vertex, gridVertex.z);
    tint = chunkTint;
    gl_Position = clipFromWorld * vec4(position, 1.0);
}
