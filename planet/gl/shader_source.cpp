#include "planet/gl/shader_source.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <vector>

namespace planet::gl {

namespace {

Result<std::string> readShader(const std::filesystem::path& folder, std::string_view name) {
    if (folder.empty()) return std::string(embeddedShader(name));
    const std::filesystem::path path = folder / name;
    std::ifstream file(path, std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (!file.is_open() || file.bad())
        return ioError(fmt::format("{}: the shader cannot be read", path.string()));
    return text;
}

// "0 is frame.glsl, 1 is chunk.frag": compilers name a source by its number.
std::string sourceNumbers(ShaderFiles files) {
    std::string text;
    int number = 0;
    for (const std::string_view file : files)
        text += fmt::format("{}{} is {}", number == 0 ? "" : ", ", number, file), ++number;
    return text;
}

std::string lastFile(ShaderFiles files) {
    return std::string(files.back());
}

std::string compileLog(GLuint shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length > 0 ? length : 1), '\0');
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    return log.c_str();
}

std::string linkLog(GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length > 0 ? length : 1), '\0');
    glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
    return log.c_str();
}

Result<Shader> compile(GLenum stage, const std::filesystem::path& folder, ShaderFiles files) {
    std::string text = "#version 330 core\n";
    int number = 0;
    for (const std::string_view file : files) {
        const Result<std::string> source = readShader(folder, file);
        if (!source) return tl::unexpected(source.error());
        text += fmt::format("#line 1 {}\n{}\n", number++, *source);
    }
    Shader shader(glCreateShader(stage));
    const char* const start = text.c_str();
    glShaderSource(shader.name(), 1, &start, nullptr);
    glCompileShader(shader.name());
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return shader;
    return badInput(fmt::format("{}: the shader does not compile ({}):\n{}",
                                (folder / lastFile(files)).string(), sourceNumbers(files),
                                compileLog(shader.name())));
}

}  // namespace

Result<Program> linkProgram(const std::filesystem::path& folder, ShaderFiles vertexFiles,
                            ShaderFiles fragmentFiles, std::span<const char* const> captured) {
    const Result<Shader> vertex = compile(GL_VERTEX_SHADER, folder, vertexFiles);
    if (!vertex) return tl::unexpected(vertex.error());
    const Result<Shader> fragment = compile(GL_FRAGMENT_SHADER, folder, fragmentFiles);
    if (!fragment) return tl::unexpected(fragment.error());

    Program program(glCreateProgram());
    glAttachShader(program.name(), vertex->name());
    glAttachShader(program.name(), fragment->name());
    if (!captured.empty()) {
        glTransformFeedbackVaryings(program.name(), static_cast<GLsizei>(captured.size()), captured.data(),
                                    GL_INTERLEAVED_ATTRIBS);
    }
    glLinkProgram(program.name());
    glDetachShader(program.name(), vertex->name());
    glDetachShader(program.name(), fragment->name());
    GLint linked = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) return program;
    return badInput(fmt::format("{} and {}: the shaders do not link:\n{}", lastFile(vertexFiles),
                                lastFile(fragmentFiles), linkLog(program.name())));
}

}  // namespace planet::gl
