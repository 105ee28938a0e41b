// The inputs of a frame; planet/gl/draw/frame_uniforms.h has structs with the same members. Lengths are in
// metres, in world axes, and positions are relative to the eye.

struct FaceUniforms {
    ivec2 grid;        // reference point on the fine grid
    vec2 coordinates;  // of the reference point: u0, v0
    vec3 roots;        // square roots of Nowell's mapping at it: along normal, u and v
    vec3 direction;    // d0
    vec3 originM;      // reference point - eye
    vec3 cubeOriginM;  // the same for the unprojected cube
};

struct RampUniforms {
    vec3 root;     // of linear light
    float startM;  // height of the previous stop, above the sea level
    float perM;    // 1 / metres from there to this stop
};

struct TileSampling {
    int leafLevel;      // the finest level
    float anisotropy;   // of the sampler
    float extraLevels;  // levels finer than one texel per pixel
};

// The values of a frame that the shading of most pixels reads.
struct ShadingFrame {
    vec3 sun;                  // unit vector
    float nearGround;          // 1 near the ground, 0 in space
    vec3 eyeUp;                // unit vector
    float eyeScaleHeights;     // height of the eye, >= 0
    vec3 eyeM;                 // from the planet's centre
    float scaleHeightsPerM;
    float eyeGrazing;          // air mass along the horizontal at the eye, of that straight up (grazingAt)
    float eyeAir;              // air mass straight up from the eye
    float seaLevelM;
    float earthRadii;          // the Earth's radius in radii of the planet
    float perRampTopM;         // 1 / height of the built-in ramp's highest band
    float imageStep;           // one step of the image, [0, 1] across a face
    vec4 coarseDetail;         // an octave of the detail: the eye's place in the noise, and its period in metres
    vec4 middleDetail;
    vec4 fineDetail;
    float heightStepPxM;       // pixels x metres: the size of a step of the heights at a distance of one metre
    float imageStepPxM;        // the same for a step of the image
    TileSampling colours;
};

layout(std140) uniform Frame {
    FaceUniforms faces[faceCount];
    mat4 clipFromWorld;  // without the translation
    ShadingFrame shading;
    vec3 rayForward;  // ray of a pixel: forward + x right + y up, with x and y in [-1, 1]
    vec3 rayRight;
    vec3 rayUp;
    float pixelRad;  // angle of one pixel
    float skyDepth;  // in clip space

    float radiusM;
    float referenceRadiusM;
    float cubeHalfM;  // half a side of the unprojected cube
    float quantumM;
    int referenceStep;
    float baseHeightM;  // of step 0
    float seaRiseM;     // sea level above the reference step
    int chunkCellsLog2;
    float reliefBoost;  // factor by which lighting steepens slopes
    float fill;         // strength of the fill light

    float imageOpacity;  // over the ramp

    RampUniforms ramp[maxRampStops];
    int rampStopCount;
    float rampColoursSea;  // 1: the ramp's stops colour the sea too

    TileSampling normals;
    float normalRiseM;  // rise of a slope of 1 along 1 of u or v
} frame;

// Each main function sets this first: from the uniforms, or with switchHeldFrame from the vertices. Mesa's llvmpipe loads
// a uniform again at each pixel, which takes about 30 instructions, but a flat input once per triangle.
ShadingFrame shading;
