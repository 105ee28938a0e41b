// GLSL and C++ agree: on members of uniform blocks, vertex inputs, samplers, switches and constants.
#include <gmock/gmock.h>

#include <cstddef>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include "planet/gl/device/shader_inputs.h"
#include "planet/gl/draw/chunk_instances.h"
#include "planet/gl/draw/chunk_programs.h"
#include "planet/gl/draw/frame_uniforms.h"
#include "planet/gl/draw/layer_uniforms.h"
#include "planet/gl/draw/sea_uniforms.h"
#include "planet/gl/draw/shader_prologue.h"
#include "planet/gl/draw/shadow_uniforms.h"
#include "planet/gl/store/air_textures.h"
#include "planet/gl/store/colour_clipmap.h"
#include "tests/planet/gl/gl_test.h"

namespace planet::gl {
namespace {

struct Member {
    std::string name;
    std::size_t offset = 0;
    std::vector<Member> inside{};
    std::size_t count = 0;   // 0: not an array
    std::size_t stride = 0;  // of an array
};

#define MEMBER(Type, member)            \
    Member {                            \
#member, offsetof(Type, member) \
    }
#define STRUCT(Type, member, inside)            \
    Member {                                    \
#member, offsetof(Type, member), inside \
    }
#define STRUCTS(Type, member, inside)                                                         \
    Member {                                                                                  \
#member, offsetof(Type, member), inside, std::tuple_size_v < decltype(Type::member)>, \
            sizeof(decltype(Type::member)::value_type)                                        \
    }

const std::vector<Member> faceMembers = {MEMBER(FaceUniforms, grid),    MEMBER(FaceUniforms, coordinates),
                                         MEMBER(FaceUniforms, roots),   MEMBER(FaceUniforms, direction),
                                         MEMBER(FaceUniforms, originM), MEMBER(FaceUniforms, cubeOriginM)};
const std::vector<Member> stopMembers = {MEMBER(RampUniforms, root), MEMBER(RampUniforms, startM),
                                         MEMBER(RampUniforms, perM)};
const std::vector<Member> samplingMembers = {
    MEMBER(TileSampling, leafLevel), MEMBER(TileSampling, anisotropy), MEMBER(TileSampling, extraLevels)};
const std::vector<Member> linesMembers = {MEMBER(LineUniforms, lowest), MEMBER(LineUniforms, rise),
                                          MEMBER(LineUniforms, highest), MEMBER(LineUniforms, fall)};
const std::vector<Member> layerMembers = {STRUCT(LayerUniforms, heightLines, linesMembers),
                                          STRUCT(LayerUniforms, slopeLines, linesMembers),
                                          STRUCT(LayerUniforms, latitudeLines, linesMembers),
                                          MEMBER(LayerUniforms, tint),
                                          MEMBER(LayerUniforms, opacity),
                                          MEMBER(LayerUniforms, mean),
                                          MEMBER(LayerUniforms, repeatM),
                                          MEMBER(LayerUniforms, noiseAmount),
                                          MEMBER(LayerUniforms, noiseField),
                                          MEMBER(LayerUniforms, noiseComponent),
                                          MEMBER(LayerUniforms, slice)};
const std::vector<Member> shadingMembers = {
    MEMBER(ShadingFrame, sun),          MEMBER(ShadingFrame, nearGround),
    MEMBER(ShadingFrame, eyeUp),        MEMBER(ShadingFrame, eyeScaleHeights),
    MEMBER(ShadingFrame, eyeM),         MEMBER(ShadingFrame, scaleHeightsPerM),
    MEMBER(ShadingFrame, eyeGrazing),   MEMBER(ShadingFrame, eyeAir),
    MEMBER(ShadingFrame, seaLevelM),    MEMBER(ShadingFrame, earthRadii),
    MEMBER(ShadingFrame, perRampTopM),  MEMBER(ShadingFrame, imageStep),
    MEMBER(ShadingFrame, coarseDetail), MEMBER(ShadingFrame, middleDetail),
    MEMBER(ShadingFrame, fineDetail),   MEMBER(ShadingFrame, heightStepPxM),
    MEMBER(ShadingFrame, imageStepPxM), STRUCT(ShadingFrame, colours, samplingMembers)};
const std::vector<Member> noiseMembers = {MEMBER(NoiseOctave, cell), MEMBER(NoiseOctave, cellsPerM),
                                          MEMBER(NoiseOctave, inside)};
const std::vector<Member> repeatMembers = {MEMBER(RepeatUniforms, eye), MEMBER(RepeatUniforms, perM)};
const std::vector<Member> waveMembers = {MEMBER(WaveUniforms, vector), MEMBER(WaveUniforms, phase),
                                         MEMBER(WaveUniforms, bendVector), MEMBER(WaveUniforms, bendPhase)};
const std::vector<Member> cascadeMembers = {MEMBER(CascadeUniforms, place), MEMBER(CascadeUniforms, texelM),
                                            MEMBER(CascadeUniforms, endM)};
const std::vector<Member> windowMembers = {MEMBER(ClipmapWindow, first), MEMBER(ClipmapWindow, layer)};

struct BlockMembers {
    std::size_t size = 0;
    std::vector<Member> members;
};

const std::map<UniformBlock, BlockMembers> blockMembers = {
    {UniformBlock::Frame,
     {sizeof(FrameUniforms),
      {STRUCTS(FrameUniforms, faces, faceMembers),
       MEMBER(FrameUniforms, clipFromWorld),
       STRUCT(FrameUniforms, shading, shadingMembers),
       MEMBER(FrameUniforms, rayForward),
       MEMBER(FrameUniforms, rayRight),
       MEMBER(FrameUniforms, rayUp),
       MEMBER(FrameUniforms, pixelRad),
       MEMBER(FrameUniforms, skyDepth),
       MEMBER(FrameUniforms, radiusM),
       MEMBER(FrameUniforms, referenceRadiusM),
       MEMBER(FrameUniforms, cubeHalfM),
       MEMBER(FrameUniforms, quantumM),
       MEMBER(FrameUniforms, referenceStep),
       MEMBER(FrameUniforms, baseHeightM),
       MEMBER(FrameUniforms, seaRiseM),
       MEMBER(FrameUniforms, chunkCellsLog2),
       MEMBER(FrameUniforms, reliefBoost),
       MEMBER(FrameUniforms, fill),
       MEMBER(FrameUniforms, imageOpacity),
       STRUCTS(FrameUniforms, ramp, stopMembers),
       MEMBER(FrameUniforms, rampStopCount),
       MEMBER(FrameUniforms, rampColoursSea),
       STRUCT(FrameUniforms, normals, samplingMembers),
       MEMBER(FrameUniforms, normalRiseM)}}},
    {UniformBlock::Layers,
     {sizeof(LayersUniforms),
      {MEMBER(LayersUniforms, count), MEMBER(LayersUniforms, noiseFieldCount),
       MEMBER(LayersUniforms, previewed), MEMBER(LayersUniforms, previewsMask),
       MEMBER(LayersUniforms, fadeBeginM), MEMBER(LayersUniforms, perFadeM), MEMBER(LayersUniforms, opacity),
       MEMBER(LayersUniforms, sharpness), MEMBER(LayersUniforms, trueHeight),
       MEMBER(LayersUniforms, trueSlope), MEMBER(LayersUniforms, colourBelow),
       MEMBER(LayersUniforms, repeatRad), STRUCTS(LayersUniforms, layers, layerMembers),
       STRUCTS(LayersUniforms, noise, noiseMembers), STRUCTS(LayersUniforms, repeats, repeatMembers)}}},
    {UniformBlock::Air,
     {sizeof(AirUniforms), {MEMBER(AirUniforms, rayleigh),      MEMBER(AirUniforms, perRayleighHeight),
                            MEMBER(AirUniforms, ozone),         MEMBER(AirUniforms, perOzoneHalf),
                            MEMBER(AirUniforms, ozoneMiddleKm), MEMBER(AirUniforms, hazeScattered),
                            MEMBER(AirUniforms, hazeTaken),     MEMBER(AirUniforms, perHazeHeight),
                            MEMBER(AirUniforms, forward),       MEMBER(AirUniforms, radiusKm),
                            MEMBER(AirUniforms, topKm),         MEMBER(AirUniforms, farthestKm),
                            MEMBER(AirUniforms, kmPerM),        MEMBER(AirUniforms, light),
                            MEMBER(AirUniforms, steps),         MEMBER(AirUniforms, eyeUp),
                            MEMBER(AirUniforms, eyeKm),         MEMBER(AirUniforms, skySize),
                            MEMBER(AirUniforms, glowSize),      MEMBER(AirUniforms, transmittanceSize)}}},
    {UniformBlock::Sea,
     {sizeof(SeaUniforms),
      {STRUCTS(SeaUniforms, waves, waveMembers), MEMBER(SeaUniforms, extinction),
       MEMBER(SeaUniforms, perExaggeration), MEMBER(SeaUniforms, slopeVariance),
       MEMBER(SeaUniforms, waveSlope)}}},
    {UniformBlock::Shadows,
     {sizeof(ShadowUniforms),
      {STRUCTS(ShadowUniforms, cascades, cascadeMembers), MEMBER(ShadowUniforms, softness),
       MEMBER(ShadowUniforms, texelSize)}}},
    {UniformBlock::Clipmap,
     {sizeof(ClipmapUniforms),
      {STRUCTS(ClipmapUniforms, windows, windowMembers), MEMBER(ClipmapUniforms, centre),
       MEMBER(ClipmapUniforms, sizePx), MEMBER(ClipmapUniforms, up), MEMBER(ClipmapUniforms, reach),
       MEMBER(ClipmapUniforms, perFade), MEMBER(ClipmapUniforms, finestLevel),
       MEMBER(ClipmapUniforms, wholeLevel)}}}};

#undef MEMBER
#undef STRUCT
#undef STRUCTS

using Offsets = std::map<std::string, std::size_t>;  // by GLSL's full name of a member

void addOffsets(const std::string& prefix, std::size_t base, const std::vector<Member>& members,
                Offsets& offsets) {
    for (const Member& member : members) {
        const std::string name = prefix + member.name;
        const std::size_t at = base + member.offset;
        if (member.inside.empty()) offsets[name] = at;
        if (member.count == 0) addOffsets(name + ".", at, member.inside, offsets);
        for (std::size_t i = 0; i < member.count; ++i)
            addOffsets(fmt::format("{}[{}].", name, i), at + i * member.stride, member.inside, offsets);
    }
}

Offsets offsetsInProgram(GLuint program, GLuint block) {
    GLint count = 0;
    glGetActiveUniformBlockiv(program, block, GL_UNIFORM_BLOCK_ACTIVE_UNIFORMS, &count);
    std::vector<GLint> found(static_cast<std::size_t>(count));
    glGetActiveUniformBlockiv(program, block, GL_UNIFORM_BLOCK_ACTIVE_UNIFORM_INDICES, found.data());
    Offsets offsets;
    for (const GLint uniform : found) {
        const auto index = static_cast<GLuint>(uniform);
        std::array<char, 128> name{};
        GLint offset = 0;
        glGetActiveUniformName(program, index, static_cast<GLsizei>(name.size()), nullptr, name.data());
        glGetActiveUniformsiv(program, 1, &index, GL_UNIFORM_OFFSET, &offset);
        offsets[name.data()] = static_cast<std::size_t>(offset);
    }
    return offsets;
}

class ShaderTables : public GlTest {
protected:
    ShaderTables() : programs_(valueOf(ChunkPrograms::build({}))) {}

