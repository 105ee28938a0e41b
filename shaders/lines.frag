// Draws a line's colour, antialiased over one pixel on either side.

in vec4 colour;
noperspective in float aside;

uniform float halfWidthPx;  // half the line's width
uniform float opacity;

out vec4 fragment;

void main() {
    float cover = clamp(halfWidthPx + 0.5 - abs(aside), 0.0, 1.0);
    fragment = vec4(colour.rgb, colour.a * opacity * cover);
}
