// Resamples a face's part of an equirectangular image to the face's grid, once per image, so that the surface
// finds its colour without angles, seams or poles.

in vec2 faceAt;

uniform sampler2D sphereImage;  // the sampler decodes sRGB
uniform vec3 faceNormal;
uniform vec3 faceU;
uniform vec3 faceV;

out vec4 fragment;

const float pi = 3.14159265;

// Returns a point of the unit sphere by Nowell's mapping.
vec3 sphereFromCube(vec3 cube) {
    vec3 s = cube * cube;
    return cube * sqrt(1.0 - 0.5 * (s.yzx + s.zxy) + s.yzx * s.zxy / 3.0);
}

// Samples the image. Texture coordinates are computed from the direction, and their derivatives from the
// direction's derivatives, so that they are continuous across the seam at longitude 180. The derivative along
// longitude is shortened with the circle of latitude, because near a pole the image holds no more detail on
// the ground than elsewhere.
vec3 imageColour(vec3 up) {
    vec3 dx = dFdx(up);
    vec3 dy = dFdy(up);
    float ring = max(length(up.xy), 1e-5);
    vec2 place = vec2(atan(up.y, up.x) / (2.0 * pi) + 0.5, acos(clamp(up.z, -1.0, 1.0)) / pi);
    vec2 east = vec2(-up.y, up.x) / ring;
    vec2 scale = vec2(0.5, -1.0) / pi;
    vec2 across = scale * vec2(dot(east, dx.xy), dx.z / ring);
    vec2 along = scale * vec2(dot(east, dy.xy), dy.z / ring);
    return textureGrad(sphereImage, place, across, along).rgb;
}

void main() {
    vec3 image = imageColour(normalize(sphereFromCube(faceNormal + faceAt.x * faceU + faceAt.y * faceV)));
    fragment = vec4(sqrt(image), waterOf(image));
}
