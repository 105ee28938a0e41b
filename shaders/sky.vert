// One triangle over the whole view, as far away as depth goes.

out vec3 skyRay;

void main() {
    vec2 corner = vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID >> 1) * 4 - 1);
    skyRay = rayForward.xyz + corner.x * rayRight.xyz + corner.y * rayUp.xyz;
    gl_Position = vec4(corner, screen.y, 1.0);
}
