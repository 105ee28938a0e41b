// Texture layers: the weight of each at a pixel, and its appearance. The weights mirror those of
// planet/surface/layer_set.h, the reference in doubles.

// planet/gl/draw/layer_uniforms.h has structs with the same members.
struct LineUniforms {
    float lowest;   // value where the lower edge begins
    float rise;     // 1 / width of the lower edge
    float highest;  // value where the upper edge ends
    float fall;
};

struct LayerUniforms {
    LineUniforms heightLines;
    LineUniforms slopeLines;
    LineUniforms latitudeLines;
    vec3 tint;  // linear light
    float opacity;
    vec3 mean;  // mean linear albedo, tinted
    float repeatM;
    float noiseAmount;
    int noiseField;
    int noiseComponent;
    int slice;  // index in the textures
};

struct NoiseOctave {
    ivec3 cell;  // the eye's cell
    float cellsPerM;
    vec3 inside;  // the eye's position in its cell
};

struct RepeatUniforms {
    vec3 eye;  // the eye's position in the repeat
    float perM;
};

layout(std140) uniform Layers {
    int count;  // number of drawn layers
    int noiseFieldCount;
    int previewed;      // -1: none
    int previewsMask;   // 1: the preview is a mask
    float fadeBeginM;   // distance at which the layers begin to fade
    float perFadeM;     // 1 / metres from there to their end
    float opacity;
    float sharpness;    // of the blend by height; 0: blend by weight
    float trueHeight;   // true height / drawn height
    float trueSlope;    // true slope / lit slope
    float colourBelow;  // share of the ground's own colour
    float repeatRad;    // smallest angle of a repeat, as long as there are larger repeats
    LayerUniforms layers[maxLayers];
    NoiseOctave noise[3 * maxLayers];  // three octaves of each field
    RepeatUniforms repeats[maxLayers * layerRepeatLevels];
} layerSet;

uniform sampler2DArray layerAlbedo;   // sRGB and relief
uniform sampler2DArray layerSurface;  // normal's x and y; roughness; unused

// Mirrors planet/surface/layer_noise.h, with the eye's cell as integers: at the Earth's radius, floats cannot
// distinguish cells.
vec4 latticeValue(ivec3 cell) {
    uint h = uint(cell.x) * 0x8DA6B343u + uint(cell.y) * 0xD8163841u + uint(cell.z) * 0xCB1AB31Fu;
    h = (h ^ (h >> 16u)) * 0x7FEB352Du;
    h = (h ^ (h >> 15u)) * 0x846CA68Bu;
    h ^= h >> 16u;
    return vec4(uvec4(h, h >> 8u, h >> 16u, h >> 24u) & 0xFFu) / 127.5 - 1.0;
}

vec4 valueNoise(ivec3 eyeCell, vec3 place) {
    vec3 whole = floor(place);
    ivec3 cell = eyeCell + ivec3(whole);
    vec3 inside = place - whole;
    vec3 t = inside * inside * (3.0 - 2.0 * inside);
    vec4 row00 = mix(latticeValue(cell), latticeValue(cell + ivec3(1, 0, 0)), t.x);
    vec4 row10 = mix(latticeValue(cell + ivec3(0, 1, 0)), latticeValue(cell + ivec3(1, 1, 0)), t.x);
    vec4 row01 = mix(latticeValue(cell + ivec3(0, 0, 1)), latticeValue(cell + ivec3(1, 0, 1)), t.x);
    vec4 row11 = mix(latticeValue(cell + ivec3(0, 1, 1)), latticeValue(cell + ivec3(1, 1, 1)), t.x);
    return mix(mix(row00, row10, t.y), mix(row01, row11, t.y), t.z);
}

vec4 octaveNoise(int at, vec3 position) {
    NoiseOctave octave = layerSet.noise[at];
    return valueNoise(octave.cell, octave.inside + position * octave.cellsPerM);
}

vec4 fieldNoise(int field, vec3 position) {
    return 0.56 * octaveNoise(3 * field, position) + 0.28 * octaveNoise(3 * field + 1, position) +
           0.16 * octaveNoise(3 * field + 2, position);
}

