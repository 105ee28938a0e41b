// The surface: what it is made of, the sun on it, and the air before it.

in vec4 surface;
in vec3 surfaceNormal;
in vec3 gridCoordinate;
flat in vec4 tint;
in vec3 finestCell;

uniform sampler2D colourImage;  // equirectangular, sRGB decoded by the sampler

out vec4 fragment;

const float pi = 3.14159265;

// Texture coordinates from the direction itself, and their derivatives from the direction's: continuous across
// the seam at longitude 180. The one along longitude is shortened with the circle of latitude, since near a
// pole the image holds no more detail on the ground than elsewhere.
vec3 imageColour(vec3 up) {
    vec3 dx = dFdx(up);
    vec3 dy = dFdy(up);
    float ring = max(length(up.xy), 1e-5);
    vec2 place = vec2(atan(up.y, up.x) / (2.0 * pi) + 0.5, acos(clamp(up.z, -1.0, 1.0)) / pi);
    vec2 east = vec2(-up.y, up.x) / ring;
    vec2 scale = vec2(0.5, -1.0) / pi;
    vec2 across = scale * vec2(dot(east, dx.xy), dx.z / ring);
    vec2 along = scale * vec2(dot(east, dy.xy), dy.z / ring);
    // Seen at a slant a pixel's footprint is long; what the sampler cannot follow is cut, not blurred.
    float longest = heights.w * sqrt(min(dot(across, across), dot(along, along)));
    across *= min(1.0, longest / max(length(across), 1e-12));
    along *= min(1.0, longest / max(length(along), 1e-12));
    return textureGrad(colourImage, place, across, along).rgb;
}

vec3 seaByDepth(float height) {
    vec3 shelf = vec3(0.022, 0.095, 0.135);
    vec3 open = vec3(0.008, 0.036, 0.085);
    vec3 deep = vec3(0.003, 0.014, 0.046);
    float depth = max(-height, 0.0) * heights.y;
    return mix(mix(shelf, open, smoothstep(0.0, 0.22, depth)), deep, smoothstep(0.3, 1.0, depth));
}

// Lowland green to rock to snow; heights.y is 1 / the height of the highest band.
vec3 landByHeight(float height, float latitudeSine, float steepness) {
    float h = max(height, 0.0) * heights.y;
    float cold = latitudeSine * latitudeSine;
    float dry = 1.0 - smoothstep(0.10, 0.26, abs(abs(latitudeSine) - 0.40));
    vec3 low = mix(vec3(0.036, 0.092, 0.018), vec3(0.230, 0.165, 0.068), 0.7 * dry);
    vec3 hills = mix(vec3(0.105, 0.120, 0.034), vec3(0.235, 0.150, 0.066), dry);
    vec3 colour = mix(low, hills, smoothstep(0.03, 0.16, h));
    colour = mix(colour, vec3(0.150, 0.092, 0.048), smoothstep(0.16, 0.42, h));
    colour = mix(colour, vec3(0.120, 0.105, 0.092), smoothstep(0.42, 0.62, h));
    colour = mix(colour, vec3(0.095, 0.080, 0.066), 0.7 * steepness);
    float snowLine = 1.04 - 1.38 * cold * cold;
    float snow = smoothstep(snowLine - 0.10, snowLine + 0.12, h) * (1.0 - 0.8 * steepness);
    return mix(colour, vec3(0.82, 0.85, 0.88), snow);
}

struct Material {
    vec3 albedo;
    float water;  // 1 where light falls on open sea
};

Material materialAt(vec3 up, float height, float steepness) {
    float below = 1.0 - smoothstep(-30.0 * planet.x / 6.371e6, 0.0, height);
    if (!isOn(switchSea)) below = 0.0;
    if (isOn(switchImage)) {
        vec3 image = imageColour(up);
        // The image knows sea ice, and coasts finer than the mesh; the mesh knows depth.
        float blue = smoothstep(0.0, 0.008, image.b - 1.15 * image.r);
        float dark = 1.0 - smoothstep(0.10, 0.30, image.g);
        float water = below * blue * dark;
        vec3 sea = mix(image, seaByDepth(height), 0.4);
        return Material(mix(image * 1.2, sea, water), water);
    }
    vec3 land = landByHeight(height, up.z, steepness);
    float ice = below * smoothstep(0.955, 0.985, abs(up.z));
    vec3 sea = mix(seaByDepth(height), vec3(0.70, 0.76, 0.82), ice);
    return Material(mix(land, sea, below), below * (1.0 - ice));
}

