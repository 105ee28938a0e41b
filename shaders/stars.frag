// Returns what a star adds to the finished colour of the sky.

flat in vec3 before;
flat in vec3 lit;
flat in float sizePx;

out vec4 fragment;

void main() {
    vec2 awayPx = (gl_PointCoord - 0.5) * sizePx;
    vec3 light = before + lit * exp(-starFall * dot(awayPx, awayPx));
    fragment = vec4(developed(light) - developed(before), 0.0);
}