float alongRange(LineUniforms lines, float value, float shift) {
    return clamp((value - lines.lowest) * lines.rise + shift, 0.0, 1.0) *
           clamp((lines.highest - value) * lines.fall + shift, 0.0, 1.0);
}

// Computes the weight of each drawn layer; the ground below has the rest to 1. height: above the sea, as
// drawn. normal: as lit, unit vector.
void layerWeightsAt(vec3 position, vec3 up, vec3 normal, float height, out float weights[maxLayers]) {
    vec4 noises[maxLayers];
    for (int field = 0; field < layerSet.noiseFieldCount; ++field) noises[field] = fieldNoise(field, position);
    float upright = max(dot(normal, up), 1e-4);
    float slope = degrees(atan(length(normal - up * dot(normal, up)) / upright * layerSet.trueSlope));
    float latitude = degrees(atan(up.z, length(up.xy)));
    float open = 1.0;
    for (int i = maxLayers - 1; i >= 0; --i) weights[i] = 0.0;
    for (int i = layerSet.count - 1; i >= 0; --i) {
        LayerUniforms layer = layerSet.layers[i];
        float shift = layer.noiseAmount > 0.0
                          ? layer.noiseAmount * noises[layer.noiseField][layer.noiseComponent]
                          : 0.0;
        float covers = layer.opacity * alongRange(layer.heightLines, height * layerSet.trueHeight, shift) *
                       alongRange(layer.slopeLines, slope, shift) *
                       alongRange(layer.latitudeLines, latitude, shift);
        weights[i] = covers * open;
        open *= 1.0 - covers;
    }
}

struct Layered {
    vec3 albedo;
    vec3 tilt;        // slope of the relief, world axes
    float roughness;
    float amount;     // opacity over the ground below, [0, 1]
};

// The sum of the layers so far, weighted by shares.
struct LayerSum {
    vec3 albedo;
    vec3 mean;
    vec3 tilt;
    float roughness;
    float shares;
};

vec2 onPlane(vec3 v, int plane) {
    return plane == 0 ? v.yz : plane == 1 ? v.zx : v.xy;
}

vec3 offPlane(vec2 v, int plane) {
    return plane == 0 ? vec3(0.0, v) : plane == 1 ? vec3(v.y, 0.0, v.x) : vec3(v, 0.0);
}

// Adds a layer's textures, projected along one of the planet's three axes, at the two repeats for the
// distance. A repeat covers about the same number of pixels at any distance, and mixing two repeats hides the
// pattern of either.
void layDown(int i, int plane, float weight, float share, vec3 position, mat2x3 steps, inout LayerSum sum) {
    float slice = float(layerSet.layers[i].slice);
    float wanted = max(layerSet.repeatRad * length(position) / layerSet.layers[i].repeatM, 1.0);
    float level = min(log2(wanted) / log2(layerRepeatLevelStep), float(layerRepeatLevels) - 1.001);
    int first = i * layerRepeatLevels + int(level);
    vec4 albedo[2];
    vec4 detail[2];
    for (int k = 0; k < 2; ++k) {
        RepeatUniforms repeat = layerSet.repeats[first + k];
        vec3 at = vec3(onPlane(repeat.eye + position * repeat.perM, plane), slice);
        vec2 alongX = onPlane(steps[0] * repeat.perM, plane);
        vec2 alongY = onPlane(steps[1] * repeat.perM, plane);
        albedo[k] = textureGrad(layerAlbedo, at, alongX, alongY);
        detail[k] = textureGrad(layerSurface, at, alongX, alongY);
    }
    float coarse = smoothstep(0.0, 1.0, fract(level));
    vec4 colour = mix(albedo[0], albedo[1], coarse);
    vec4 normal = mix(detail[0], detail[1], coarse);
    vec2 bent = (normal.xy * 255.0 - 128.0) / 127.0;
    // Green points up in the picture, against the order of rows.
    vec2 slope = vec2(-bent.x, bent.y) * inversesqrt(max(1.0 - dot(bent, bent), 0.05));
    // Larger repeats stand for wider ground, which is flatter.
    slope *= exp2(-0.35 * level);
    float part = share * exp(layerSet.sharpness * (colour.a + weight - 1.0));
    sum.albedo += part * colour.rgb * layerSet.layers[i].tint;
    sum.mean += part * layerSet.layers[i].mean;
    sum.tilt += part * offPlane(slope, plane);
    sum.roughness += part * normal.z;
    sum.shares += part;
}

