// Computes how much of the sun's light other ground lets through (planet/select/shadow_cascades.h).

// planet/gl/draw/shadow_uniforms.h has structs with the same members.
struct CascadeUniforms {
    mat4 place;  // transforms positions relative to the eye to [0, 1]: place in the map, depth
    float texelM;
    float endM;  // along the view direction
};

layout(std140) uniform Shadows {
    CascadeUniforms cascades[shadowCascadeCount];
    float softness;   // radius of the filter, texels
    float texelSize;  // [0, 1] across the map
} shadow;

uniform sampler2DArrayShadow shadowMaps;

float shadowAt(int cascade, vec3 position) {
    vec3 place = (shadow.cascades[cascade].place * vec4(position, 1.0)).xyz;
    float seen = texture(shadowMaps, vec4(place.xy, float(cascade), place.z));
    if (shadow.softness == 0.0) return seen;
    float aside = shadow.softness * shadow.texelSize;
    for (int i = 0; i < 8; ++i) {
        // Skips the middle of the 3 x 3 places.
        int at = i < 4 ? i : i + 1;
        vec2 to = vec2(at % 3 - 1, at / 3 - 1) * aside;
        seen += texture(shadowMaps, vec4(place.xy + to, float(cascade), place.z));
    }
    return seen / 9.0;
}

// Returns the lit share, [0, 1]. normal: of the mesh, unit vector. The sampled place is raised above the
// ground by the reach of the filter on a slope at a grazing sun.
float sunSeen(vec3 position, vec3 normal) {
    float along = dot(position, frame.rayForward);
    float last = shadow.cascades[shadowCascadeCount - 1].endM;
    if (along >= last) return 1.0;
    int cascade = along < shadow.cascades[0].endM ? 0 : along < shadow.cascades[1].endM ? 1 : 2;
    float facing = dot(normal, shading.sun);
    vec3 off = normal * ((1.0 + shadow.softness) * sqrt(max(1.0 - facing * facing, 0.0)));
    float seen = shadowAt(cascade, position + off * shadow.cascades[cascade].texelM);
    // Blends into the next cascade over a tenth of the cascade's length, and fades out at the end of the
    // last.
    float end = shadow.cascades[cascade].endM;
    float begin = cascade == 0 ? 0.0 : shadow.cascades[cascade - 1].endM;
    float onward = smoothstep(mix(begin, end, 0.9), end, along);
    if (onward == 0.0) return seen;
    if (cascade + 1 == shadowCascadeCount) return mix(seen, 1.0, onward);
    return mix(seen, shadowAt(cascade + 1, position + off * shadow.cascades[cascade + 1].texelM), onward);
}
