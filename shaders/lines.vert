// Expands a line to a quad on the screen: four vertices per instance, two at either end.

in vec3 start;  // metres from the eye, world axes
in vec4 startColour;
in vec3 end;
in vec4 endColour;

uniform mat4 clipFromWorld;  // without the translation
uniform vec2 halfViewportPx;
uniform float halfWidthPx;  // half the line's width
uniform float nearestM;     // lines are clipped at this distance

out vec4 colour;                 // sRGB and opacity
noperspective out float aside;   // distance from the line's middle, pixels

const vec4 nowhere = vec4(2.0, 2.0, 2.0, 1.0);

void main() {
    bool atEnd = gl_VertexID >= 2;
    float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
    vec4 from = clipFromWorld * vec4(start, 1.0);
    vec4 to = clipFromWorld * vec4(end, 1.0);
    colour = startColour;
    aside = 0.0;
    gl_Position = nowhere;
    if (max(from.w, to.w) <= nearestM) return;
    // Clips the nearer part: a point behind the eye has no place on the screen.
    float fromShare = from.w < nearestM ? (nearestM - from.w) / (to.w - from.w) : 0.0;
    float toShare = to.w < nearestM ? (nearestM - from.w) / (to.w - from.w) : 1.0;
    vec4 nearFrom = mix(from, to, fromShare);
    vec4 nearTo = mix(from, to, toShare);
    // Computes the difference of the two screen positions up to a factor. It does not divide, so a point
    // close to the eye loses no precision.
    vec2 along = (nearTo.xy * nearFrom.w - nearFrom.xy * nearTo.w) * halfViewportPx;
    float size = length(along);
    vec2 across = size > 0.0 ? vec2(-along.y, along.x) / size : vec2(1.0, 0.0);
    float reach = halfWidthPx + 1.0;  // one pixel more, for antialiasing
    vec4 position = atEnd ? nearTo : nearFrom;
    position.xy += side * reach * across / halfViewportPx * position.w;
    colour = mix(startColour, endColour, atEnd ? toShare : fromShare);
    aside = side * reach;
    gl_Position = position;
}
