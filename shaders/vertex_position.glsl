// Mirrors planet/sphere/vertex_position.cpp line by line; planet/sphere/vertex_position.h explains the
// method.

const float fineCell = 2.0 / float(1 << fineGridLog2);

// The position of a vertex on its face.
struct GridPlace {
    vec2 delta;        // u - u0, v - v0, to the precision of a float
    vec2 coordinates;  // u, v, likewise
    vec3 roots;        // of Nowell's mapping at (u, v)
    vec3 turn;         // d - d0, world axes
};

GridPlace gridPlace(FaceUniforms face, ivec2 grid) {
    GridPlace place;
    vec2 start = face.coordinates;
    place.delta = vec2(grid - face.grid) * fineCell;
    place.coordinates = start + place.delta;
    vec2 squares = place.delta * (start + place.coordinates);  // u^2 - u0^2, v^2 - v0^2
    vec2 c = place.coordinates;
    float underRoot = squares.x * (c.y * c.y * (1.0 / 3.0) - 0.5) +
                      squares.y * (start.x * start.x * (1.0 / 3.0) - 0.5);
    vec3 roots0 = face.roots;
    place.roots = sqrt(vec3(roots0.x * roots0.x + underRoot, 0.5 - c.y * c.y * (1.0 / 6.0),
                            0.5 - c.x * c.x * (1.0 / 6.0)));
    float alongNormal = underRoot / (place.roots.x + roots0.x);
    vec2 along = place.delta * place.roots.yz -
                 start * (squares.yx * (1.0 / 6.0)) / (place.roots.yz + roots0.yz);
    place.turn = alongNormal * face.normal + along.x * face.u + along.y * face.v;
    return place;
}

// Replaces a point on an edge or a corner of the cube by the same point on the face with the lowest index
// that contains it, so that all faces compute the same position.
void moveToOwningFace(inout int face, inout ivec2 grid) {
    const int side = 1 << fineGridLog2;
    ivec2 fromMiddle = 2 * grid - side;
    if (max(abs(fromMiddle.x), abs(fromMiddle.y)) < side) return;
    // In integers, because coordinates have more bits than a float.
    ivec3 cube = side * ivec3(frame.faces[face].normal) + fromMiddle.x * ivec3(frame.faces[face].u) +
                 fromMiddle.y * ivec3(frame.faces[face].v);
    int axis = abs(cube.x) == side ? 0 : abs(cube.y) == side ? 1 : 2;
    face = 2 * axis + (cube[axis] < 0 ? 1 : 0);
    ivec3 alongU = cube * ivec3(frame.faces[face].u);
    ivec3 alongV = cube * ivec3(frame.faces[face].v);
    grid = (ivec2(alongU.x + alongU.y + alongU.z, alongV.x + alongV.y + alongV.z) + side) / 2;
}

// Returns a position on the sphere. rise: height above the reference step, metres.
vec3 positionOnSphere(FaceUniforms face, GridPlace place, float rise) {
    return face.originM + (frame.referenceRadiusM + rise) * place.turn + rise * face.direction;
}

// Returns a position on the unprojected cube, which fits into the sphere. Heights point away from its centre.
vec3 positionOnCube(FaceUniforms face, GridPlace place, float height) {
    vec3 cube = face.normal + place.coordinates.x * face.u + place.coordinates.y * face.v;
    vec3 fromReference = frame.cubeHalfM * (place.delta.x * face.u + place.delta.y * face.v);
    return face.cubeOriginM + fromReference + height * normalize(cube);
}
