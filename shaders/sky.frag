// Draws the atmosphere along rays that pass the planet.

in vec3 skyRay;
flat in ShadingFrame held;
flat in float pixelRad;

out vec4 fragment;

void main() {
    shading = held;
    vec3 light = skyAlong(normalize(skyRay), pixelRad).light;
    fragment = vec4(developed(max(light, 0.0)) + ditherStep() * step(0.002, light.b), 1.0);
}