// The chunk's mesh: lines one pixel wide along rows, columns and diagonals, smooth whatever their distance.
float meshLine() {
    vec3 at = vec3(gridCoordinate.xy, gridCoordinate.x - gridCoordinate.y);
    vec3 width = fwidth(at);
    vec3 away = abs(at - floor(at + 0.5));
    vec3 cover = 1.0 - smoothstep(width * 0.3, width * 1.0, away);
    // Down a skirt a coordinate stands still: no line runs along it.
    cover *= step(vec3(1e-5), width);
    float line = max(0.85 * max(cover.x, cover.y), 0.5 * cover.z);
    float widest = max(width.x, width.y);
    return mix(line, 0.35, smoothstep(0.2, 0.6, widest));
}

// A number from 0 to 1 for a point of the lattice, which repeats every 4096 cells (Wang's integer hash).
float latticeValue(ivec2 at, int repeat) {
    uvec2 p = uvec2(at & (repeat - 1));
    uint h = (p.x * 0x9E3779B1u) ^ (p.y * 0x85EBCA77u);
    h = (h ^ (h >> 15u)) * 0x27D4EB2Du;
    return float((h ^ (h >> 13u)) & 0xFFFFu) * (1.0 / 65535.0);
}

// Value noise and its slopes along both axes.
vec3 noiseAndSlope(vec2 at, int repeat) {
    vec2 corner = floor(at);
    ivec2 i = ivec2(corner);
    vec2 f = at - corner;
    vec2 s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    vec2 ds = 30.0 * f * f * (f * (f - 2.0) + 1.0);
    float a = latticeValue(i, repeat);
    float b = latticeValue(i + ivec2(1, 0), repeat) - a;
    float c = latticeValue(i + ivec2(0, 1), repeat) - a;
    float d = latticeValue(i + ivec2(1, 1), repeat) - a - b - c;
    return vec3(a + b * s.x + c * s.y + d * s.x * s.y, ds * vec2(b + d * s.y, c + d * s.x));
}

// Ridges and their slopes between the finest samples, in octaves that each fade out before a pixel blurs them.
vec3 inventedRidges(vec2 cells, float cellsAPixel) {
    vec3 sum = vec3(0.0);
    float weight = 1.0;
    for (int octave = -1; octave < 4; ++octave) {
        float frequency = exp2(float(octave));
        float shown = 1.0 - smoothstep(0.15, 0.45, frequency * cellsAPixel);
        if (shown <= 0.0) break;
        vec3 noise = noiseAndSlope(cells * frequency, 4096 << max(octave, 0) >> max(-octave, 0));
        float fold = 2.0 * noise.x - 1.0;
        float ridge = sqrt(fold * fold + 0.02);
        sum += shown * weight * vec3(0.5 - ridge, noise.yz * (-2.0 * fold / ridge));
        weight *= 0.55;
    }
    return sum;
}

// Nothing where the samples are as fine as pixels, nor beside a face's edge, where the next face counts otherwise.
float detailStrength(float cellsAPixel) {
    return (1.0 - smoothstep(0.06, 0.25, cellsAPixel)) * smoothstep(0.0, 6.0, finestCell.z);
}

