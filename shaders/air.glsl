// The physical atmosphere, as in planet/surface/atmosphere.h: single scattering summed along the ray,
// multiple scattering and the sun's transmittance from tables.
//   Bruneton and Neyret, "Precomputed Atmospheric Scattering" (EGSR 2008), with the table of transmittance of
//   the revision of 2017
//   Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique" (EGSR 2020)
//
// Lengths are kilometres of the Earth (air.kmPerM of them per metre), heights are above the planet's radius.
// A rise is the cosine of a direction to the zenith. Light has the unit of the tone mapping: air.light is the
// light that a white level square reflects if the unattenuated sun stands at the zenith.

// AirUniforms in planet/gl/store/air_textures.h has the same members.
layout(std140) uniform Air {
    vec3 rayleigh;            // scattering coefficient at height 0, 1 / km
    float perRayleighHeight;  // 1 / scale height
    vec3 ozone;               // absorption coefficient at its densest, 1 / km
    float perOzoneHalf;       // 1 / half the layer's depth
    float ozoneMiddleKm;      // height of the densest layer
    float hazeScattered;      // Mie: scattering coefficient at height 0, 1 / km
    float hazeTaken;          // Mie: extinction coefficient at height 0, 1 / km
    float perHazeHeight;      // 1 / scale height
    float forward;            // asymmetry g
    float radiusKm;           // of the planet
    float topKm;              // height of the top of the atmosphere
    float farthestKm;         // longest distance from height 0 to the top
    float kmPerM;
    vec3 light;               // of the sun
    float steps;              // along a ray through the whole atmosphere
    vec3 eyeUp;               // unit vector
    float eyeKm;              // height of the eye, >= 0
    vec3 skySize;             // texels of the tables; of the sky's table: rises, sides, suns
    float glowSize;
    vec2 transmittanceSize;
} air;

uniform sampler2D airTransmittance;
uniform sampler2DArray airGlow;
uniform sampler3D airSky;

// The light of a moonless night, so that the dark side is not pitch-black.
const vec3 nightLight = vec3(0.0025, 0.003, 0.0045);

vec3 clearTo(float height, float rise) {
    float inside = min(height, air.topKm);
    float radius = air.radiusKm + inside;
    float squared = inside * (radius + air.radiusKm);
    float along = radius * rise;
    float most = air.farthestKm;
    float toEnd = sqrt(max(along * along + most * most - squared, 0.0)) - along;
    float horizon = sqrt(squared);
    float nearest = air.topKm - inside;
    vec2 place = clamp(vec2((toEnd - nearest) / (horizon + most - nearest), horizon / most), 0.0, 1.0);
    vec2 halfTexel = 0.5 / air.transmittanceSize;
    return textureLod(airTransmittance, mix(halfTexel, 1.0 - halfTexel, place), 0.0).rgb;
}

// Returns the transmittance of the sun's light at a height; 0 behind the ground.
vec3 sunThroughAir(float height, float sunRise) {
    float above = max(height, 0.0);
    float radius = air.radiusKm + above;
    float overHorizon = sunRise + sqrt(above * (radius + air.radiusKm)) / radius;
    float soft = 0.004654 * air.radiusKm / radius;  // the sun's angular radius
    return clearTo(above, sunRise) * smoothstep(-soft, soft, overHorizon);
}

vec2 glowPlace(float height, float sunRise) {
    float sun = 0.5 + 0.5 * sign(sunRise) * sqrt(min(abs(sunRise), 1.0));
    vec2 place = vec2(sun, sqrt(clamp(height / air.topKm, 0.0, 1.0)));
    return mix(vec2(0.5 / air.glowSize), vec2(1.0 - 0.5 / air.glowSize), place);
}

// Returns the sky's light that a white level square reflects.
vec3 skyIrradianceAt(float height, float sunRise) {
    return air.light * textureLod(airGlow, vec3(glowPlace(height, sunRise), 1.0), 0.0).rgb + nightLight;
}

