// Two pictures of one size in one: beside each other, or their difference.

uniform sampler2D pictureA;
uniform sampler2D pictureB;
uniform ivec3 columns;  // the first column that shows B; how far right of it A's and B's are taken from
uniform bool difference;
uniform float gain;

out vec4 fragment;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    if (difference) {
        vec3 a = texelFetch(pictureA, at, 0).rgb;
        vec3 b = texelFetch(pictureB, at, 0).rgb;
        fragment = vec4(gain * abs(a - b), 1.0);
    } else if (at.x < columns.x) {
        fragment = texelFetch(pictureA, at + ivec2(columns.y, 0), 0);
    } else {
        fragment = texelFetch(pictureB, at + ivec2(columns.z, 0), 0);
    }
}
