// How many GL objects of each kind the current context has, whoever made them.
//
// The driver is asked about one name after the other, up to those that it hands out now and some beyond. So
// no count has to be kept beside the objects, objects of other libraries are seen too, and another thread's
// context is not mixed in. Some thousand calls that draw nothing, more where many objects have come and gone;
// a driver that works behind the caller's back may have to be waited for. So not for every frame.
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

// Wants a current context. An object counts from when it is first bound or begun.
ObjectCounts countObjects();

}  // namespace planet::gl