// Returns the shares of the three planes. They are sharp, so that flat ground mostly needs one plane.
vec3 planeShares(vec3 normal) {
    vec3 steep = normal * normal;
    steep *= steep;
    steep *= steep;
    vec3 shares = max(steep / (steep.x + steep.y + steep.z) - 0.02, 0.0);
    return shares / (shares.x + shares.y + shares.z);
}

// Returns the layers' material. below: the colour of the ground that they are painted on.
Layered layeredGround(vec3 position, vec3 up, vec3 normal, float height, vec3 below) {
    mat2x3 steps = mat2x3(dFdx(position), dFdy(position));
    float away = length(position);
    float weights[maxLayers];
    layerWeightsAt(position, up, normal, height, weights);
    vec3 planes = planeShares(normal);
    float total = 0.0;
    LayerSum sum = LayerSum(vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0);
    // Collects the visible layers and planes first, so that a pixel with one layer on one plane takes one
    // iteration.
    int wanted[3 * maxLayers];
    int count = 0;
    for (int i = 0; i < layerSet.count; ++i) {
        total += weights[i];
        for (int plane = 0; plane < 3; ++plane) {
            if (weights[i] * planes[plane] > 0.004) wanted[count++] = 3 * i + plane;
        }
    }
    for (int k = 0; k < count; ++k) {
        int i = wanted[k] / 3;
        int plane = wanted[k] - 3 * i;
        layDown(i, plane, weights[i], weights[i] * planes[plane], position, steps, sum);
    }
    float fade = 1.0 - clamp((away - layerSet.fadeBeginM) * layerSet.perFadeM, 0.0, 1.0);
    // Shares may be as small as e^-80.
    float each = sum.shares > 0.0 ? 1.0 / sum.shares : 0.0;
    vec3 albedo = sum.albedo * each;
    // Applies the layers' luminance to the colour below, which keeps its hue.
    const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
    vec3 coloured = below * dot(albedo, luminance) / max(dot(sum.mean * each, luminance), 0.01);
    albedo = mix(albedo, min(coloured, vec3(1.0)), layerSet.colourBelow);
    return Layered(albedo, sum.tilt * each, sum.roughness * each,
                   sum.shares > 0.0 ? total * fade * layerSet.opacity : 0.0);
}

// Returns the sun's reflection in a surface that is not fully rough, relative to its light: Blinn and Phong's
// lobe, with the width of the roughness, and Schlick's Fresnel term from 0.04.
float layerGlint(vec3 normal, vec3 toEye, float roughness) {
    vec3 middle = toEye + shading.sun;
    middle *= inversesqrt(max(dot(middle, middle), 1e-6));
    float wide = max(roughness * roughness, 0.02);
    float power = 2.0 / (wide * wide) - 2.0;
    float aside = 1.0 - max(dot(middle, toEye), 0.0);
    float squared = aside * aside;
    float fresnel = 0.04 + 0.96 * squared * squared * aside;
    float facing = max(dot(normal, shading.sun), 0.0);
    return facing * fresnel * (power + 2.0) / 8.0 * pow(max(dot(normal, middle), 0.0), max(power, 0.01));
}

// Returns a colour from dark violet through green to yellow.
vec3 heatOf(float weight) {
    vec3 low = vec3(0.15, 0.03, 0.30);
    vec3 middle = vec3(0.10, 0.56, 0.50);
    vec3 high = vec3(0.99, 0.91, 0.15);
    return weight < 0.5 ? mix(low, middle, 2.0 * weight) : mix(middle, high, 2.0 * weight - 1.0);
}

// Returns the previewed layer's weight as colours over the picture, or alone as a mask.
vec3 layerPreview(vec3 colour, vec3 position, vec3 up, vec3 normal, float height) {
    float weights[maxLayers];
    layerWeightsAt(position, up, normal, height, weights);
    float weight = layerSet.previewed < 0 ? 0.0 : weights[layerSet.previewed];
    if (layerSet.previewsMask != 0) return vec3(weight);
    return mix(colour, heatOf(weight), 0.45 + 0.35 * weight);
}
