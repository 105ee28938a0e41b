// Converts linear light to display colours.

// Encodes colours >= 0 as sRGB; colours above 1 stay above 1. A polynomial in the square root replaces the power, with
// an error below a tenth of an 8-bit step. Its even powers are those of the colour, so that fewer operations wait for others.
vec3 encodeSrgb(vec3 colour) {
    vec3 s = sqrt(colour);
    vec3 curve = (1.5177435 * s - 0.0400986) +
                 colour * ((2.0289406 * s - 1.4015750) + colour * (0.5164015 * s - 1.6210848));
    return mix(curve, 12.92 * colour, lessThanEqual(colour, vec3(0.0031308)));
}

// Applies a soft roll-off, x (1 + 0.09 x) / (1 + x), and encodes as sRGB: both at once, as a rational
// function of the square root, with an error below one 8-bit step.
vec3 developed(vec3 light) {
    vec3 s = sqrt(light);
    vec3 below = 1.0 + s * (31.3969 + 32.0001 * s);
    float perAll = 1.0 / (below.r * below.g * below.b);  // one division for three
    return clamp(s * (49.7629 * s - 0.66141) * (below.gbr * below.brg * perAll), 0.0, 1.0);
}

// Returns half an 8-bit step in a fine pattern, to prevent banding in slow gradients.
float ditherStep() {
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    return (noise - 0.5) * (1.0 / 255.0);
}
