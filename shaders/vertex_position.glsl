// Mirrors planet/sphere/vertex_position.cpp line by line; planet/sphere/vertex_position.h explains the
// method.

const float fineCell = 2.0 / float(1 << fineGridLog2);

// A point of the fine grid, on the face with the lowest index that contains it. So all faces compute the same position
// of a point on an edge or a corner of the cube.
struct OwnedPoint {
    int face;
    ivec2 grid;
};

OwnedPoint ownedPoint(int face, ivec2 grid) {
    const int side = 1 << fineGridLog2;
    ivec3 cube = fromFace(face, ivec3(side, 2 * grid - side));
    int axis = abs(cube.x) == side ? 0 : abs(cube.y) == side ? 1 : 2;
    int along = axis == 0 ? cube.x : axis == 1 ? cube.y : cube.z;
    int owner = 2 * axis + (along < 0 ? 1 : 0);
    return OwnedPoint(owner, (alongFace(owner, cube).yz + side) / 2);
}

// The position of a vertex on its face.
struct GridPlace {
    vec2 delta;        // u - u0, v - v0, to the precision of a float
    vec2 coordinates;  // u, v, likewise
    vec3 roots;        // of Nowell's mapping at (u, v)
    vec3 turn;         // d - d0, world axes
};

GridPlace gridPlace(OwnedPoint point) {
    FaceUniforms face = frame.faces[point.face];
    GridPlace place;
    vec2 start = face.coordinates;
    place.delta = vec2(point.grid - face.grid) * fineCell;
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
    place.turn = fromFace(point.face, vec3(alongNormal, along));
    return place;
}

// Returns a position on the sphere. rise: height above the reference step, metres.
vec3 positionOnSphere(int face, GridPlace place, float rise) {
    return frame.faces[face].originM + (frame.referenceRadiusM + rise) * place.turn +
           rise * frame.faces[face].direction;
}

// Returns a position on the unprojected cube, which fits into the sphere. Heights point away from its centre.
vec3 positionOnCube(int face, GridPlace place, float height) {
    vec3 cube = fromFace(face, vec3(1.0, place.coordinates));
    vec3 fromReference = frame.cubeHalfM * fromFace(face, vec3(0.0, place.delta));
    return frame.faces[face].cubeOriginM + fromReference + height * normalize(cube);
}
