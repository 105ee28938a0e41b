// Reads shaders and links them into programs. Requires a current context; one thread.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"
#include "planet/gl/device/vertex_inputs.h"

namespace planet::gl {

// Returns the built-in text of a file of shaders/; empty if there is no such file.
std::string_view embeddedShader(std::string_view name);

// The files of a shader, in order; linkProgram adds the version line.
using ShaderFiles = std::span<const std::string_view>;

struct ShaderText {
    std::string name;     // of the last file, with its folder
    std::string numbers;  // "0 is frame.glsl, 1 is chunk.frag": compilers name a source by its number
    std::string text;
};

// Reads the files from a folder, or the built-in ones if it is empty. The Error names the file.
Result<ShaderText> readShader(const std::filesystem::path& folder, ShaderFiles files);

struct LinkOptions {
    std::string_view prologue{};              // stands before the text of both shaders
    std::span<const VertexInput> inputs{};    // of the vertex shader, in the order of their locations
    std::span<const char* const> captured{};  // outputs that transform feedback records, interleaved
};

// Links a program and connects its blocks and samplers (shader_inputs.h). The Error names the files and
// quotes the compiler.
Result<Program> linkProgram(const ShaderText& vertex, const ShaderText& fragment,
                            const LinkOptions& options = {});

}  // namespace planet::gl