// Returns the sky's radiance from low ground in a direction, by one lookup, without the sun's disk. Below the
// horizon, it is the horizon's. direction, up: unit vectors. Uses the analytic atmosphere if that is drawn,
// and returns 0 if none is.
vec3 skyRadianceAlong(vec3 direction, vec3 up) {
    float rise = clamp(dot(direction, up), 0.0, 1.0);
    if (!switchPhysicalAir) {
        if (!switchAir) return vec3(0.0);
        return scattered(airAbove(0.0, rise), scattering, sunOnAir(up * (radiusScaleHeights + 1.5)),
                         dot(direction, shading.sun));
    }
    float sunRise = dot(shading.sun, up);
    float aside = sqrt(max((1.0 - rise * rise) * (1.0 - sunRise * sunRise), 1e-6));
    float turn = clamp((dot(direction, shading.sun) - rise * sunRise) / aside, -1.0, 1.0);
    float sunPlace = 0.5 + 0.5 * sign(sunRise) * sqrt(min(abs(sunRise), 1.0));
    vec3 place = vec3(sqrt(rise), sqrt(0.5 - 0.5 * turn), sunPlace);
    place = mix(0.5 / air.skySize, 1.0 - 0.5 / air.skySize, place);
    return air.light * (3.14159265 * textureLod(airSky, place, 0.0).rgb) + nightLight;
}

struct AirLight {
    vec3 scattered;  // into the ray
    vec3 through;    // transmittance from the ray's end
};

// The part of a ray from the eye inside the atmosphere. Height and rise are those at its start.
struct AirSpan {
    float before;  // from the eye to the span's start
    float height;
    float along;   // radius x rise
    float far;
    bool meetsGround;
};

// Returns the span of a ray from the eye. distance: to the ray's end; negative: to the top of the atmosphere,
// or to the ground at height 0.
AirSpan airSpan(float rise, float distance) {
    AirSpan span = AirSpan(0.0, air.eyeKm, 0.0, 0.0, false);
    float radius = air.radiusKm + span.height;
    float top = air.radiusKm + air.topKm;
    span.along = radius * rise;
    float inside = span.along * span.along - (span.height - air.topKm) * (radius + top);
    if (inside <= 0.0 || (span.height >= air.topKm && span.along >= 0.0)) return span;
    float root = sqrt(inside);
    if (span.height > air.topKm) {
        span.before = -span.along - root;
        span.height = air.topKm;
        span.along = -root;
        radius = top;
    }
    span.far = root - span.along;
    float toGround = span.along * span.along - span.height * (radius + air.radiusKm);
    if (distance < 0.0 && span.along < 0.0 && toGround >= 0.0) {
        span.far = max(-span.along - sqrt(toGround), 0.0);
        span.meetsGround = true;
    }
    if (distance >= 0.0) span.far = clamp(distance - span.before, 0.0, span.far);
    return span;
}

float squareOf(float x) {
    return x * x;
}

// Sums the light in steps that are shortest at the ray's lowest point and grow with the distance from it.
// Their number may be fractional: the last step is then shorter, so that nothing jumps when the number
// changes.
AirLight lightAlongSpan(AirSpan span, vec3 ray, float steps) {
    AirLight light = AirLight(vec3(0.0), vec3(1.0));
    if (span.far <= 0.0) return light;
    float cosine = dot(ray, shading.sun);
    float sunAlong = (air.radiusKm + air.eyeKm) * dot(air.eyeUp, shading.sun) + span.before * cosine;
    float radius = air.radiusKm + span.height;
    float rayleigh = 0.0596831 * (1.0 + cosine * cosine);
    float g = air.forward;
    float spread = max(1.0 + g * g - 2.0 * g * cosine, 1e-4);
    float forward = 0.1193662 * (1.0 - g * g) * (1.0 + cosine * cosine) /
                    ((2.0 + g * g) * spread * sqrt(spread));  // phase function of Cornette and Shanks
    float lowest = clamp(-span.along, 0.0, span.far);
    float v = -sqrt(lowest);
    float end = sqrt(span.far - lowest);
    float width = (end - v) / steps;
    float from = 0.0;
    for (int i = 0; i < 128 && v < end; ++i) {
        float next = min(v + width, end);
        float middle = 0.5 * (v + next);
        float to = lowest + next * abs(next);
        float distance = lowest + middle * abs(middle);
        float depth = to - from;
        v = next;
        from = to;
        float square = distance * (2.0 * span.along + distance);
        float there = sqrt(max(radius * radius + square, 1.0));
        float height = max(span.height + square / (there + radius), 0.0);
        float sunRise = clamp((sunAlong + distance * cosine) / there, -1.0, 1.0);
        vec3 molecules = air.rayleigh * exp(-height * air.perRayleighHeight);
        float haze = exp(-height * air.perHazeHeight);
        float ozone = max(1.0 - abs(height - air.ozoneMiddleKm) * air.perOzoneHalf, 0.0);
        vec3 even = textureLod(airGlow, vec3(glowPlace(height, sunRise), 0.0), 0.0).rgb;
        vec3 scatters = sunThroughAir(height, sunRise) * (molecules * rayleigh + air.hazeScattered * haze * forward) +
                        even * (molecules + air.hazeScattered * haze);
        vec3 thickness = depth * (molecules + air.hazeTaken * haze + air.ozone * ozone);
        vec3 taken = exp(-thickness);
        vec3 least = max(thickness, vec3(1e-3));
        light.scattered += light.through * scatters * (depth * (1.0 - exp(-least)) / least);
        light.through *= taken;
    }
    light.scattered *= 3.14159265 * air.light;
    return light;
}

