// What vertices and pixels both work out about light on the ground.

float steepness(vec3 normal, vec3 up) {
    return smoothstep(0.08, 0.45, 1.0 - dot(normal, up));
}

// The sun mirrored in open sea, over its light: a core and a faint halo.
float seaGlint(vec3 normal, vec3 toEye) {
    vec3 middle = normalize(toEye + sun.xyz);
    float halo = exp(-62.0 * (1.0 - dot(normal, middle)));
    float aside = 1.0 - max(dot(middle, toEye), 0.0);
    float squared = aside * aside;
    float fresnel = 0.02 + 0.5 * squared * squared * aside;
    float core = halo * halo * halo * halo;
    return fresnel * (7.0 * core + 0.7 * halo);
}
