// Shades the surface: its material, the sun's light on it, and the atmosphere before it.

in vec3 surface;
in vec3 facePlace;
in vec2 imagePlace;
in vec3 aboveSea;
in vec4 surfaceNormal;
in vec3 sunLit;
in vec3 skyLit;
in vec3 airLit;
in vec4 groundArriving;
in vec4 airArriving;
in float steep;
in vec3 meshPlace;
flat in float onFace;
flat in float flooded;
flat in vec4 tint;
flat in float meshLevel;
flat in ShadingFrame held;

uniform sampler2DArray colourImage;  // one face per layer: root of linear light; probability of water
uniform sampler3D detailNoise;       // slope and height, in [-1, 1]

out vec4 fragment;

// Returns the smallest 1 / distance that a triangle can have in this pixel. If multisampling draws a pixel
// whose centre the triangle does not cover, inputs are extrapolated to that centre. For a triangle seen
// edge-on, as at the horizon, that place may be infinitely far away or behind the eye; gl_FragCoord.w is then
// smaller than this.
float leastNearness() {
    return 0.5 * fwidth(gl_FragCoord.w);
}

bool isExtrapolated() {
    return switchMultisampled && gl_FragCoord.w < leastNearness();
}

// Returns the position relative to the eye, moved back along the pixel's ray if it was extrapolated too far.
vec3 positionSeen() {
    return isExtrapolated() ? surface * (gl_FragCoord.w / leastNearness()) : surface;
}

// Returns interpolated light, bounded if it was extrapolated.
vec3 inRange(vec3 light) {
    return isExtrapolated() ? clamp(light, 0.0, 1.0) : light;
}

// Invented ground between the samples, for appearance only: it moves no vertex. The noise is fixed to the
// planet. Each octave fades out where it is finer than a pixel, and all of them fade out where the samples
// are.
struct Detail {
    vec3 slope;    // world axes
    float height;  // [-1, 1]
};

Detail noDetail() {
    return Detail(vec3(0.0), 0.0);
}

// turn: rotates to the axes of the noise. octave: as in ShadingFrame.
Detail octaveAt(mat3 turn, vec4 octave, vec3 position) {
    vec3 place = turn * position / octave.w + octave.xyz;
    vec4 noise = texture(detailNoise, place) * 2.0 - 256.0 / 255.0;
    return Detail(noise.xyz * turn, noise.w);
}

// Returns the detail. The coarsest octave bends the finer ones, and they fade in its valleys, so that no
// pattern continues through.
Detail detailAt(vec3 position) {
    Detail coarse = octaveAt(detailTurn0, shading.coarseDetail, position);
    vec3 bent = position + 0.07 * shading.middleDetail.w * coarse.slope;
    float rugged = 0.55 + 0.45 * coarse.height;
    Detail middle = octaveAt(detailTurn1, shading.middleDetail, bent);
    Detail fine = noDetail();
    if (switchFineDetail) fine = octaveAt(detailTurn2, shading.fineDetail, bent);
    return Detail(coarse.slope + rugged * (1.5 * middle.slope + 1.2 * fine.slope),
                  coarse.height + rugged * (0.8 * middle.height + 0.6 * fine.height));
}

// Returns the image's colour and water. The lookup is shifted by a fraction of a texel, so that blobs get
// ragged edges. On a face's edge it is shifted along the edge only, as on the next face.
vec4 imageColour(Detail detail, float strength) {
    vec2 shift = vec2(0.0);
    if (switchDetail) {
        vec2 inside = min(facePlace.xy, 1.0 - facePlace.xy) / (4.0 * shading.imageStep);
        vec2 aside = alongFace(int(onFace + 0.5), detail.slope).yz;
        shift = aside * clamp(inside, 0.0, 1.0) * (0.5 * strength * shading.imageStep);
    }
    if (switchTiles) {
        vec2 place = facePlace.xy + shift;
        vec3 colour;
        if (switchClipmap) {
            colour = clipmapColours(place, onFace);
        } else {
            colour = streamedColours(place, onFace);
        }
        return vec4(colour, waterOf(colour));
    }
    vec4 image = texture(colourImage, vec3(imagePlace + shift, onFace));
    return vec4(image.rgb * image.rgb, image.a);
}

// A height above the sea level.
struct Above {
    float m;
    float earthM;  // in metres of a planet of the Earth's size
    float ramp;    // 1 at the highest band of the built-in ramp
};

Above aboveHere() {
    return Above(aboveSea.x, aboveSea.y, aboveSea.z);
}