vec3 lit(Material material, vec3 up, vec3 normal, vec3 toEye) {
    float airOn = atmosphere.z;
    vec3 sunDirection = sun.xyz;
    float sunRise = dot(up, sunDirection);
    vec3 shading = normalize(mix(normal, up, 0.94 * material.water));
    float day = smoothstep(-0.06, 0.10, sunRise);
    vec3 sunHere = airOn > 0.0 ? sunThrough(0.1, sunRise) : vec3(1.0);
    float facing = max(dot(shading, sunDirection), 0.0) * day;
    vec3 sky = mix(vec3(0.010), vec3(0.085, 0.115, 0.165) * smoothstep(-0.18, 0.30, sunRise), airOn) +
               vec3(0.0025, 0.003, 0.0045);
    vec3 light = material.albedo * (sunLight * sunHere * facing + sunLight * 0.55 * sky);
    if (material.water > 0.01) {
        vec3 middle = normalize(toEye + sunDirection);
        float away = 1.0 - dot(shading, middle);
        float aside = 1.0 - max(dot(middle, toEye), 0.0);
        float fresnel = 0.02 + 0.5 * aside * aside * aside * aside * aside;
        float glint = 7.0 * exp(-260.0 * away) + 0.7 * exp(-60.0 * away);
        light += sunLight * sunHere * (material.water * day * fresnel * glint);
    }
    return light;
}

// The air between the eye and the surface takes light away and scatters the sun's in.
vec3 throughAir(vec3 light, vec3 position, vec3 up, float height) {
    vec3 ray = normalize(position);
    float eyeRadius = length(eye.xyz);
    vec3 eyeUp = eye.xyz / eyeRadius;
    float eyeHeight = eyeRadius * atmosphere.y - atmosphere.x;
    float here = max(height, 0.0) * atmosphere.y;
    float fall = dot(eyeUp, ray);
    float air = fall < 0.0 ? airAbove(here, max(-dot(up, ray), 0.0)) - airAbove(max(eyeHeight, 0.0), -fall)
                           : airAbove(max(eyeHeight, 0.0), fall) - airAbove(here, max(dot(up, ray), 0.0));
    air = max(air, 0.0);
    // Along a slanting ray most light comes from nearer and higher than the surface itself.
    float nearer = min(min(1.0 / (max(-dot(up, ray), 0.0) + 0.04), 25.0), 0.7 * length(position) * atmosphere.y);
    vec3 sunHere = sunOnAir(up * (atmosphere.x + here) - ray * nearer);
    air *= 1.0 - 0.75 * tint.a;  // a tint stays readable far away
    return light * exp(-extinction * air) + scattered(air, sunHere, dot(ray, sun.xyz));
}

void main() {
    vec3 position = surface.xyz;
    vec3 fromCentre = eye.xyz + position;
    vec3 up = normalize(fromCentre);
    vec3 normal = normalize(surfaceNormal);
    float steepness = isOn(switchLighting) ? smoothstep(0.08, 0.45, 1.0 - dot(normal, up)) : 0.0;

    Material material = materialAt(up, surface.w, steepness);
    bool isLit = isOn(switchLighting);
    if (isOn(switchDetail)) {
        vec2 cellStep = fwidth(finestCell.xy);
        float cellsAPixel = max(cellStep.x, cellStep.y);
        float strength = detailStrength(cellsAPixel) * (1.0 - material.water);
        if (strength > 0.0) {
            vec3 ridges = strength * inventedRidges(finestCell.xy, cellsAPixel);
            vec3 east = normalize(vec3(-up.y, up.x, 1e-6));
            float relief = length(normal - up * dot(normal, up));
            float rough = min(0.02 + 1.6 * relief, 0.22);
            normal = normalize(normal - rough * (ridges.y * east + ridges.z * cross(up, east)));
            material.albedo *= 1.0 + (0.25 + 0.5 * min(4.0 * relief, 1.0)) * ridges.x;
        }
    }
    // A tint is meant as seen, not as paint: darker in the sun, so that it does not bleach.
    material.albedo = mix(material.albedo, decodeSrgb(tint.rgb) * (isLit ? 0.3 : 1.0), tint.a);
    material.water *= 1.0 - tint.a;
    vec3 colour = material.albedo;
    if (isLit) colour = lit(material, up, normal, normalize(-position));
    if (isLit && atmosphere.z > 0.0) colour = throughAir(colour, position, up, surface.w);
    if (isLit) colour = exposed(colour);
    colour = encodeSrgb(clamp(colour, 0.0, 1.0));
    if (isOn(switchWireframe)) {
        vec3 lineColour = tint.a > 0.0 ? tint.rgb : vec3(0.92, 0.96, 1.0);
        colour = mix(colour * 0.35, lineColour, meshLine());
    }
    if (isLit) colour += ditherStep();
    fragment = vec4(colour, 1.0);
}
