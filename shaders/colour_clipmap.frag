// Fills texels of a clipmap from the resident tiles: from tiles of their own level, or else from coarser
// ones. The page table and the tiles are those of colour_tiles.glsl.

uniform sampler2DArray colourTiles;
uniform usampler2DArray colourPages;
uniform ivec2 firstTexel;  // of the level, at the texture's first texel
uniform int face;
uniform int level;
uniform int leafLevel;

out vec4 colour;

void main() {
    ivec2 texel = firstTexel + ivec2(gl_FragCoord.xy);
    ivec2 cell = clamp(texel >> 8, ivec2(0), ivec2((1 << level) - 1));
    uvec2 page = texelFetch(colourPages, ivec3(cell, face), leafLevel - level).rg;
    int above = level - int(page.g);
    ivec2 within = texel - ((cell >> above) << above) * tileCells;
    if (above == 0) {
        colour = texelFetch(colourTiles, ivec3(within + tileBorderBefore, int(page.r)), 0);
        return;
    }
    vec2 at = (float(tileBorderBefore) + 0.5 + vec2(within) / float(1 << above)) / float(tileTexels);
    colour = textureLod(colourTiles, vec3(at, float(page.r)), 0.0);
}
