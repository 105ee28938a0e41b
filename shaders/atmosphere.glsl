// A thin exponential atmosphere in closed form: the air along a ray by Chapman's grazing-incidence function as
// approximated by Schueler ("An approximation to the Chapman grazing-incidence function for atmospheric
// scattering", GPU Pro 3), and the light scattered once, taken where the ray is densest.
//
// Lengths are in scale heights; the planet's radius is frame.radiusScaleHeights of them. An air mass of 1 is
// what lies straight up from height 0.

// Rayleigh's at 680, 550 and 440 nm, an air mass; half of the Earth's, which would veil the ground.
const vec3 scattering = vec3(0.023, 0.054, 0.132);
const float haze = 0.007;  // grey and mostly forward
const vec3 sunLight = vec3(3.4, 3.3, 3.15);
const vec3 sunExtinction = 1.6 * scattering + vec3(haze);  // a redder evening than so thin an air would make

// Air from a height outwards, along a ray that rises with this cosine to the zenith, 0 or more.
float airAbove(float height, float rise) {
    float grazing = sqrt(1.5708 * (frame.radiusScaleHeights + height));
    return grazing / ((grazing - 1.0) * rise + 1.0) * exp(-height);
}

// The same for a ray that may dip below the horizontal: from its lowest point out to both sides, less what
// lies behind its start.
float airAlong(float height, float rise, float lowestRadius) {
    if (rise >= 0.0) return airAbove(height, rise);
    float both = 2.0 * sqrt(1.5708 * lowestRadius) * exp(frame.radiusScaleHeights - lowestRadius);
    return both - airAbove(height, -rise);
}

// What is left of the sun's light at a height where the sun stands at this cosine to the zenith.
vec3 sunThrough(float height, float sunRise) {
    float lowest = (frame.radiusScaleHeights + height) * sqrt(max(1.0 - sunRise * sunRise, 0.0));
    float mass = airAlong(height, sunRise, max(lowest, frame.radiusScaleHeights - 8.0));
    return exp(-sunExtinction * min(max(mass, 0.0), 4000.0));
}

// The same where light is scattered, with the glow of the lit air around it.
vec3 sunOnAir(vec3 place) {
    float radius = length(place);
    float sunRise = dot(place, frame.sun) / radius;
    float height = max(radius - frame.radiusScaleHeights, 0.0) + 0.25;
    return sunThrough(height, sunRise) + vec3(0.030, 0.040, 0.065) * smoothstep(-0.20, 0.06, sunRise);
}

// Light scattered towards the eye by air that scatters so much, the sun's light arriving there as given.
vec3 scattered(float mass, vec3 amount, vec3 sunHere, float sunAlongRay) {
    float rayleigh = 0.75 * (1.0 + sunAlongRay * sunAlongRay);
    float k = 1.0 / (1.0 - 0.76 * sunAlongRay);  // Schlick's phase function
    float forward = 0.42 * k * k;
    vec3 taken = amount + vec3(haze);
    vec3 share = (amount * rayleigh + vec3(haze * forward)) / taken;
    return sunLight * 0.21 * sunHere * share * (1.0 - exp(-taken * mass));
}

// What the air before the ground scatters. From nearby paler than Rayleigh's: the ground keeps its own colours,
// and fades to a bright haze far away rather than to a dark blue on the way.
vec3 scatteringBeforeGround() {
    return mix(scattering, vec3(0.030, 0.055, 0.104), frame.nearGround);
}

// Air from a height outwards, likewise, but for heights that are small beside the radius.
float airAboveGround(float height, float rise) {
    float grazing = sqrt(1.5708 * frame.radiusScaleHeights);
    return grazing / ((grazing - 1.0) * rise + 1.0) * exp(-height);
}

// Air between the eye and a place of the surface, thinner before near ground and thicker before far, for the same
// reason: its ray, unit, the direction up there, and the height, scale heights. A ray that falls from the eye and rises
// where it ends, to ground beyond the horizon, passes its lowest point on the way.
float airBefore(vec3 ray, vec3 up, float height) {
    float fall = dot(frame.eyeUp, ray);
    float rise = dot(up, ray);
    float ground = airAboveGround(height, abs(rise));
    float here = airAbove(frame.eyeScaleHeights, abs(fall));
    float mass = fall < 0.0 ? ground - here : here - ground;
    if (fall < 0.0 && rise > 0.0) {
        float lowest = (frame.radiusScaleHeights + frame.eyeScaleHeights) * sqrt(max(1.0 - fall * fall, 0.0));
        mass = airAlong(frame.eyeScaleHeights, fall, max(lowest, frame.radiusScaleHeights - 8.0)) - ground;
    }
    mass = max(mass, 0.0);
    return mass * mix(1.0, mass * (1.0 + 0.125 * mass) / (mass + 1.8), frame.nearGround);
}

// The sun's light on that air: along a slanting ray most of what is scattered comes from nearer and higher than
// the surface itself.
vec3 sunOnAirBefore(vec3 position, vec3 ray, vec3 up, float height) {
    float nearer = min(min(1.0 / (max(-dot(up, ray), 0.0) + 0.04), 25.0),
                       0.7 * length(position) * frame.scaleHeightsPerM);
    vec3 bluer = mix(vec3(1.0), vec3(0.80, 0.95, 1.12), frame.nearGround);  // lit again by the air around it
    return bluer * sunOnAir(up * (frame.radiusScaleHeights + height) - ray * nearer);
}
