// Counts, for a block of two pictures, the pixels that differ by more than one 8-bit step in a channel, and
// finds the largest difference in steps.

uniform sampler2D pictureA;
uniform sampler2D pictureB;
uniform int blockSize;

out uvec2 counted;

void main() {
    ivec2 size = textureSize(pictureA, 0);
    ivec2 from = ivec2(gl_FragCoord.xy) * blockSize;
    ivec2 end = min(from + blockSize, size);
    counted = uvec2(0u);
    for (int y = from.y; y < end.y; ++y) {
        for (int x = from.x; x < end.x; ++x) {
            vec3 apart = abs(texelFetch(pictureA, ivec2(x, y), 0).rgb - texelFetch(pictureB, ivec2(x, y), 0).rgb);
            uint steps = uint(255.0 * max(apart.r, max(apart.g, apart.b)) + 0.5);
            counted.x += steps > 1u ? 1u : 0u;
            counted.y = max(counted.y, steps);
        }
    }
}
