// A line's colour, fading over the pixel at either side.

in vec4 colour;
noperspective in float aside;

uniform float halfWidthPx;  // of the line
uniform float opacity;

out vec4 fragment;

void main() {
    float cover = clamp(halfWidthPx + 0.5 - abs(aside), 0.0, 1.0);
    fragment = vec4(colour.rgb, colour.a * opacity * cover);
}
