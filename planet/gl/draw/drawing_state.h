// The OpenGL state that chunks and the sky are drawn with. Drivers generate machine code for the state of a
// program's first draw, which takes some of them far longer than linking: drawNothing makes that draw. Wants
// a current context; one thread each.
#pragma once

#include <epoxy/gl.h>

#include <vector>

#include "planet/gl/device/gl_objects.h"

namespace planet::gl {

enum class ProgramUse { Chunk, Depth, Sky };  // Depth: chunks as the sun sees them

void beginDepthTest(bool reversedZ);
// Restores the depth test of a new context.
void endDepthTest(bool reversedZ);

struct BoundTexture {
    GLuint unit = 0;
    GLenum target = GL_TEXTURE_2D_ARRAY;
    GLuint name = 0;
};

// Drivers compile a program for this state, beside its text.
struct DrawingState {
    bool reversedZ = false;
    int samples = 1;
    std::vector<BoundTexture> textures;
};

// Reads the current state; samples are those of the framebuffer that is bound for drawing. Leaves texture
// unit 0 active.
DrawingState currentDrawingState(bool reversedZ);

// Draws with the program into a small target of its own and waits until that is done. Leaves the context's
// state changed: for a context that does nothing else.
void drawNothing(const Program& program, ProgramUse use, const DrawingState& state);

}  // namespace planet::gl
