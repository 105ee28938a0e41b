// A thin exponential atmosphere in closed form: the air along a ray by Chapman's grazing-incidence function as
// approximated by Schueler ("An approximation to the Chapman grazing-incidence function for atmospheric
// scattering", GPU Pro 3), and the light scattered once, taken where the ray is densest.
//
// Lengths are in scale heights; the planet's radius is atmosphere.x of them. An air mass of 1 is what lies
// straight up from height 0.

// Rayleigh's at 680, 550 and 440 nm, an air mass; half of the Earth's, which would veil the ground.
const vec3 scattering = vec3(0.023, 0.054, 0.132);
const float haze = 0.007;  // grey and mostly forward
const vec3 sunLight = vec3(3.4, 3.3, 3.15);
const vec3 extinction = scattering + vec3(haze);
const vec3 sunExtinction = 1.6 * scattering + vec3(haze);  // a redder evening than so thin an air would make

// Air from a height outwards, along a ray that rises with this cosine to the zenith, 0 or more.
float airAbove(float height, float rise) {
    float grazing = sqrt(1.5708 * (atmosphere.x + height));
    return grazing / ((grazing - 1.0) * rise + 1.0) * exp(-height);
}

// The same for a ray that may dip below the horizontal: from its lowest point out to both sides, less what
// lies behind its start.
float airAlong(float height, float rise, float lowestRadius) {
    if (rise >= 0.0) return airAbove(height, rise);
    float both = 2.0 * sqrt(1.5708 * lowestRadius) * exp(atmosphere.x - lowestRadius);
    return both - airAbove(height, -rise);
}

// What is left of the sun's light at a height where the sun stands at this cosine to the zenith.
vec3 sunThrough(float height, float sunRise) {
    float lowest = (atmosphere.x + height) * sqrt(max(1.0 - sunRise * sunRise, 0.0));
    float air = airAlong(height, sunRise, max(lowest, atmosphere.x - 8.0));
    return exp(-sunExtinction * min(max(air, 0.0), 4000.0));
}

// The same where light is scattered, with the glow of the lit air around it.
vec3 sunOnAir(vec3 place) {
    float radius = length(place);
    float sunRise = dot(place, sun.xyz) / radius;
    float height = max(radius - atmosphere.x, 0.0) + 0.25;
    return sunThrough(height, sunRise) + vec3(0.030, 0.040, 0.065) * smoothstep(-0.20, 0.06, sunRise);
}

// Light scattered towards the eye over so much air, the sun's light arriving there as given.
vec3 scattered(float air, vec3 sunHere, float sunAlongRay) {
    float rayleigh = 0.75 * (1.0 + sunAlongRay * sunAlongRay);
    float k = 1.0 / (1.0 - 0.76 * sunAlongRay);  // Schlick's phase function
    float forward = 0.42 * k * k;
    vec3 share = (scattering * rayleigh + vec3(haze * forward)) / extinction;
    return sunLight * 0.21 * sunHere * share * (1.0 - exp(-extinction * air));
}

// Linear light to what a screen shows: rolls off softly, then the sRGB curve.
vec3 encodeSrgb(vec3 colour) {
    return mix(1.055 * pow(max(colour, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055, colour * 12.92,
               lessThanEqual(colour, vec3(0.0031308)));
}

vec3 decodeSrgb(vec3 colour) {
    return mix(pow((colour + 0.055) / 1.055, vec3(2.4)), colour / 12.92, lessThanEqual(colour, vec3(0.04045)));
}

vec3 exposed(vec3 light) {
    return light * (1.0 + light * 0.09) / (1.0 + light);
}

// Half a step of the 8 bits, in a pattern too fine to see, against bands in slow gradients.
float ditherStep() {
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    return (noise - 0.5) / 255.0;
}
