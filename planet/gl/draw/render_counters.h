// The counters, capabilities and GPU memory of the renderer (chunk_renderer.h), as plain data.
#pragma once

#include <cstddef>
#include <cstdint>

namespace planet::gl {

struct RenderCounters {
    std::uint32_t chunks = 0;
    std::uint64_t groundTriangles = 0;
    std::uint64_t skirtTriangles = 0;
    // GPU times, ms, of the last frame with finished timer queries.
    double chunksMs = 0;  // including the clear
    double skyMs = 0;
    double shadowsMs = 0;
    std::uint32_t uploads = 0;  // chunks uploaded since the previous draw
    // With ShaderWait::Never: the programs for the settings are still being compiled, or the first tables of
    // the atmosphere computed. Other programs drew the frame, or none, so it does not show the settings.
    bool standIn = false;
    // With ShaderWait::UntilReady: the programs that were used for the first time. The draw waited for their compilation.
    std::uint32_t newPrograms = 0;

    std::uint64_t triangles() const { return groundTriangles + skirtTriangles; }
};

// The context's features that the renderer uses.
struct RenderCapabilities {
    // The context has GL_ARB_clip_control. Without it, or with a depth buffer that is not float, the near
    // plane depends on the height above the highest drawn ground.
    bool reversedZ = false;
    int samples = 1;        // the largest for a RenderTarget
    bool software = false;  // the CPU renders
    float anisotropy = 1;   // of the samplers of tiles
};

// The GPU memory that the renderer holds, bytes.
struct GpuMemory {
    std::size_t heightPool = 0;
    std::size_t meshes = 0;  // grid and instances
    std::size_t textures = 0;
    // Parts of textures that hold streamed colours.
    std::size_t colourTiles = 0;    // the pool of tiles and its page table
    std::size_t colourClipmap = 0;  // 0: no clipmap
    std::size_t shadowMaps = 0;

    std::size_t total() const { return heightPool + meshes + textures + shadowMaps; }

    GpuMemory& operator+=(const GpuMemory& other) {
        heightPool += other.heightPool;
        meshes += other.meshes;
        textures += other.textures;
        colourTiles += other.colourTiles;
        colourClipmap += other.colourClipmap;
        shadowMaps += other.shadowMaps;
        return *this;
    }
};

}  // namespace planet::gl
