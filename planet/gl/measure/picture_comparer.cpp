#include "planet/gl/measure/picture_comparer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string_view>
#include <vector>

#include "planet/gl/device/shader_inputs.h"
#include "planet/gl/device/shader_source.h"

namespace planet::gl {

namespace {

constexpr std::array<std::string_view, 1> compareVertexFiles = {"compare.vert"};
constexpr std::array<std::string_view, 1> mixFiles = {"compare.frag"};
constexpr std::array<std::string_view, 1> countFiles = {"compare_count.frag"};
constexpr int blockSize = 16;

Result<Program> programOf(std::span<const std::string_view> fragmentFiles) {
    const Result<ShaderText> vertex = readShader({}, compareVertexFiles);
    if (!vertex) return tl::unexpected(vertex.error());
    const Result<ShaderText> fragment = readShader({}, fragmentFiles);
    if (!fragment) return tl::unexpected(fragment.error());
    return linkProgram(*vertex, *fragment);
}

GLint place(const Program& program, const char* name) {
    return glGetUniformLocation(program.name(), name);
}

int blocksIn(int pixels) {
    return (pixels + blockSize - 1) / blockSize;
}

}  // namespace

PictureMix wipeMix(int widthPx, double share) {
    const auto border = static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * widthPx));
    return {.border = border};
}

PictureMix sideBySideMix(int widthPx) {
    const int half = widthPx / 2;
    const int left = (widthPx - half) / 2;
    return {.border = half, .shiftA = left, .shiftB = left - half};
}

PictureMix onlyMix(int widthPx, bool showsB) {
    return {.border = showsB ? 0 : widthPx};
}

PictureMix differenceMix(double gain) {
    return {.difference = true, .gain = static_cast<float>(gain)};
}

double pictureColumn(const PictureMix& mix, double columnPx) {
    if (mix.difference) return columnPx;
    return columnPx + (columnPx < mix.border ? mix.shiftA : mix.shiftB);
}

Result<PictureComparer> PictureComparer::create() {
    Result<Program> mix = programOf(mixFiles);
    if (!mix) return tl::unexpected(mix.error());
    Result<Program> count = programOf(countFiles);
    if (!count) return tl::unexpected(count.error());
    PictureComparer comparer;
    comparer.mix_ = std::move(*mix);
    comparer.count_ = std::move(*count);
    comparer.noVertices_ = makeVertexArray();
    comparer.counted_ = makeFramebuffer();
    return comparer;
}

void PictureComparer::drawTriangle(GLuint textureA, GLuint textureB) const {
    bindTexture(Sampler::pictureA, GL_TEXTURE_2D, textureA);
    bindTexture(Sampler::pictureB, GL_TEXTURE_2D, textureB);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glBindVertexArray(noVertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glUseProgram(0);
    bindTexture(Sampler::pictureA, GL_TEXTURE_2D, 0);
    bindTexture(Sampler::pictureB, GL_TEXTURE_2D, 0);
}

void PictureComparer::draw(GLuint textureA, GLuint textureB, int widthPx, int heightPx,
                           const PictureMix& mix) const {
    glViewport(0, 0, widthPx, heightPx);
    glUseProgram(mix_.name());
    glUniform1i(place(mix_, "border"), mix.border);
    glUniform1i(place(mix_, "shiftA"), mix.shiftA);
    glUniform1i(place(mix_, "shiftB"), mix.shiftB);
    glUniform1i(place(mix_, "difference"), mix.difference ? 1 : 0);
    glUniform1f(place(mix_, "gain"), mix.gain);
    drawTriangle(textureA, textureB);
}

void PictureComparer::fitCounts(int widthPx, int heightPx) {
    const int width = blocksIn(widthPx);
    const int height = blocksIn(heightPx);
    glBindFramebuffer(GL_FRAMEBUFFER, counted_.name());
    if (width == countsWidth_ && height == countsHeight_) return;
    counts_ = makeTexture();
    glBindTexture(GL_TEXTURE_2D, counts_.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RG32UI, width, height, 0, GL_RG_INTEGER, GL_UNSIGNED_INT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, counts_.name(), 0);
    countsWidth_ = width;
    countsHeight_ = height;
}

PictureDifference PictureComparer::count(GLuint textureA, GLuint textureB, int widthPx, int heightPx) {
    assert(widthPx > 0 && heightPx > 0);
    fitCounts(widthPx, heightPx);
    glViewport(0, 0, countsWidth_, countsHeight_);
    glUseProgram(count_.name());
    glUniform1i(place(count_, "blockSize"), blockSize);
    drawTriangle(textureA, textureB);
    std::vector<GLuint> counts(2 * static_cast<std::size_t>(countsWidth_) *
                               static_cast<std::size_t>(countsHeight_));
    glReadPixels(0, 0, countsWidth_, countsHeight_, GL_RG_INTEGER, GL_UNSIGNED_INT, counts.data());
    PictureDifference difference;
    for (std::size_t i = 0; i < counts.size(); i += 2) {
        difference.pixels += counts[i];
        difference.largestSteps = std::max(difference.largestSteps, static_cast<int>(counts[i + 1]));
    }
    return difference;
}

}  // namespace planet::gl
