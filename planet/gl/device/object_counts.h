// Counts the current context's GL objects of each kind, whoever made them.
//
// The driver is queried name by name, up to the name it hands out now and somewhat beyond. This needs no
// bookkeeping, includes the objects of other libraries, and leaves out those of another thread's context. It
// takes some thousand calls that draw nothing, more if many objects have been created and deleted, and may
// wait for a driver that works asynchronously. So do not call it every frame.
#pragma once

#include <cstdint>

namespace planet::gl {

struct ObjectCounts {
    std::uint32_t buffers = 0;
    std::uint32_t textures = 0;
    std::uint32_t vertexArrays = 0;
    std::uint32_t framebuffers = 0;
    std::uint32_t renderbuffers = 0;
    std::uint32_t queries = 0;
    std::uint32_t shaders = 0;
    std::uint32_t programs = 0;

    std::uint32_t total() const {
        return buffers + textures + vertexArrays + framebuffers + renderbuffers + queries + shaders +
               programs;
    }
    bool operator==(const ObjectCounts&) const = default;
};

// Requires a current context. An object counts once it has been bound or begun.
ObjectCounts countObjects();

}  // namespace planet::gl
