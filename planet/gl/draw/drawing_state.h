// The OpenGL state that chunks and the sky are drawn with. Drivers generate machine code for the state of a
// program's first draw, which in some drivers takes far longer than linking; drawNothing makes that draw.
// Requires a current context; one thread per context.
#pragma once

#include <epoxy/gl.h>

#include <vector>

#include "planet/gl/device/gl_objects.h"

namespace planet::gl {

enum class ProgramUse { Chunk, Depth, Sky, Stars };  // Depth: chunks seen from the sun

void beginDepthTest(bool reversedZ);
// Restores a new context's depth test.
void endDepthTest(bool reversedZ);

struct BoundTexture {
    GLuint unit = 0;
    GLenum target = GL_TEXTURE_2D_ARRAY;
    GLuint name = 0;
};

// The state that drivers compile a program for, besides its text.
struct DrawingState {
    bool reversedZ = false;
    int samples = 1;
    std::vector<BoundTexture> textures;
};

// Returns the samples per pixel of the draw framebuffer, >= 1.
int boundSamples();

// Reads the current state; samples are those of the draw framebuffer. Leaves texture unit 0 active.
DrawingState currentDrawingState(bool reversedZ);

// Draws with the program into a small target of its own and waits for it. Changes the context's state, so use
// it in a context that does nothing else.
void drawNothing(const Program& program, ProgramUse use, const DrawingState& state);

}  // namespace planet::gl