    // Returns the program that reads everything but what excludes something else.
    GLuint chunkProgram() {
        constexpr Switches all = (Switches{1} << switchCount) - 1;
        return programs_.program({ProgramUse::Chunk, all & ~(switchLightByVertex | switchClipmap)}).name();
    }

    ChunkPrograms programs_;
};

TEST_F(ShaderTables, membersOfUniformBlocksLieWhereTheirStructsHaveThem) {
    ASSERT_EQ(blockMembers.size(), uniformBlockCount);
    for (const auto& [block, expected] : blockMembers) {
        const std::string name = uniformBlockNames[static_cast<std::size_t>(block)];
        const GLuint index = glGetUniformBlockIndex(chunkProgram(), name.c_str());
        ASSERT_NE(index, GL_INVALID_INDEX) << name;
        Offsets offsets;
        addOffsets(name + ".", 0, expected.members, offsets);
        EXPECT_EQ(offsetsInProgram(chunkProgram(), index), offsets) << name;
        GLint size = 0;
        glGetActiveUniformBlockiv(chunkProgram(), index, GL_UNIFORM_BLOCK_DATA_SIZE, &size);
        EXPECT_LE(static_cast<std::size_t>(size), expected.size) << name;
    }
}

TEST_F(ShaderTables, vertexInputsLieWhereTheListHasThem) {
    GLint count = 0;
    glGetProgramiv(chunkProgram(), GL_ACTIVE_ATTRIBUTES, &count);
    std::map<std::string, GLint> locations;
    for (GLint i = 0; i < count; ++i) {
        std::array<char, 128> name{};
        GLint size = 0;
        GLenum type = 0;
        glGetActiveAttrib(chunkProgram(), static_cast<GLuint>(i), static_cast<GLsizei>(name.size()), nullptr,
                          &size, &type, name.data());
        locations[name.data()] = glGetAttribLocation(chunkProgram(), name.data());
    }
    std::map<std::string, GLint> listed;
    for (const VertexInput& input : chunkInputs()) listed[input.name] = static_cast<GLint>(listed.size());
    EXPECT_EQ(locations, listed);
}

// Returns the text of all shaders, without comments.
std::string textOfShaders() {
    std::string text;
    for (const auto& file : std::filesystem::directory_iterator(WORLDY_SOURCE_DIR "/shaders")) {
        std::ifstream stream(file.path());
        for (std::string line; std::getline(stream, line);) text += line.substr(0, line.find("//")) + "\n";
    }
    return text;
}

std::set<std::string> namesIn(const std::string& text, const char* pattern) {
    const std::regex regex(pattern);
    std::set<std::string> names;
    for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i) names.insert((*i)[1]);
    return names;
}

template <class Names>
std::set<std::string> setOf(const Names& names) {
    return {names.begin(), names.end()};
}

TEST(ShaderText, usesTheSwitchesOfTheTableAndNoOthers) {
    const std::string text = textOfShaders();
    EXPECT_EQ(namesIn(text, R"(\b(switch[A-Z]\w*))"), setOf(switchNames));
    EXPECT_EQ(namesIn(text, R"(#\s*(if|ifdef|ifndef|define)\b)"), std::set<std::string>())
        << "a hidden switch";
}

TEST(ShaderText, usesTheBlocksAndSamplersOfTheTablesAndNoOthers) {
    const std::string text = textOfShaders();
    EXPECT_EQ(namesIn(text, R"(uniform (\w+) \{)"), setOf(uniformBlockNames));
    EXPECT_EQ(namesIn(text, R"(uniform \w*sampler\w+ (\w+);)"), setOf(samplerNames));
}

TEST(ShaderText, usesAllConstantsOfThePrologueAndDeclaresNoneAgain) {
    const std::set<std::string> words = namesIn(textOfShaders(), R"(\b(\w+)\b)");
    const std::set<std::string> own = namesIn(textOfShaders(), R"(const \w+ (\w+) =)");
    const std::set<std::string> shared = namesIn(shaderPrologue(0), R"(const \w+ (\w+) =)");
    EXPECT_THAT(shared, testing::SizeIs(testing::Gt(switchCount)));
    for (const std::string& name : shared) {
        EXPECT_TRUE(words.contains(name)) << name;
        EXPECT_FALSE(own.contains(name)) << name;
    }
}

TEST(ShaderPrologue, turnsOnTheSwitchesThatAreAskedFor) {
    const std::string text = shaderPrologue(switchAir | switchLoudSkirts);
    EXPECT_EQ(namesIn(text, R"(const bool (\w+) = true;)"),
              (std::set<std::string>{"switchAir", "switchLoudSkirts"}));
}

}  // namespace
}  // namespace planet::gl
