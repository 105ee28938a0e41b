// Where shaders come from, and how they become programs. Wants a current context; one thread.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"

namespace planet::gl {

// The text of a file of shaders/ as it was built in; empty where there is none of that name.
std::string_view embeddedShader(std::string_view name);

// A shader is put together from files in the order given; the version line is added in front.
using ShaderFiles = std::span<const std::string_view>;

struct ShaderText {
    std::string name;     // of the last file, with its folder
    std::string numbers;  // "0 is frame.glsl, 1 is chunk.frag": compilers name a source by its number
    std::string text;
};

// Reads the built-in files, or those in the folder where one is named. The Error names the file.
Result<ShaderText> readShader(const std::filesystem::path& folder, ShaderFiles files);

// Links a program; both shaders see the number as the constant int variant. Outputs named in captured are
// recorded by transform feedback, interleaved. The Error names the files and has the compiler's own words.
Result<Program> linkProgram(const ShaderText& vertex, const ShaderText& fragment, int variant = 0,
                            std::span<const char* const> captured = {});

}  // namespace planet::gl
