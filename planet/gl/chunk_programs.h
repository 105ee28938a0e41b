// The programs that a planet is drawn with, and where they look for their inputs. Wants a current context;
// one thread.
#pragma once

#include <epoxy/gl.h>

#include <filesystem>
#include <span>
#include <unordered_map>
#include <vector>

#include "planet/gl/gl_objects.h"
#include "planet/gl/shader_source.h"
#include "planet/result.h"

namespace planet::gl {

// Uniform blocks. The air's is 5 (air_textures.cpp).
inline constexpr GLuint frameBinding = 0;
inline constexpr GLuint layersBinding = 4;
inline constexpr GLuint seaBinding = 6;
inline constexpr GLuint shadowsBinding = 7;
inline constexpr GLuint clipmapBinding = 12;
// Texture units. The air's are 10 to 12.
inline constexpr GLint heightUnit = 0;
inline constexpr GLint imageUnit = 1;
inline constexpr GLint noiseUnit = 2;
inline constexpr GLint tilesUnit = 3;
inline constexpr GLint pagesUnit = 4;
inline constexpr GLint rootsUnit = 5;
inline constexpr GLint clipmapStackUnit = tilesUnit;  // drawn from in place of the tiles
inline constexpr GLint clipmapBaseUnit = 6;
inline constexpr GLint shadowsUnit = 7;
inline constexpr GLint layerAlbedoUnit = 8;
inline constexpr GLint layerSurfaceUnit = 9;
inline constexpr GLint normalTilesUnit = 13;
inline constexpr GLint normalPagesUnit = 14;
inline constexpr GLint normalRootsUnit = 15;

class ChunkPrograms {
public:
    // With chunk programs for the variants given, at least one; a folder, or the shaders built in where it is
    // empty. All variants see the whole text, so that when one compiles, others will later. The Error names
    // the file.
    static Result<ChunkPrograms> build(const std::filesystem::path& folder, std::span<const int> variants);

    // Of a variant (Switch in frame_uniforms.h), compiled when first asked for. Should a driver not have it,
    // any that there is.
    const Program& chunk(int variant);
    // For depth alone, as seen from the sun; none where a driver will not have it.
    const Program& depth(int variant);
    // Those of chunks that there are.
    std::vector<int> variants() const;
    // One more, of which these outputs of vertices can be read back.
    Result<Program> capturing(int variant, std::span<const char* const> outputs) const;

    const Program& sky(bool physicalAir) const { return physicalAir ? physicalSky_ : sky_; }
    const Program& faceImage() const { return faceImage_; }
    const Program& clipmapFill() const { return clipmapFill_; }

private:
    ChunkPrograms() = default;

    ShaderText chunkVertex_, chunkFragment_, depthFragment_;
    std::unordered_map<int, Program> chunk_;  // by variant; those that were drawn with
    std::unordered_map<int, Program> depth_;  // likewise, for shadows
    Program sky_, physicalSky_, faceImage_, clipmapFill_;
};

}  // namespace planet::gl
