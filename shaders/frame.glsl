// What every shader is told once a frame. Metres and world axes; positions are relative to the eye.

struct FaceFrame {
    ivec4 grid;        // xy: the reference point on the fine grid
    vec4 coordinates;  // xy: the same as cube coordinates u0, v0
    vec4 roots;        // xyz: square roots of Nowell's map there: along normal, u and v
    vec4 direction;    // xyz: d0
    vec4 origin;       // xyz: reference point - eye
    vec4 cubeOrigin;   // xyz: the same on the cube that is not blown up
    vec4 normal;       // the face's axes
    vec4 u;
    vec4 v;
};

layout(std140) uniform Frame {
    FaceFrame faces[6];
    mat4 clipFromWorld;  // without the translation
    vec4 eye;            // xyz: from the planet's centre
    vec4 sun;            // xyz: unit
    vec4 rayForward;     // a pixel's ray: forward + x right + y up, with x and y in [-1, 1]
    vec4 rayRight;
    vec4 rayUp;
    vec4 planet;      // radius; quantum; reference radius; half side of the cube
    vec4 heights;     // height of step 0; 1 / the top of the ramp; relief boost of the lighting; the sea level
    vec4 atmosphere;  // radius / scale height; 1 / scale height; 1 where drawn; 1 near the ground, 0 in space
    vec4 eyeUp;       // xyz: unit; height of the eye, scale heights, 0 or more
    vec4 screen;      // angle of a pixel, radians; depth of the sky in clip space; unused
    vec4 detailRows[9];  // three octaves, three rows each: place in the noise = rows (position, 1)
    vec4 detailSizes;    // metres that each octave's noise covers once; unused
    vec4 detailPixels;   // pixels x metres that a step of heights and of the image covers; a step of the image,
                         // [0, 1] across a face; unused
    ivec4 grid;          // reference step; log2 of cells a chunk side; stops of the ramp; unused
    vec4 surfacing;      // opacity of the image over the ramp; 1 where the ramp colours the sea too; rise of the
                         // sea level over the reference step, metres; strength of the fill light
    vec4 rampColours[32];  // of the stops: roots of linear light; unused
    vec4 rampRises[32];  // of each: height of the one before, above the sea level; 1 / metres from there; unused
    ivec4 colouring;     // finest level of streamed colours; unused
    vec4 colourFilter;   // anisotropy of their sampler; levels finer than one texel a pixel; unused
    ivec4 normalLevels;  // finest level of tiles of normals; unused
    vec4 normalFilter;   // as of colours; metres that a slope of 1 rises along 1 of u or v; unused
};

// A program is compiled for the switches it is drawn with, in the constant variant: what is off costs nothing,
// also where a branch is no saving.
const int switchLighting = 1;
const int switchWireframe = 2;
const int switchCube = 4;
const int switchImage = 8;
const int switchSea = 16;
const int switchAir = 32;
const int switchTint = 64;
const int switchLightByVertex = 128;  // triangles are small enough to work light and air out at their corners
const int switchDetail = 256;
const int switchFineDetail = 512;     // its last octave, too
const int switchRamp = 1024;          // the ramp's own stops
const int switchImageOverRamp = 2048;  // some of the ramp shows through the image
const int switchOutlines = 4096;
const int switchLoudSkirts = 8192;
const int switchSlide = 16384;         // some vertices morph, or move onto a coarser neighbour's
const int switchMorph = 32768;         // some morph: light does, too
const int switchGather = 65536;        // edges that morph let vertices go as a coarser chunk's stitched edge does
const int switchTiles = 131072;        // the image is streamed in tiles (colour_tiles.glsl)
const int switchPhysicalAir = 262144;  // the air of air.glsl, not the thin one
const int switchSeaSurface = 524288;   // the sea is drawn at its level, as water (sea.glsl)
const int switchShadows = 1048576;     // the ground's on itself (shadows.glsl)
const int switchNormalTiles = 2097152;   // normals finer than the mesh (normal_tiles.glsl)
const int switchLayers = 16777216;       // texture layers (layers.glsl)
const int switchLayerPreview = 33554432;
const int switchClipmap = 1073741824;    // of streamed tiles: from a clipmap (colour_clipmap.glsl)

bool isOn(int bit) {
    return (variant & bit) != 0;
}
