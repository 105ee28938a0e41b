// Returns whether a colour image shows open water, [0, 1]: the image contains sea ice, and coasts finer than
// the mesh. Water is blue, and dark or, over shallows, far from grey. Nearly black water is detected by its
// hue alone. colour: linear light.
float waterOf(vec3 colour) {
    float blue = smoothstep(0.0, min(0.008, 0.5 * colour.b + 1e-5), colour.b - 1.15 * colour.r);
    float shallow = smoothRise(1.5, 2.2, colour.b / max(colour.r, 1e-4));
    return blue * max(1.0 - smoothRise(0.10, 0.30, colour.g), shallow);
}