vec3 seaByDepth(Above above) {
    vec3 shelf = vec3(0.022, 0.095, 0.135);
    vec3 open = vec3(0.008, 0.036, 0.085);
    vec3 deep = vec3(0.003, 0.014, 0.046);
    return shelf + (open - shelf) * smoothRise(0.0, 0.22, -above.ramp) +
           (deep - open) * smoothRise(0.3, 1.0, -above.ramp);
}

// Returns colours from lowland green to rock to snow.
vec3 landByHeight(Above above, float latitudeSine, float steep) {
    float h = max(above.ramp, 0.0);
    float cold = latitudeSine * latitudeSine;
    float dry = 1.0 - smoothRise(0.10, 0.26, abs(abs(latitudeSine) - 0.40));
    vec3 low = mix(vec3(0.036, 0.092, 0.018), vec3(0.230, 0.165, 0.068), 0.7 * dry);
    vec3 hills = mix(vec3(0.105, 0.120, 0.034), vec3(0.235, 0.150, 0.066), dry);
    vec3 colour = mix(low, hills, smoothRise(0.03, 0.16, h));
    colour = mix(colour, vec3(0.150, 0.092, 0.048), smoothRise(0.16, 0.42, h));
    colour = mix(colour, vec3(0.120, 0.105, 0.092), smoothRise(0.42, 0.62, h));
    colour = mix(colour, vec3(0.095, 0.080, 0.066), 0.7 * steep);
    float snowLine = 1.04 - 1.38 * cold * cold;
    float snow = smoothRise(-0.10, 0.12, h - snowLine) * (1.0 - 0.8 * steep);
    return mix(colour, vec3(0.82, 0.85, 0.88), snow);
}

struct Material {
    vec3 albedo;
    float water;       // 1: light falls on open sea
    float shownWater;  // 1: the image shows water at any height: sea, lakes and rivers
    vec3 bed;          // albedo of the bed, if the sea is drawn as water
};

float anyWater(Material material) {
    return max(material.water, material.shownWater);
}

// Returns the colour of the ramp's own stops, mixed one after the other: stops above the height add nothing,
// and those below it are covered.
vec3 stopsAt(float height) {
    vec3 root = frame.ramp[0].root;
    for (int i = 1; i < frame.rampStopCount; ++i)
        root = mix(root, frame.ramp[i].root,
                   clamp((height - frame.ramp[i].startM) * frame.ramp[i].perM, 0.0, 1.0));
    return root * root;
}

Material rampMaterial(vec3 up, Above above, float steep, float below) {
    if (switchRamp) {
        vec3 stops = stopsAt(above.m);
        vec3 albedo = mix(stops, seaByDepth(above), below * (1.0 - frame.rampColoursSea));
        return Material(albedo, below, 0.0, sandyBed);
    }
    vec3 land = landByHeight(above, up.z, steep);
    float ice = below * smoothRise(0.955, 0.985, abs(up.z));
    vec3 sea = mix(seaByDepth(above), vec3(0.70, 0.76, 0.82), ice);
    return Material(mix(land, sea, below), below * (1.0 - ice), 0.0, sandyBed);
}

// Returns whether the sea's surface is drawn here: over ground below the sea level, by the mesh. Water that
// the image shows on higher ground has no depth to draw and keeps the image's colour.
bool isUnderSea() {
    return switchSeaSurface && aboveSea.x < 0.0;
}

// Returns 1 where the ground is at least as deep as the shore, 0 above the sea level. shoreM: depth of the
// shore on the Earth, metres.
float belowSea(Above above, float shoreM) {
    if (!switchSea) return 0.0;
    return smoothRise(0.0, shoreM, -above.earthM);
}

// Returns the material by the image. The image shows which low land is dry and which ground is water, but not
// a raised sea. Where the sea's surface is drawn, the image's colour is that of the bed, because it shows how
// shallows look.
Material imageMaterial(Above above, float below, Detail detail, float strength) {
    vec4 image = imageColour(detail, strength);
    // The mesh's coast is coarser than the image's, and lakes may be deeper than the sea level. So the drawn
    // surface fades in with its depth in water that the image shows.
    float deep = isUnderSea() ? belowSea(above, 30.0) : below;
    float water = deep * image.a;
    if (switchFlooded) water = max(water, below * flooded);
    vec3 shown = image.rgb * 1.2;
    if (isUnderSea()) return Material(shown, water, image.a, shown);
    // Mixes the image with the sea's colour by depth, and what the image shows with that.
    float byDepth = 0.8 - 0.4 * image.a;
    vec3 albedo = image.rgb * (1.2 - water * (0.2 + byDepth)) + seaByDepth(above) * (water * byDepth);
    return Material(albedo, water, image.a, shown);
}

