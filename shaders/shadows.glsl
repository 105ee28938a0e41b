// How much of the sun the ground sees past other ground. planet/select/shadow_cascades.h.

const int cascadeCount = 3;

layout(std140) uniform Shadows {
    mat4 shadowPlace[cascadeCount];   // from positions relative to the eye to [0, 1]: place in the map, depth
    vec4 shadowTexels[cascadeCount];  // metres of a texel; where the cascade ends, along the view; unused
    vec4 shadowFilter;                // radius, texels; size of a texel, [0, 1] across the map; unused
};

uniform sampler2DArrayShadow shadowMaps;

float shadowAt(int cascade, vec3 position) {
    vec3 place = (shadowPlace[cascade] * vec4(position, 1.0)).xyz;
    float seen = texture(shadowMaps, vec4(place.xy, float(cascade), place.z));
    if (shadowFilter.x == 0.0) return seen;
    float aside = shadowFilter.x * shadowFilter.y;
    for (int i = 0; i < 8; ++i) {
        // The places around a square's middle.
        int at = i < 4 ? i : i + 1;
        vec2 to = vec2(at % 3 - 1, at / 3 - 1) * aside;
        seen += texture(shadowMaps, vec4(place.xy + to, float(cascade), place.z));
    }
    return seen / 9.0;
}

// [0, 1]. normal: of the mesh, unit. The place asked for lies above the ground by what the filter reaches over on
// a slope that the sun grazes.
float sunSeen(vec3 position, vec3 normal) {
    float along = dot(position, rayForward.xyz);
    float last = shadowTexels[cascadeCount - 1].y;
    if (along >= last) return 1.0;
    int cascade = along < shadowTexels[0].y ? 0 : along < shadowTexels[1].y ? 1 : 2;
    float facing = dot(normal, sun.xyz);
    vec3 off = normal * ((1.0 + shadowFilter.x) * sqrt(max(1.0 - facing * facing, 0.0)));
    float seen = shadowAt(cascade, position + off * shadowTexels[cascade].x);
    // Into the next one over a tenth of its length, and out at the end.
    float end = shadowTexels[cascade].y;
    float begin = cascade == 0 ? 0.0 : shadowTexels[cascade - 1].y;
    float onward = smoothstep(mix(begin, end, 0.9), end, along);
    if (onward == 0.0) return seen;
    float next = cascade + 1 < cascadeCount
                     ? shadowAt(cascade + 1, position + off * shadowTexels[min(cascade + 1, cascadeCount - 1)].x)
                     : 1.0;
    return mix(seen, next, onward);
}
