// Returns smoothstep(from, to, x). If from and to are constants, compilers turn the division into a product.
float smoothRise(float from, float to, float x) {
    float t = clamp((x - from) * (1.0 / (to - from)), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}