Material materialAt(vec3 up, Above above, float steep, Detail detail, float strength) {
    float below = belowSea(above, isUnderSea() ? 2.0 : 30.0);
    if (!switchImage) return rampMaterial(up, above, steep, below);
    Material image = imageMaterial(above, below, detail, strength);
    if (!switchImageOverRamp) return image;
    Material ramp = rampMaterial(up, above, steep, below);
    float share = frame.imageOpacity;
    return Material(mix(ramp.albedo, image.albedo, share), mix(ramp.water, image.water, share),
                    share * image.shownWater, mix(ramp.bed, image.bed, share));
}

// Returns the coverage of the mesh's lines: one pixel wide along rows, columns and diagonals, antialiased at
// any distance.
float meshLine() {
    vec3 at = vec3(meshPlace.xy, meshPlace.x - meshPlace.y);
    vec3 width = fwidth(at);
    vec3 away = abs(at - floor(at + 0.5));
    vec3 cover = 1.0 - smoothstep(width * 0.3, width * 1.0, away);
    // Along a skirt one coordinate is constant, so no line runs along it.
    cover *= step(vec3(1e-5), width);
    float line = max(0.85 * max(cover.x, cover.y), 0.5 * cover.z);
    float widest = max(width.x, width.y);
    return mix(line, 0.35, smoothRise(0.2, 0.6, widest));
}

// Returns the distance to the chunk's border, pixels; the chunk beside it draws the other half of the line.
// It is large if the chunk is only a few pixels wide, and along a skirt, where one coordinate is constant.
float borderAwayPx() {
    vec2 width = fwidth(meshPlace.xy);
    vec2 away = min(meshPlace.xy, float(1 << frame.chunkCellsLog2) - meshPlace.xy) / max(width, vec2(1e-9));
    away += 1e3 * (1.0 - step(vec2(1e-5), width));
    float chunkPx = float(1 << frame.chunkCellsLog2) / max(width.x, width.y);
    return min(away.x, away.y) + 10.0 * (1.0 - smoothRise(3.0, 8.0, chunkPx));
}

// Draws a light line 1.5 pixels wide, with dark sides so that it is visible on any ground.
vec3 outlined(vec3 colour) {
    float away = borderAwayPx();
    vec3 line = switchWireframe ? vec3(1.0, 0.70, 0.15) : vec3(1.0, 0.98, 0.92);
    colour *= 1.0 - 0.45 * (1.0 - smoothRise(1.0, 2.25, away));
    return mix(colour, line, 0.9 * (1.0 - smoothRise(0.25, 1.25, away)));
}

// Returns 1 if a step of the heights or the image is drawn larger than about two pixels, with a smooth
// transition.
float between(float pixels) {
    return smoothRise(2.0, 6.0, pixels);
}

// Attenuates the light by the air between the eye and the ground, and adds the sunlight that the air
// scatters.
vec3 throughAir(vec3 light, vec3 position, vec3 ray, vec3 up) {
    if (!switchAir) return light;
    if (switchPhysicalAir) {
        AirLight before = lightBefore(position, facePlace.z, 0.5);
        return light * before.through + before.scattered;
    }
    float mass = airBefore(ray, up, max(facePlace.z, 0.0) * shading.scaleHeightsPerM);
    vec3 amount = scatteringBeforeGround();
    return light * exp(-(amount + vec3(haze)) * mass) + scattered(mass, amount, inRange(airLit), dot(ray, shading.sun));
}

vec3 groundNormal() {
    vec3 normal = renormalised(surfaceNormal.xyz);
    if (switchNormalTiles) normal = normalFromTiles(normal, meshLevel, vec4(facePlace, onFace));
    return normal;
}

// Returns the direction from the planet's centre to a position relative to the eye. Ground is about one radius away.
vec3 upAt(vec3 position) {
    vec3 fromCentre = shading.eyeM + position;
    if (switchCube) return normalize(fromCentre);
    return renormalised(fromCentre * (shading.scaleHeightsPerM * (1.0 / radiusScaleHeights)));
}

