// The axes of the cube's faces: planet/sphere/cube_sphere.cpp lists them as axesOfFaces. Faces 0 and 1 are those of x,
// 2 and 3 those of y, 4 and 5 those of z, the positive one first.

float signOf(int face) {
    return (face & 1) == 0 ? 1.0 : -1.0;
}

// Returns a vector, given along a face's normal, u and v, in world axes.
vec3 fromFace(int face, vec3 along) {
    float side = signOf(face);
    return face < 2   ? vec3(side * along.x, side * along.y, along.z)
           : face < 4 ? vec3(-side * along.y, side * along.x, along.z)
                      : vec3(-side * along.z, along.y, side * along.x);
}

// Returns a vector, given in world axes, along a face's normal, u and v.
vec3 alongFace(int face, vec3 world) {
    float side = signOf(face);
    return face < 2   ? vec3(side * world.x, side * world.y, world.z)
           : face < 4 ? vec3(side * world.y, -side * world.x, world.z)
                      : vec3(side * world.z, world.y, -side * world.x);
}

// These do the same in integers, which have more bits than a float.
ivec3 fromFace(int face, ivec3 along) {
    int side = (face & 1) == 0 ? 1 : -1;
    return face < 2   ? ivec3(side * along.x, side * along.y, along.z)
           : face < 4 ? ivec3(-side * along.y, side * along.x, along.z)
                      : ivec3(-side * along.z, along.y, side * along.x);
}

ivec3 alongFace(int face, ivec3 world) {
    int side = (face & 1) == 0 ? 1 : -1;
    return face < 2   ? ivec3(side * world.x, side * world.y, world.z)
           : face < 4 ? ivec3(side * world.y, -side * world.x, world.z)
                      : ivec3(side * world.z, world.y, -side * world.x);
}
