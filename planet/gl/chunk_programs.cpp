#include "planet/gl/chunk_programs.h"

#include <array>
#include <string_view>
#include <utility>

#include "planet/gl/air_textures.h"
#include "planet/gl/frame_uniforms.h"

namespace planet::gl {

namespace {

constexpr auto chunkVertexFiles = std::to_array<std::string_view>(
    {"frame.glsl", "atmosphere.glsl", "air.glsl", "ground.glsl", "vertex_position.glsl", "chunk.vert"});
constexpr auto chunkFragmentFiles = std::to_array<std::string_view>(
    {"frame.glsl", "atmosphere.glsl", "air.glsl", "ground.glsl", "tone.glsl", "water.glsl", "sea.glsl",
     "shadows.glsl", "layers.glsl", "tile_lookup.glsl", "colour_tiles.glsl", "colour_clipmap.glsl",
     "normal_tiles.glsl", "chunk.frag"});
constexpr std::array<std::string_view, 1> depthFragmentFiles = {"depth.frag"};
constexpr std::array<std::string_view, 2> skyVertexFiles = {"frame.glsl", "sky.vert"};
constexpr std::array<std::string_view, 5> skyFragmentFiles = {"frame.glsl", "atmosphere.glsl", "air.glsl",
                                                              "tone.glsl", "sky.frag"};
constexpr std::array<std::string_view, 1> faceImageVertexFiles = {"face_image.vert"};
constexpr std::array<std::string_view, 2> faceImageFragmentFiles = {"water.glsl", "face_image.frag"};
constexpr std::array<std::string_view, 1> clipmapVertexFiles = {"colour_clipmap.vert"};
constexpr std::array<std::string_view, 1> clipmapFragmentFiles = {"colour_clipmap.frag"};

void connect(const Program& program) {
    constexpr auto blocks = std::to_array<std::pair<const char*, GLuint>>({{"Frame", frameBinding},
                                                                           {"Layers", layersBinding},
                                                                           {"Clipmap", clipmapBinding},
                                                                           {"Sea", seaBinding},
                                                                           {"Shadows", shadowsBinding}});
    for (const auto& [name, binding] : blocks) {
        const GLuint block = glGetUniformBlockIndex(program.name(), name);
        if (block != GL_INVALID_INDEX) glUniformBlockBinding(program.name(), block, binding);
    }
    constexpr auto samplers =
        std::to_array<std::pair<const char*, GLint>>({{"heightPool", heightUnit},
                                                      {"colourImage", imageUnit},
                                                      {"detailNoise", noiseUnit},
                                                      {"colourTiles", tilesUnit},
                                                      {"colourPages", pagesUnit},
                                                      {"colourRoots", rootsUnit},
                                                      {"clipmapStack", clipmapStackUnit},
                                                      {"clipmapBase", clipmapBaseUnit},
                                                      {"shadowMaps", shadowsUnit},
                                                      {"layerAlbedo", layerAlbedoUnit},
                                                      {"layerSurface", layerSurfaceUnit},
                                                      {"normalTiles", normalTilesUnit},
                                                      {"normalPages", normalPagesUnit},
                                                      {"normalRoots", normalRootsUnit}});
    glUseProgram(program.name());
    for (const auto& [name, unit] : samplers) glUniform1i(glGetUniformLocation(program.name(), name), unit);
    glUseProgram(0);
    AirTextures::connect(program.name());
}

Result<Program> buildProgram(const std::filesystem::path& folder, ShaderFiles vertexFiles,
                             ShaderFiles fragmentFiles, int variant = 0) {
    const Result<ShaderText> vertex = readShader(folder, vertexFiles);
    if (!vertex) return tl::unexpected(vertex.error());
    const Result<ShaderText> fragment = readShader(folder, fragmentFiles);
    if (!fragment) return tl::unexpected(fragment.error());
    Result<Program> program = linkProgram(*vertex, *fragment, variant);
    if (program) connect(*program);
    return program;
}

}  // namespace

Result<ChunkPrograms> ChunkPrograms::build(const std::filesystem::path& folder,
                                           std::span<const int> variants) {
    Result<ShaderText> vertex = readShader(folder, chunkVertexFiles);
    if (!vertex) return tl::unexpected(vertex.error());
    Result<ShaderText> fragment = readShader(folder, chunkFragmentFiles);
    if (!fragment) return tl::unexpected(fragment.error());
    Result<ShaderText> depthFragment = readShader(folder, depthFragmentFiles);
    if (!depthFragment) return tl::unexpected(depthFragment.error());
    ChunkPrograms programs;
    for (const int variant : variants) {
        Result<Program> chunk = linkProgram(*vertex, *fragment, variant);
        if (!chunk) return tl::unexpected(chunk.error());
        connect(*chunk);
        programs.chunk_[variant] = std::move(*chunk);
    }
    Result<Program> sky = buildProgram(folder, skyVertexFiles, skyFragmentFiles);
    if (!sky) return tl::unexpected(sky.error());
    Result<Program> physicalSky = buildProgram(folder, skyVertexFiles, skyFragmentFiles, switchPhysicalAir);
    if (!physicalSky) return tl::unexpected(physicalSky.error());
    Result<Program> faceImage = buildProgram(folder, faceImageVertexFiles, faceImageFragmentFiles);
    if (!faceImage) return tl::unexpected(faceImage.error());
    Result<Program> clipmapFill = buildProgram(folder, clipmapVertexFiles, clipmapFragmentFiles);
    if (!clipmapFill) return tl::unexpected(clipmapFill.error());
    programs.chunkVertex_ = std::move(*vertex);
    programs.chunkFragment_ = std::move(*fragment);
    programs.depthFragment_ = std::move(*depthFragment);
    programs.sky_ = std::move(*sky);
    programs.physicalSky_ = std::move(*physicalSky);
    programs.faceImage_ = std::move(*faceImage);
    programs.clipmapFill_ = std::move(*clipmapFill);
    return programs;
}

const Program& ChunkPrograms::chunk(int variant) {
    const auto found = chunk_.find(variant);
    if (found != chunk_.end()) return found->second;
    Result<Program> program = linkProgram(chunkVertex_, chunkFragment_, variant);
    if (!program) return chunk_.begin()->second;
    connect(*program);
    return chunk_.emplace(variant, std::move(*program)).first->second;
}

const Program& ChunkPrograms::depth(int variant) {
    const int shape = variant & (switchSlide | switchMorph | switchGather | switchSeaSurface);
    const auto found = depth_.find(shape);
    if (found != depth_.end()) return found->second;
    Program& made = depth_[shape];
    if (Result<Program> program = linkProgram(chunkVertex_, depthFragment_, shape)) {
        connect(*program);
        made = std::move(*program);
    }
    return made;
}

std::vector<int> ChunkPrograms::variants() const {
    std::vector<int> variants;
    for (const auto& [variant, program] : chunk_) variants.push_back(variant);
    return variants;
}

Result<Program> ChunkPrograms::capturing(int variant, std::span<const char* const> outputs) const {
    Result<Program> program = linkProgram(chunkVertex_, chunkFragment_, variant, outputs);
    if (program) connect(*program);
    return program;
}

}  // namespace planet::gl
