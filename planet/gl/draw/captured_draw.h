// The ground of one draw as a static mesh: its vertices hold all that the vertex shader made of them. Drawing it takes the
// time of a draw without selection, instances and the vertex shader, so it is the yardstick of a benchmark. Plain data;
// requires the context that made it.
#pragma once

#include <epoxy/gl.h>

#include "planet/gl/device/gl_objects.h"

namespace planet::gl {

struct CapturedDraw {
    Program
        program;  // the fragment shader of the draw, and a vertex shader that passes on what the vertices hold
    VertexArray array;
    Buffer vertices;
    Buffer indices;
    GLsizei indexCount = 0;
};

}  // namespace planet::gl
