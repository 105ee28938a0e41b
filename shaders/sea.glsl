// The sea's surface at any distance: light reflected by waves, and light from within the water.
//
// Waves that a pixel can resolve tilt the surface. The slopes of all others follow a normal distribution,
// whose variance grows with the wind (Cox and Munk, "Measurement of the roughness of the sea surface from
// photographs of the sun's glitter", 1954). It spreads the sun's glint and the reflected sky (Bruneton,
// Neyret and Holzschuch, "Real-time realistic ocean lighting using seamless transitions from geometry to
// BRDF", 2010).

// planet/gl/draw/sea_uniforms.h has structs with the same members.
struct WaveUniforms {
    vec3 vector;      // radians per metre, world axes
    float phase;      // at the eye
    vec3 bendVector;  // of a long wave that bends this one, so that no pattern continues
    float bendPhase;
};

layout(std140) uniform Sea {
    WaveUniforms waves[seaWaveCount];
    vec3 extinction;       // of red, green and blue, 1 / metre
    float perExaggeration; // 1 / exaggeration
    float slopeVariance;   // of all waves
    float waveSlope;       // largest slope of one wave
} seaState;

// The albedo of a bed without an image.
const vec3 sandyBed = vec3(0.30, 0.27, 0.19);

struct Waves {
    vec3 tilt;       // slope of the resolved waves, world axes, along the surface
    float variance;  // of the slopes of the other waves, summed over both axes
};

Waves wavesAt(vec3 position, vec3 up) {
    vec3 acrossX = dFdx(position);
    vec3 acrossY = dFdy(position);
    Waves seen = Waves(vec3(0.0), seaState.slopeVariance);
    for (int i = 0; i < seaWaveCount; ++i) {
        vec3 k = seaState.waves[i].vector;
        float turn = max(abs(dot(k, acrossX)), abs(dot(k, acrossY)));  // radians from pixel to pixel
        float share = 1.0 - smoothRise(0.4, 1.8, turn);
        if (share == 0.0) continue;
        vec3 along = k - up * dot(k, up);
        float slope = seaState.waveSlope * share;
        vec3 tilt = along * (slope * inversesqrt(dot(k, k)));
        float bend = 2.2 * sin(dot(seaState.waves[i].bendVector, position) + seaState.waves[i].bendPhase);
        seen.tilt += tilt * cos(dot(k, position) + seaState.waves[i].phase + bend);
        seen.variance -= 0.5 * dot(tilt, tilt);
    }
    seen.variance = max(seen.variance, 0.1 * seaState.slopeVariance);
    return seen;
}

// Returns the mean Fresnel reflectance over slopes with a variance: equation 16 of Bruneton et al.
float seaFresnel(float cosine, float variance) {
    float deviation = sqrt(variance);
    return 0.02 + 0.98 * pow(1.0 - cosine, 5.0 * exp(-2.69 * deviation)) / (1.0 + 22.7 * pow(deviation, 1.5));
}

// Returns the sun's light reflected by slopes with a variance. Irradiance is in units of pi, as in sunLit.
vec3 sunGlitter(vec3 normal, vec3 toEye, vec3 sunlight, float variance) {
    vec3 middle = normalize(toEye + shading.sun);
    float across = max(dot(middle, normal), 1e-3);
    float across2 = across * across;
    float slope2 = (1.0 - across2) / across2;
    float density = exp(-slope2 / variance) / variance;  // the 1 / pi cancels with the light's pi
    float aside = 1.0 - max(dot(middle, toEye), 0.0);
    float fresnel = 0.02 + 0.98 * aside * aside * aside * aside * aside;
    // At grazing angles waves hide one another, so the eye sees no more than their tilt turns towards it.
    float seenCosine = max(dot(normal, toEye), 0.35 * sqrt(variance));
    float lit = smoothRise(0.0, 0.06, dot(normal, shading.sun));
    return sunlight * (lit * fresnel * density / (4.0 * seenCosine * across2 * across2));
}

// Returns the light that leaves water of a depth, metres: the bed's, attenuated on the way down and up, and
// the light scattered by the water itself.
vec3 fromWater(float depth, vec3 bed, vec3 downwelling) {
    const vec3 deep = vec3(0.0022, 0.014, 0.040);  // reflectance of a sea without a bed
    vec3 kept = exp(-2.0 * seaState.extinction * depth);
    return downwelling * mix(deep, bed, kept);
}

// Returns the sea's light. height: of the ground below, metres above the sea level, as drawn. bed: its
// albedo.
vec3 seaLight(vec3 position, vec3 ray, vec3 up, float height, vec3 bed, vec3 sunlight, vec3 skylight) {
    Waves waves = wavesAt(position, up);
    vec3 normal = normalize(up - waves.tilt);
    vec3 toEye = -ray;
    // Bends the normal of a wave that faces away from the eye, because another wave hides it.
    float cosine = dot(normal, toEye);
    if (cosine < 0.02) normal = normalize(normal + toEye * (0.02 - cosine));
    cosine = clamp(dot(normal, toEye), 0.02, 1.0);
    float mirrored = seaFresnel(cosine, waves.variance);
    vec3 direction = reflect(ray, normal);
    direction = normalize(direction + up * (max(-dot(direction, up), 0.0) + 0.5 * sqrt(waves.variance)));
    vec3 downwelling = sunlight * max(dot(up, shading.sun), 0.0) + skylight;
    vec3 below = fromWater(max(-height, 0.0) * seaState.perExaggeration, bed, downwelling);
    return mix(below, skyRadianceAlong(direction, up), mirrored) +
           sunGlitter(normal, toEye, sunlight, waves.variance);
}
