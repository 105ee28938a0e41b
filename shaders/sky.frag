// Draws the background behind the planet: stars, and the atmosphere along rays that pass the planet.

in vec3 skyRay;

out vec4 fragment;

float hash(vec3 p) {
    p = fract(p * vec3(0.1031, 0.1030, 0.0973));
    p += dot(p, p.yxz + 33.33);
    return fract((p.x + p.y) * p.z);
}

// Returns the light of stars: at most one per cell of a grid on the faces of a cube. A star is about a pixel
// in size, so that it neither flickers nor grows.
float starLight(vec3 ray) {
    vec3 size = abs(ray);
    float most = max(size.x, max(size.y, size.z));
    float face = most == size.x ? 1.0 + step(0.0, ray.x) : most == size.y ? 3.0 + step(0.0, ray.y)
                                                                          : 5.0 + step(0.0, ray.z);
    vec2 side = (most == size.x ? ray.yz : most == size.y ? ray.zx : ray.xy) / most;
    const float cells = 90.0;
    vec2 cell = floor(side * cells);
    float pick = hash(vec3(cell, face * 17.0));
    if (pick < 0.86) return 0.0;
    vec2 star = vec2(hash(vec3(cell, face * 31.0)), hash(vec3(cell, face * 57.0))) * 0.7 + 0.15;
    vec2 away = (side * cells - cell - star) / (cells * frame.pixelRad);  // pixels
    float magnitude = (pick - 0.86) / 0.14;
    return (0.02 + 0.55 * pow(magnitude, 9.0)) * exp(-dot(away, away) * 1.4);
}

vec3 physicalSky(vec3 ray) {
    bool meetsGround = false;
    AirLight sky = lightOfSky(ray, meetsGround);
    if (meetsGround) return onFilm(max(sky.scattered, 0.0));
    vec3 light = sky.scattered + sky.through * air.light * (5.0 * sunDisk(dot(ray, frame.sun), frame.pixelRad));
    light = onFilm(min(max(light, 0.0), vec3(1e4)));
    float clear = max(1.0 - 12.0 * (sky.scattered.r + sky.scattered.g + sky.scattered.b), 0.0);
    if (clear > 0.01) light += sky.through * vec3(0.95, 0.97, 1.0) * (clear * starLight(ray));
    return light;
}

void main() {
    vec3 ray = normalize(skyRay);
    vec3 light = vec3(0.0);
    if (switchPhysicalAir) {
        light = physicalSky(ray);
        fragment = vec4(developed(light) + ditherStep() * step(0.002, light.b), 1.0);
        return;
    }
    float clear = 1.0;
    vec3 eyeScaled = frame.eyeM * frame.scaleHeightsPerM;
    float eyeRadius = length(eyeScaled);
    float rise = dot(eyeScaled, ray) / eyeRadius;
    float lowest = length(cross(eyeScaled, ray));
    if (frame.drawsAtmosphere != 0 && (rise > 0.0 || lowest > 0.985 * frame.radiusScaleHeights)) {
        float eyeHeight = max(eyeRadius - frame.radiusScaleHeights, 0.0);
        float mass = airAlong(eyeHeight, rise, max(lowest, frame.radiusScaleHeights));
        mass = clamp(mass, 0.0, 200.0);
        // Most of the light comes from the ray's lowest point, or from nearer if the air is thick.
        float toLowest = max(-rise * eyeRadius, 0.0);
        float nearer = min(20.0 * clamp(0.05 * mass, 0.0, 1.0), toLowest);
        vec3 dense = eyeScaled + ray * (rise > 0.0 ? 1.5 : toLowest - nearer);
        light = scattered(mass, scattering, sunOnAir(dense), dot(ray, frame.sun));
        clear = exp(-0.6 * mass) * (1.0 - min(dot(light, vec3(3.0)), 1.0));
    }
    // The planet hides the stars behind it, even where it is not drawn.
    if (rise < 0.0 && lowest < frame.radiusScaleHeights) clear = 0.0;
    if (clear > 0.01) light += vec3(0.95, 0.97, 1.0) * (clear * starLight(ray));
    fragment = vec4(developed(max(light, 0.0)) + ditherStep() * step(0.002, light.b), 1.0);
}
