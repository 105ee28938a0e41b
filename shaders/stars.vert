// Draws stars as points at the far depth.

in vec3 star;  // unit vector
in float starLight;

flat out vec3 before;   // light of the sky before the star
flat out vec3 lit;      // light of the star in its middle
flat out float sizePx;  // of the point

// Less light than this cannot be seen on black.
const float leastSeen = 2.5e-4;
// Stars are dimmed where their cells are narrower than this. Otherwise a small picture of the sky would be brighter than
// a large one.
const float farApartPx = 6.0;

void main() {
    shading = frame.shading;
    SkyLight sky = skyAlong(star, frame.pixelRad);
    before = max(sky.light, 0.0);
    float apart = min(starCellRad / (frame.pixelRad * farApartPx), 1.0);
    lit = vec3(0.95, 0.97, 1.0) * sky.through * (starLight * apart * apart * apart);
    float brightest = max(lit.r, max(lit.g, lit.b));
    sizePx = 1.0 + 2.0 * sqrt(max(log(brightest / leastSeen), 0.0) / starFall);
    gl_PointSize = sizePx;
    float ahead = dot(star, frame.rayForward);
    vec2 place = vec2(dot(star, frame.rayRight) / dot(frame.rayRight, frame.rayRight),
                      dot(star, frame.rayUp) / dot(frame.rayUp, frame.rayUp));
    gl_Position = vec4(place, frame.skyDepth * ahead, ahead);
    if (brightest < leastSeen) gl_Position = vec4(0.0, 0.0, 0.0, -1.0);  // clipped
}
