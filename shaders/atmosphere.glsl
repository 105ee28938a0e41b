// A thin exponential atmosphere in closed form. The air along a ray follows Chapman's grazing-incidence
// function, as approximated by Schueler ("An approximation to the Chapman grazing-incidence function for
// atmospheric scattering", GPU Pro 3). Single scattering is taken where the ray is densest.
//
// Lengths are in scale heights; radiusScaleHeights is the planet's radius. An air mass of 1 is the air
// straight up from height 0.

// Rayleigh scattering at 680, 550 and 440 nm per air mass: half of the Earth's, which would veil the ground.
const vec3 scattering = vec3(0.023, 0.054, 0.132);
const float haze = 0.007;  // grey and mostly forward scattering
const vec3 sunLight = vec3(3.4, 3.3, 3.15);
const vec3 sunExtinction = 1.6 * scattering + vec3(haze);  // redder evenings than such thin air gives

// The air mass along the horizontal at height 0, of that straight up.
const float groundGrazing = sqrt(1.5708 * radiusScaleHeights);

// Returns the same from a radius, scale heights. It grows with the root of the radius, which is nearly linear up to
// heights whose air counts.
float grazingAt(float radius) {
    return groundGrazing * (0.5 + 0.5 / radiusScaleHeights * radius);
}

// Returns the air mass along a ray outwards, of that straight up. rise: cosine of the ray to the zenith, >= 0.
float slantOf(float grazing, float rise) {
    return grazing / ((grazing - 1.0) * rise + 1.0);
}

// Returns the air mass from a height outwards.
float airAbove(float height, float rise) {
    return slantOf(grazingAt(radiusScaleHeights + height), rise) * exp(-height);
}

// Returns the air mass of a whole ray, both ways from its lowest point.
float airThroughLowest(float lowestRadius) {
    return 2.0 * grazingAt(lowestRadius) * exp(radiusScaleHeights - lowestRadius);
}

// Returns the air mass for a ray that may dip below the horizontal: the air from its lowest point in both
// directions, less the part behind its start.
float airAlong(float height, float rise, float lowestRadius) {
    float mass = airAbove(height, abs(rise));
    return rise >= 0.0 ? mass : airThroughLowest(lowestRadius) - mass;
}

// Returns the transmittance of the sun's light at a height. sunRise: cosine of the sun to the zenith.
vec3 sunThrough(float height, float sunRise) {
    float lowest = (radiusScaleHeights + height) * sqrt(max(1.0 - sunRise * sunRise, 0.0));
    float mass = airAlong(height, sunRise, max(lowest, radiusScaleHeights - 8.0));
    return exp(-sunExtinction * min(max(mass, 0.0), 4000.0));
}

// Returns the sun's light at a scattering place, including the glow of the lit air around it.
vec3 sunOnAir(vec3 place) {
    float radius = length(place);
    float sunRise = dot(place, shading.sun) / radius;
    float height = max(radius - radiusScaleHeights, 0.0) + 0.25;
    return sunThrough(height, sunRise) + vec3(0.030, 0.040, 0.065) * smoothRise(-0.20, 0.06, sunRise);
}

// Returns the light that air scatters towards the eye. amount: scattering per air mass. sunHere: the sun's
// light there.
vec3 scattered(float mass, vec3 amount, vec3 sunHere, float sunAlongRay) {
    float rayleigh = 0.75 * (1.0 + sunAlongRay * sunAlongRay);
    float k = 1.0 / (1.0 - 0.76 * sunAlongRay);  // Schlick's phase function
    float forward = 0.42 * k * k;
    vec3 taken = amount + vec3(haze);
    vec3 share = (amount * rayleigh + vec3(haze * forward)) * (1.0 / taken);  // 1 / taken is constant in the sky
    return sunLight * 0.21 * sunHere * share * (1.0 - exp(-taken * mass));
}

// Returns the scattering of the air before the ground. Near the ground it is paler than Rayleigh's: the
// ground keeps its own colours, and fades to a bright haze in the distance without turning dark blue on the
// way.
vec3 scatteringBeforeGround() {
    return mix(scattering, vec3(0.030, 0.055, 0.104), shading.nearGround);
}

// Returns the air mass between the eye and a place on the surface; for the same reason it is reduced before
// near ground and increased before far ground. ray, up: unit vectors. height: scale heights. A ray that falls
// at the eye and rises at its end, to ground beyond the horizon, passes its lowest point on the way.
float airBefore(vec3 ray, vec3 up, float height) {
    float fall = dot(shading.eyeUp, ray);
    float rise = dot(up, ray);
    float ground = slantOf(groundGrazing, abs(rise)) * exp(-height);  // heights are small beside the radius
    float here = slantOf(shading.eyeGrazing, abs(fall)) * shading.eyeAir;
    float mass = fall < 0.0 ? ground - here : here - ground;
    if (fall < 0.0 && rise > 0.0) {
        float lowest = (radiusScaleHeights + shading.eyeScaleHeights) * sqrt(max(1.0 - fall * fall, 0.0));
        mass = airThroughLowest(max(lowest, radiusScaleHeights - 8.0)) - here - ground;
    }
    mass = max(mass, 0.0);
    return mass * mix(1.0, mass * (1.0 + 0.125 * mass) / (mass + 1.8), shading.nearGround);
}

// Returns the sun's light on that air. Along a slanting ray most of the scattered light comes from nearer and
// higher than the surface.
vec3 sunOnAirBefore(vec3 position, vec3 ray, vec3 up, float height) {
    float nearer = min(min(1.0 / (max(-dot(up, ray), 0.0) + 0.04), 25.0),
                       0.7 * length(position) * shading.scaleHeightsPerM);
    vec3 bluer = mix(vec3(1.0), vec3(0.80, 0.95, 1.12), shading.nearGround);  // multiple scattering
    return bluer * sunOnAir(up * (radiusScaleHeights + height) - ray * nearer);
}
