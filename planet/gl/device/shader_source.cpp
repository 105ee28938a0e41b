#include "planet/gl/device/shader_source.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "planet/gl/device/shader_inputs.h"

namespace planet::gl {

namespace {

Result<std::string> readFile(const std::filesystem::path& folder, std::string_view name) {
    if (folder.empty()) return std::string(embeddedShader(name));
    const std::filesystem::path path = folder / name;
    std::ifstream file(path, std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (!file.is_open() || file.bad())
        return ioError(fmt::format("{}: the shader cannot be read", path.string()));
    return text;
}

std::string sourceNumbers(ShaderFiles files) {
    std::string text;
    int number = 0;
    for (const std::string_view file : files) {
        text += fmt::format("{}{} is {}", number == 0 ? "" : ", ", number, file);
        ++number;
    }
    return text;
}

// Returns the log of a shader or a program.
template <class Get, class GetLog>
std::string logOf(GLuint name, Get get, GetLog getLog) {
    GLint length = 0;  // including the terminating zero
    get(name, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length > 0 ? length : 1), '\0');
    GLsizei written = 0;
    getLog(name, static_cast<GLsizei>(log.size()), &written, log.data());
    log.resize(static_cast<std::size_t>(written));
    return log;
}

Result<Shader> compile(GLenum stage, const ShaderText& source, std::string_view prologue) {
    const std::string text = fmt::format("#version 330 core\n{}{}", prologue, source.text);
    Shader shader(glCreateShader(stage));
    const char* const start = text.c_str();
    glShaderSource(shader.name(), 1, &start, nullptr);
    glCompileShader(shader.name());
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return shader;
    return badInput(fmt::format("{}: the shader does not compile ({}):\n{}", source.name, source.numbers,
                                logOf(shader.name(), glGetShaderiv, glGetShaderInfoLog)));
}

}  // namespace

Result<ShaderText> readShader(const std::filesystem::path& folder, ShaderFiles files) {
    ShaderText shader{(folder / files.back()).string(), sourceNumbers(files), {}};
    int number = 0;
    for (const std::string_view file : files) {
        const Result<std::string> source = readFile(folder, file);
        if (!source) return tl::unexpected(source.error());
        shader.text += fmt::format("#line 1 {}\n{}\n", number++, *source);
    }
    return shader;
}

Result<Program> linkProgram(const ShaderText& vertexText, const ShaderText& fragmentText,
                            const LinkOptions& options) {
    const Result<Shader> vertex = compile(GL_VERTEX_SHADER, vertexText, options.prologue);
    if (!vertex) return tl::unexpected(vertex.error());
    const Result<Shader> fragment = compile(GL_FRAGMENT_SHADER, fragmentText, options.prologue);
    if (!fragment) return tl::unexpected(fragment.error());

    Program program(glCreateProgram());
    glAttachShader(program.name(), vertex->name());
    glAttachShader(program.name(), fragment->name());
    GLuint location = 0;
    for (const VertexInput& input : options.inputs)
        glBindAttribLocation(program.name(), location++, input.name);
    if (!options.captured.empty()) {
        glTransformFeedbackVaryings(program.name(), static_cast<GLsizei>(options.captured.size()),
                                    options.captured.data(), GL_INTERLEAVED_ATTRIBS);
    }
    glLinkProgram(program.name());
    glDetachShader(program.name(), vertex->name());
    glDetachShader(program.name(), fragment->name());
    GLint linked = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) {
        connectInputs(program);
        return program;
    }
    return badInput(fmt::format("{} and {}: the shaders do not link:\n{}", vertexText.name, fragmentText.name,
                                logOf(program.name(), glGetProgramiv, glGetProgramInfoLog)));
}

}  // namespace planet::gl
