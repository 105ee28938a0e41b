// The lighting of the ground that vertex and fragment shaders share.

// Returns a unit vector for one that is nearly of unit length, such as a mix of unit vectors. Two steps of Newton's
// method replace the square root: the error is below 0.1 % for mixes of vectors that are 60 degrees apart. Vectors that
// multisampling extrapolates may have any length.
vec3 renormalised(vec3 v) {
    if (switchMultisampled) return normalize(v);
    float squared = dot(v, v);
    float once = 1.5 - 0.5 * squared;
    return v * (once * (1.5 - 0.5 * squared * once * once));
}

float steepness(vec3 normal, vec3 up) {
    return smoothRise(0.08, 0.45, 1.0 - dot(normal, up));
}

// Returns the sun's reflection in open sea, relative to its light: a core and a faint halo.
float seaGlint(vec3 normal, vec3 toEye) {
    // The cosines to the middle between the directions to the eye and to the sun.
    float between = dot(toEye, shading.sun);
    float perLength = inversesqrt(2.0 + 2.0 * between);
    float toMiddle = dot(normal, toEye + shading.sun) * perLength;
    float halo = exp(-62.0 * (1.0 - toMiddle));
    float aside = 1.0 - (1.0 + between) * perLength;
    float squared = aside * aside;
    float fresnel = 0.02 + 0.5 * squared * squared * aside;
    float core = halo * halo * halo * halo;
    return fresnel * (7.0 * core + 0.7 * halo);
}

// Returns the debug light for ground where the sun is down. It comes from the upper left of the view, so that
// slopes look as on a shaded map.
float fillLight(vec3 normal, vec3 toEye, vec3 up) {
    if (!switchFill) return 0.0;
    float night = 1.0 - smoothRise(-0.10, 0.15, dot(up, shading.sun));
    vec3 from = normalize(toEye + 0.7 * (normalize(frame.rayUp) - normalize(frame.rayRight)));
    return 2.0 * frame.fill * night * (0.2 + 0.8 * max(dot(normal, from), 0.0));
}

// Returns the cross product of the tangents of (R + h) d(u, v), divided by R + h. On an edge of the cube the
// axes are those of the chunk's face, whichever face computes the position.
vec3 normalOnSphere(int face, vec2 coordinates, vec3 d, float radius, vec2 heightSlope) {
    float u = coordinates.x;
    float v = coordinates.y;
    vec3 roots = sqrt(vec3(1.0 - 0.5 * (u * u + v * v) + u * u * v * v * (1.0 / 3.0),
                           0.5 - v * v * (1.0 / 6.0), 0.5 - u * u * (1.0 / 6.0)));
    float cross6 = -u * v * (1.0 / 6.0);
    vec3 along = vec3(u * (v * v * (1.0 / 3.0) - 0.5) / roots.x, roots.y, cross6 / roots.z);
    vec3 across = vec3(v * (u * u * (1.0 / 3.0) - 0.5) / roots.x, cross6 / roots.y, roots.z);
    vec3 du = fromFace(face, along);
    vec3 dv = fromFace(face, across);
    return radius * cross(du, dv) + heightSlope.x * cross(d, dv) + heightSlope.y * cross(du, d);
}