// Returns the light along a ray (a unit vector) to the top of the atmosphere. If the ray meets height 0, it
// ends there, and the light of dark ground is added. This is seen past lower ground, between the horizon and
// where that ground begins.
AirLight lightOfSky(vec3 ray, out bool meetsGround) {
    AirSpan span = airSpan(dot(air.eyeUp, ray), -1.0);
    meetsGround = span.meetsGround;
    AirLight light = lightAlongSpan(span, ray, air.steps);
    if (!meetsGround) return light;
    vec3 place = (air.radiusKm + air.eyeKm) * air.eyeUp + (span.before + span.far) * ray;
    float sunRise = clamp(dot(place, shading.sun) * inversesqrt(max(dot(place, place), 1.0)), -1.0, 1.0);
    vec3 arrives = air.light * sunThroughAir(0.0, sunRise) * max(sunRise, 0.0) + skyIrradianceAt(0.0, sunRise);
    light.scattered += light.through * arrives * vec3(0.02, 0.04, 0.07);
    return light;
}

// Returns the distance at which a ray reaches a height; if it stays above it, the distance to its lowest
// point.
float distanceToHeight(float rise, float height) {
    float along = (air.radiusKm + air.eyeKm) * rise;
    float fall = along * along - (air.eyeKm - height) * (2.0 * air.radiusKm + air.eyeKm + height);
    return -along - sqrt(max(fall, 0.0));
}

// Returns the light of the atmosphere before a point of the ground, metres from the eye. heightM: of the
// point. share: of the full number of steps. Seen from space, the middles of large triangles lie far below
// the sphere through their corners, so there the height decides where the ray ends. The bed of the sea counts
// as its surface, which the light comes from.
AirLight lightBefore(vec3 position, float heightM, float share) {
    float distance = length(position);
    vec3 ray = position / max(distance, 1e-6);
    float rise = dot(air.eyeUp, ray);
    distance *= air.kmPerM;
    float height = heightM * air.kmPerM;
    float seaKm = shading.seaLevelM * air.kmPerM;
    float byHeight = smoothstep(30.0, 150.0, air.eyeKm - height);
    if (switchSea && height < seaKm && air.eyeKm > seaKm) {
        height = seaKm;
        byHeight = 1.0;
    }
    if (byHeight > 0.0) distance = mix(distance, max(distanceToHeight(rise, height), 0.0), byHeight);
    AirSpan span = airSpan(rise, distance);
    float steps = clamp(3.0 + 0.9 * sqrt(span.far), 4.0, max(share * air.steps, 4.0));
    return lightAlongSpan(span, ray, steps);
}

// Applies a film-like toe before the tone mapping, to keep dark areas dark under the veil of the atmosphere.
vec3 onFilm(vec3 light) {
    return light * (light + 0.02) / (light + 0.08);
}

// Returns the brightness of the sun's disk, with limb darkening and an edge one pixel wide. The sun's
// transmittance is not included.
float sunDisk(float cosine, float pixelRad) {
    float away = sqrt(max(2.0 - 2.0 * cosine, 0.0));
    float radius = max(0.004654, pixelRad);
    float inside = 1.0 - smoothstep(radius - 0.5 * pixelRad, radius + 0.5 * pixelRad, away);
    float rim = sqrt(max(1.0 - squareOf(away / radius), 0.0));
    return inside * (0.4 + 0.6 * rim);
}