vec3 lightByPixel() {
    vec3 position = positionSeen();
    float nearness = inversesqrt(dot(position, position));
    vec3 ray = position * nearness;
    vec3 up = upAt(position);
    vec3 bare = groundNormal();
    vec3 normal = bare;
    Detail detail = noDetail();
    float rough = 0.0;
    float ragged = 0.0;
    Above above = aboveHere();
    if (switchDetail) {
        detail = detailAt(position);
        rough = between(shading.heightStepPxM * nearness) * (0.05 + 0.95 * surfaceNormal.w);
        ragged = between(shading.imageStepPxM * nearness);
        float raisedEarthM = 500.0 * rough * detail.height * step(0.0, above.m);
        float raisedM = raisedEarthM / shading.earthRadii;
        above = Above(above.m + raisedM, above.earthM + raisedEarthM, above.ramp + raisedM * shading.perRampTopM);
        vec3 tilt = rough * (detail.slope - up * dot(detail.slope, up));
        normal = normalize(normal - tilt * inversesqrt(1.0 + 1.5 * dot(tilt, tilt)));
    }
    Material material = materialAt(up, above, steepness(normal, up), detail, ragged);
    if (switchDetail)
        material.albedo *= 1.0 + (0.35 * rough + 0.20 * ragged) * (1.0 - anyWater(material)) * detail.height;
    float glint = 0.0;
    if (switchLayers) {
        Layered layered = layeredGround(position, up, bare, aboveSea.x, material.albedo);
        float amount = layered.amount * (1.0 - anyWater(material));
        material.albedo = mix(material.albedo, layered.albedo, amount);
        vec3 tilt = layered.tilt - normal * dot(layered.tilt, normal);
        normal = normalize(normal - amount * tilt);
        glint = amount * layerGlint(normal, -ray, layered.roughness);
    }
    vec3 facing = renormalised(mix(normal, up, (switchDetail ? 0.98 : 0.94) * material.water));
    float sea = isUnderSea() ? material.water : 0.0;
    vec3 sunlight = inRange(sunLit);
    vec3 skylight = inRange(skyLit) + fillLight(facing, -ray, up);
    if (switchShadows)
        sunlight *= sunSeen(position, normalize(mix(surfaceNormal.xyz, up, sea)));
    float wet = material.water - sea;
    vec3 light = material.albedo * (sunlight * max(dot(facing, shading.sun), 0.0) + skylight) +
                 sunlight * (wet * seaGlint(facing, -ray) + glint);
    if (sea > 0.0)
        light = mix(light,
                    seaLight(position, ray, up, aboveSea.x, material.bed, sunlight, skylight), sea);
    return throughAir(light, position, ray, up);
}

vec3 lightByVertex() {
    vec3 up = upAt(surface);
    Material material = materialAt(up, aboveHere(), steep, noDetail(), 0.0);
    vec3 reflected = material.albedo * mix(1.0, groundArriving.a, material.water) + material.water * airArriving.a;
    return inRange(groundArriving.rgb) * max(reflected, 0.0) + inRange(airArriving.rgb);
}

vec3 flatSurface() {
    vec3 up = upAt(surface);
    Material material = materialAt(up, aboveHere(), 0.0, noDetail(), 0.0);
    vec3 albedo = material.albedo;
    if (switchLayers) {
        Layered layered = layeredGround(surface, up, groundNormal(), aboveSea.x, albedo);
        albedo = mix(albedo, layered.albedo, layered.amount * (1.0 - anyWater(material)));
    }
    // Layers may be brighter than a pixel can show, and marks are mixed with what it shows.
    if (switchLayers || switchLayerPreview || switchTint || switchWireframe || switchOutlines) albedo = min(albedo, 1.0);
    return encodeSrgb(albedo);
}

vec3 litSurface() {
    vec3 light = vec3(0.0);
    if (switchLightByVertex) light = lightByVertex();
    else light = lightByPixel();
    if (switchPhysicalAir) light = onFilm(light);
    return developed(light) + ditherStep();
}

void main() {
    if (switchHeldFrame) shading = held;
    else shading = frame.shading;
    vec3 colour = switchLighting ? litSurface() : flatSurface();
    if (switchLayerPreview)
        colour = layerPreview(colour, surface, upAt(surface), groundNormal(), aboveSea.x);
    // Tints carry measured values. They are applied to the finished picture, so that light, air and dither do
    // not change their colours.
    if (switchTint) colour = mix(colour, tint.rgb, tint.a);
    if (switchWireframe) {
        vec3 lineColour = switchTint ? tint.rgb : vec3(0.92, 0.96, 1.0);
        colour = mix(colour * 0.35, lineColour, meshLine());
    }
    if (switchOutlines) colour = outlined(colour);
    if (switchLoudSkirts && meshPlace.z > 0.0) colour = vec3(1.0, 0.0, 0.8);
    fragment = vec4(colour, 1.0);
}
