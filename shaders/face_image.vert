// Draws one triangle that covers a face of the cube.

out vec2 faceAt;  // (u, v), somewhat beyond [-1, 1]: the outermost texels' centres lie on the edges

uniform float overhang;

void main() {
    vec2 corner = vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID >> 1) * 4 - 1);
    faceAt = corner * overhang;
    gl_Position = vec4(corner, 0.0, 1.0);
}
