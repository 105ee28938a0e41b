// One vertex of the grid that all chunks share.

layout(location = 0) in uvec4 gridVertex;  // column; row; 1 at the skirt's lower end; unused
layout(location = 1) in uvec4 chunk;       // face + 8 level; x; y; corner of the slot in its page, x + 65536 y
layout(location = 2) in uint page;
layout(location = 3) in float skirtDepth;  // metres
layout(location = 4) in vec4 chunkTint;    // colour, sRGB, and its strength

uniform isampler2DArray heightPool;

out vec4 surface;         // position relative to the eye; height, metres
out vec3 surfaceNormal;   // not unit
out vec3 gridCoordinate;  // column and row for the wireframe; 1 at the skirt's lower end
flat out vec4 tint;

invariant gl_Position;

ivec3 slotCorner() {
    return ivec3(int(chunk.w & 0xFFFFu), int(chunk.w >> 16u), int(page));
}

int stepAt(ivec3 corner, ivec2 vertex) {
    return texelFetch(heightPool, corner + ivec3(vertex, 0), 0).r;
}

// Steps a cell along one axis: central inside, second order and one-sided on the chunk's border, so that the
// chunks on both sides of the border agree as far as their heights tell.
float slope(ivec3 corner, ivec2 vertex, ivec2 axis, int at, int last, int here) {
    int before = stepAt(corner, vertex + axis * (at == 0 ? 2 : -1));
    int after = stepAt(corner, vertex + axis * (at == last ? -2 : 1));
    int twice = at == 0      ? 4 * after - 3 * here - before
                : at == last ? 3 * here - 4 * before + after
                             : after - before;
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

    ivec3 corner = slotCorner();
    int step = stepAt(corner, vertex);
    float drop = gridVertex.z == 0u ? 0.0 : skirtDepth;
    float rise = float(step - grid.x) * planet.y - drop;
    float height = heights.x + float(step) * planet.y;

    vec3 position = isOn(switchCube) ? positionOnCube(face, place, height - drop)
                                     : positionOnSphere(face, place, rise);
    vec3 normal = face.direction.xyz + place.turn;
    if (isOn(switchLighting)) {
        vec2 steps = vec2(slope(corner, vertex, ivec2(1, 0), vertex.x, last, step),
                          slope(corner, vertex, ivec2(0, 1), vertex.y, last, step));
        vec2 heightSlope = steps * (planet.y * heights.z) / (float(1 << spacing) * fineCell);
        normal = isOn(switchCube) ? face.normal.xyz * planet.w - heightSlope.x * face.u.xyz -
                                        heightSlope.y * face.v.xyz
                                  : normalOnSphere(face, place, planet.z + rise, heightSlope);
        normal *= inversesqrt(dot(normal, normal));
    }

    surface = vec4(position, height);
    surfaceNormal = normal;
    gridCoordinate = vec3(vertex, gridVertex.z);
    tint = chunkTint;
    gl_Position = clipFromWorld * vec4(position, 1.0);
}
