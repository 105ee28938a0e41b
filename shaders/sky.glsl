// The background along a ray.

struct SkyLight {
    vec3 light;
    vec3 through;  // transmittance of the stars' light; 0 where the air is so bright that they are not seen
};

SkyLight physicalSky(vec3 ray, float pixelRad) {
    bool meetsGround = false;
    AirLight sky = lightOfSky(ray, meetsGround);
    if (meetsGround) return SkyLight(onFilm(max(sky.scattered, 0.0)), vec3(0.0));
    vec3 light = sky.scattered + sky.through * air.light * (5.0 * sunDisk(dot(ray, shading.sun), pixelRad));
    float clear = max(1.0 - 12.0 * (sky.scattered.r + sky.scattered.g + sky.scattered.b), 0.0);
    return SkyLight(onFilm(min(max(light, 0.0), vec3(1e4))), sky.through * clear);
}

SkyLight analyticSky(vec3 ray) {
    float eyeRadius = radiusScaleHeights + shading.eyeScaleHeights;
    float rise = dot(shading.eyeUp, ray);
    float lowest = eyeRadius * length(cross(shading.eyeUp, ray));
    // The planet hides the stars behind it, even where it is not drawn.
    float clear = rise < 0.0 && lowest < radiusScaleHeights ? 0.0 : 1.0;
    if (!switchAir) return SkyLight(vec3(0.0), vec3(clear));
    float mass = airAlong(shading.eyeScaleHeights, rise, max(lowest, radiusScaleHeights));
    mass = rise > 0.0 || lowest > 0.985 * radiusScaleHeights ? clamp(mass, 0.0, 200.0) : 0.0;
    // Most of the light comes from the ray's lowest point, or from nearer if the air is thick.
    float toLowest = max(-rise * eyeRadius, 0.0);
    float nearer = min(20.0 * clamp(0.05 * mass, 0.0, 1.0), toLowest);
    vec3 dense = eyeRadius * shading.eyeUp + ray * (rise > 0.0 ? 1.5 : toLowest - nearer);
    vec3 light = scattered(mass, scattering, sunOnAir(dense), dot(ray, shading.sun));
    clear *= exp(-0.6 * mass) * (1.0 - min(dot(light, vec3(3.0)), 1.0));
    return SkyLight(light, vec3(clear));
}

// Returns the light along a unit vector. pixelRad: the angle of a pixel, which the sun's edge is wide.
SkyLight skyAlong(vec3 ray, float pixelRad) {
    if (switchPhysicalAir) return physicalSky(ray, pixelRad);
    return analyticSky(ray);
}
