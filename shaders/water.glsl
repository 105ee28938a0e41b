// What a colour image says is open water, [0, 1]: it knows sea ice, and coasts finer than the mesh. Water is blue,
// and dark or, over shallows, far from grey. Nearly black water counts by its hue alone. Linear light.
float waterOf(vec3 colour) {
    float blue = smoothstep(0.0, min(0.008, 0.5 * colour.b + 1e-5), colour.b - 1.15 * colour.r);
    float shallow = smoothstep(1.5, 2.2, colour.b / max(colour.r, 1e-4));
    return blue * max(1.0 - smoothstep(0.10, 0.30, colour.g), shallow);
}
