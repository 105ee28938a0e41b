// Combines two pictures of one size: side by side, or as their difference.

uniform sampler2D pictureA;
uniform sampler2D pictureB;
uniform int border;  // the first column that shows B
uniform int shiftA;  // columns by which A's pixels are read further right
uniform int shiftB;
uniform bool difference;
uniform float gain;

out vec4 fragment;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    if (difference) {
        vec3 a = texelFetch(pictureA, at, 0).rgb;
        vec3 b = texelFetch(pictureB, at, 0).rgb;
        fragment = vec4(gain * abs(a - b), 1.0);
    } else if (at.x < border) {
        fragment = texelFetch(pictureA, at + ivec2(shiftA, 0), 0);
    } else {
        fragment = texelFetch(pictureB, at + ivec2(shiftB, 0), 0);
    }
}
