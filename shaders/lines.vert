// A line as a quad on the screen: four vertices an instance, two at either end.

in vec3 start;  // metres from the eye, world axes
in vec4 startColour;
in vec3 end;
in vec4 endColour;

uniform mat4 clipFromWorld;  // without the translation
uniform vec2 halfViewportPx;
uniform float halfWidthPx;  // of the line
uniform float nearestM;     // lines that come closer are cut off

out vec4 colour;                 // sRGB and opacity
noperspective out float aside;   // pixels from the line's middle, either way

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
    // What lies nearer is cut off here: a point behind the eye has no place on the screen.
    float fromShare = from.w < nearestM ? (nearestM - from.w) / (to.w - from.w) : 0.0;
    float toShare = to.w < nearestM ? (nearestM - from.w) / (to.w - from.w) : 1.0;
    vec4 nearFrom = mix(from, to, fromShare);
    vec4 nearTo = mix(from, to, toShare);
    // The difference of the two places on the screen, but for a factor: without dividing, so that a point close to
    // the eye loses nothing.
    vec2 along = (nearTo.xy * nearFrom.w - nearFrom.xy * nearTo.w) * halfViewportPx;
    float size = length(along);
    vec2 across = size > 0.0 ? vec2(-along.y, along.x) / size : vec2(1.0, 0.0);
    float reach = halfWidthPx + 1.0;  // a pixel more, for the smooth side
    vec4 position = atEnd ? nearTo : nearFrom;
    position.xy += side * reach * across / halfViewportPx * position.w;
    colour = mix(startColour, endColour, atEnd ? toShare : fromShare);
    aside = side * reach;
    gl_Position = position;
}
