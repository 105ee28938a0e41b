// A line as a quad on the screen: four vertices an instance, two at either end.

layout(location = 0) in vec3 start;  // metres from the eye, world axes
layout(location = 1) in vec4 startColour;
layout(location = 2) in vec3 end;
layout(location = 3) in vec4 endColour;

uniform mat4 clipFromWorld;  // without the translation
uniform vec4 screen;         // half the viewport, pixels; half the line's width, pixels; the nearest distance

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
    float nearest = screen.w;
    if (max(from.w, to.w) <= nearest) return;
    // What lies nearer is cut off here: a point behind the eye has no place on the screen.
    float fromShare = from.w < nearest ? (nearest - from.w) / (to.w - from.w) : 0.0;
    float toShare = to.w < nearest ? (nearest - from.w) / (to.w - from.w) : 1.0;
    vec4 nearFrom = mix(from, to, fromShare);
    vec4 nearTo = mix(from, to, toShare);
    // The difference of the two places on the screen, but for a factor: without dividing, so that a point close to
    // the eye loses nothing.
    vec2 along = (nearTo.xy * nearFrom.w - nearFrom.xy * nearTo.w) * screen.xy;
    float size = length(along);
    vec2 across = size > 0.0 ? vec2(-along.y, along.x) / size : vec2(1.0, 0.0);
    float reach = screen.z + 1.0;  // a pixel more, for the smooth side
    vec4 position = atEnd ? nearTo : nearFrom;
    position.xy += side * reach * across / screen.xy * position.w;
    colour = mix(startColour, endColour, atEnd ? toShare : fromShare);
    aside = side * reach;
    gl_Position = position;
}
