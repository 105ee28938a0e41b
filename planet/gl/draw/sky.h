// The background behind a planet: its atmosphere, and stars. Requires a current context, one thread.
#pragma once

#include <cstddef>
#include <span>

#include "planet/gl/device/gl_objects.h"
#include "planet/gl/device/vertex_inputs.h"
#include "planet/sphere/view.h"
#include "planet/surface/star_field.h"

namespace planet::gl {

class Sky {
public:
    Sky();

    // Draws at the far depth, so that only pixels without a chunk are shaded. Each program may be null: its part is
    // not drawn then. The frame's uniforms are bound, and the depth test is on.
    void draw(const View& view, const Program* air, const Program* stars) const;

    std::size_t bytes() const { return field_.stars.size() * sizeof(Star); }  // on the GPU

private:
    StarField field_;
    Buffer vertices_;
    VertexArray array_;
};

// Returns the inputs of shaders/stars.vert: those of a Star.
std::span<const VertexInput> starInputs();

// Makes the bound vertex array read them from this buffer.
void describeStars(const Buffer& stars);

// Set and restore the state in which points are added to what is drawn.
void beginStars();
void endStars();

}  // namespace planet::gl
