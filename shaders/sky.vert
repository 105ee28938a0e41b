// Draws one triangle that covers the view at the far depth.

out vec3 skyRay;
flat out ShadingFrame held;
flat out float pixelRad;

void main() {
    held = frame.shading;
    pixelRad = frame.pixelRad;
    vec2 corner = vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID >> 1) * 4 - 1);
    skyRay = frame.rayForward + corner.x * frame.rayRight + corner.y * frame.rayUp;
    gl_Position = vec4(corner, frame.skyDepth, 1.0);
}
