// One vertex of the grid that all chunks share.

layout(location = 0) in uvec4 gridVertex;  // column; row; 1 at the skirt's lower end; unused
layout(location = 1) in uvec4 chunk;       // face + 8 level; x; y; slot
layout(location = 2) in uvec4 beside;      // slots of the chunks of the same level to the west, east, south, north
layout(location = 3) in float skirtDepth;  // metres
layout(location = 4) in vec4 chunkTint;    // colour, sRGB, and its strength

uniform isampler2DArray heightPool;

out vec3 surface;         // position relative to the eye
out vec4 facePlace;       // [0, 1] along u and v; height, metres; the face
out vec4 surfaceNormal;   // not unit; [0, 1] how rough the ground is
out vec3 sunLit;          // the sun's light on the ground
out vec3 skyLit;          // the sky's
out vec3 airLit;          // the sun's light on the air before the ground
out vec4 groundArriving;  // by vertex: light that white land sends to the eye through the air; the sea's over it
out vec4 airArriving;     // by vertex: what that air scatters; the glint on the sea over groundArriving
out float steep;          // by vertex: [0, 1]
out vec2 gridCoordinate;  // column and row, for the wireframe
flat out vec3 faceU;      // the face's axes
flat out vec3 faceV;
flat out vec4 tint;

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
// as their heights tell. And the larger of the steps to
// either side, 0 where only one is known: on a face's edge both faces then see only the steps along it, the same.
vec2 slope(ivec3 corner, ivec2 vertex, ivec2 axis, int last, int here, uint slotBefore, uint slotAfter) {
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
    return vec2(0.5 * float(twice), oneSided ? 0 : max(abs(here - before), abs(after - here)));
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

void lightGround(vec3 position, vec3 up, float height) {
    float sunRise = dot(up, sun.xyz);
    float day = smoothstep(-0.06, 0.10, sunRise);
    vec3 sky = vec3(0.0125, 0.013, 0.0145);
    sunLit = sunLight * day;
    airLit = vec3(0.0);
    if (isOn(switchAir)) {
        sky = vec3(0.085, 0.115, 0.165) * smoothstep(-0.18, 0.30, sunRise) + vec3(0.0025, 0.003, 0.0045);
        sunLit *= sunThrough(0.1, sunRise);
        airLit = sunOnAirBefore(position, normalize(position), up, max(height, 0.0) * atmosphere.y);
    }
    skyLit = sunLight * 0.55 * sky;
}

void lightByVertex(vec3 position, vec3 up, vec3 normal, float height) {
    vec3 ray = normalize(position);
    vec3 land = sunLit * max(dot(normal, sun.xyz), 0.0) + skyLit;
    vec3 sea = sunLit * max(dot(up, sun.xyz), 0.0) + skyLit;
    steep = steepness(normal, up);
    groundArriving = vec4(land, sea.g / land.g);
    airArriving = vec4(0.0, 0.0, 0.0, seaGlint(up, -ray) * sunLit.g / land.g);
    if (!isOn(switchAir)) return;
    float air = airBefore(ray, up, max(height, 0.0) * atmosphere.y);
    if (isOn(switchTint)) air *= 1.0 - airUnderTint * chunkTint.a;
    vec3 amount = scatteringBeforeGround();
    groundArriving.rgb *= exp(-(amount + vec3(haze)) * air);
    airArriving.rgb = scattered(air, amount, airLit, dot(ray, sun.xyz));
}

void main() {
    FaceFrame frame = faces[chunk.x & 7u];
    int level = int(chunk.x >> 3u);
    int cellsLog2 = grid.y;
    int last = 1 << cellsLog2;
    ivec2 vertex = ivec2(gridVertex.xy);
    int spacing = fineGridLog2 - cellsLog2 - level;
    ivec2 gridPoint = (ivec2(chunk.yz) * last + vertex) << spacing;
    GridPlace place = gridPlace(frame, gridPoint);

    ivec3 corner = slotCorner(chunk.w, last);
    int heightStep = stepAt(corner, vertex);
    float drop = gridVertex.z == 0u ? 0.0 : skirtDepth;
    float rise = float(heightStep - grid.x) * planet.y - drop;
    float height = heights.x + float(heightStep) * planet.y;

    vec3 position = isOn(switchCube) ? positionOnCube(frame, place, height - drop)
                                     : positionOnSphere(frame, place, rise);
    vec3 up = frame.direction.xyz + place.turn;
    vec3 normal = up;
    float rough = 0.0;
    sunLit = skyLit = airLit = vec3(0.0);
    groundArriving = airArriving = vec4(0.0);
    steep = 0.0;
    if (isOn(switchLighting)) {
        vec2 along = slope(corner, vertex, ivec2(1, 0), last, heightStep, beside.x, beside.y);
        vec2 across = slope(corner, vertex, ivec2(0, 1), last, heightStep, beside.z, beside.w);
        float stepsPerSlope = planet.y / (float(1 << spacing) * fineCell);
        vec2 heightSlope = vec2(along.x, across.x) * (stepsPerSlope * heights.z);
        normal = isOn(switchCube) ? frame.normal.xyz * planet.w - heightSlope.x * frame.u.xyz -
                                        heightSlope.y * frame.v.xyz
                                  : normalOnSphere(frame, place, planet.z + rise, heightSlope);
        normal *= inversesqrt(dot(normal, normal));
        float steepest = max(along.y, across.y) * stepsPerSlope / (0.75 * planet.x);
        rough = smoothstep(0.0, 0.09, steepest);
        vec3 unitUp = normalize(up);
        lightGround(position, unitUp, height);
        if (isOn(switchLightByVertex)) lightByVertex(position, unitUp, normal, height);
    }

    surface = position;
    facePlace = vec4(vec2(gridPoint) * (0.5 * fineCell), height, float(chunk.x & 7u));
    surfaceNormal = vec4(normal, rough);
    gridCoordinate = vec2(vertex);
    faceU = frame.u.xyz;
    faceV = frame.v.xyz;
    tint = chunkTint;
    gl_Position = clipFromWorld * vec4(position, 1.0);
}
