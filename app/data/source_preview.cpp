#include "app/data/source_preview.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <utility>

#include "app/base/stopwatch.h"

namespace worldy {

namespace {

using planet::Result;

constexpr int rowsAtOnce = 16;
constexpr int samplesASide = previewSidePx + 1;
constexpr double shownSlope = 0.55;  // target RMS of the exaggerated slopes

struct Stop {
    float share;  // height as a share of the highest, or of the lowest
    glm::vec3 colour;
};
constexpr std::array<Stop, 5> land = {{{0.0f, {0.36f, 0.47f, 0.30f}},
                                       {0.2f, {0.55f, 0.56f, 0.36f}},
                                       {0.45f, {0.58f, 0.49f, 0.36f}},
                                       {0.75f, {0.62f, 0.58f, 0.55f}},
                                       {1.0f, {0.95f, 0.95f, 0.96f}}}};
constexpr std::array<Stop, 2> sea = {{{0.0f, {0.33f, 0.52f, 0.66f}}, {1.0f, {0.07f, 0.16f, 0.34f}}}};

template <std::size_t count>
glm::vec3 colourAt(const std::array<Stop, count>& stops, float share) {
    for (std::size_t i = 1; i < count; ++i) {
        if (share > stops[i].share && i + 1 < count) continue;
        const float t = (share - stops[i - 1].share) / (stops[i].share - stops[i - 1].share);
        return glm::mix(stops[i - 1].colour, stops[i].colour, std::clamp(t, 0.0f, 1.0f));
    }
    return stops[0].colour;
}

// The heights of the tile; row 0 is the south of the face.
struct Relief {
    std::vector<float> heightsM;
    double stepM = 1;  // between samples
    float lowM = 0;
    float highM = 0;

    float at(int column, int row) const {
        return heightsM[static_cast<std::size_t>(row) * samplesASide + static_cast<std::size_t>(column)];
    }
    // Returns the slope of a cell, eastwards and northwards, without exaggeration.
    glm::dvec2 slopeAt(int column, int row) const {
        const double southWest = double(at(column, row)), southEast = double(at(column + 1, row));
        const double northWest = double(at(column, row + 1)), northEast = double(at(column + 1, row + 1));
        return glm::dvec2(southEast + northEast - southWest - northWest,
                          northWest + northEast - southWest - southEast) /
               (2 * stepM);
    }
    glm::vec3 tintAt(int column, int row) const {
        const float height = at(column, row);
        if (height < 0) return colourAt(sea, height / std::min(lowM, -1.0f));
        const float floorM = std::max(lowM, 0.0f);
        return colourAt(land, (height - floorM) / std::max(highM - floorM, 1.0f));
    }
};

Result<Relief> readRelief(const planet::HeightSource& source, const PreviewRequest& request,
                          const std::function<bool()>& goOn) {
    const planet::SampleTile whole = tileOfPreview(request);
    Relief relief;
    relief.heightsM.resize(std::size_t{samplesASide} * samplesASide);
    relief.stepM = request.radiusM * std::numbers::pi / 2 / whole.faceCells;
    for (int row = 0; row < samplesASide; row += rowsAtOnce) {
        if (goOn && !goOn()) return planet::cancelled();
        planet::SampleTile strip = whole;
        strip.firstRow += row;
        strip.rows = std::min(rowsAtOnce, samplesASide - row);
        const auto out = std::span(relief.heightsM)
                             .subspan(static_cast<std::size_t>(row) * samplesASide,
                                      static_cast<std::size_t>(strip.rows) * samplesASide);
        if (const Result<void> sampled = source.sample(strip, out); !sampled)
            return tl::unexpected(sampled.error());
    }
    const auto [low, high] = std::minmax_element(relief.heightsM.begin(), relief.heightsM.end());
    relief.lowM = *low;
    relief.highM = *high;
    return relief;
}

double exaggerationOf(const Relief& relief) {
    double squares = 0;
    for (int row = 0; row < previewSidePx; ++row) {
        for (int column = 0; column < previewSidePx; ++column) {
            const glm::dvec2 slope = relief.slopeAt(column, row);
            squares += glm::dot(slope, slope);
        }
    }
    const double rms = std::sqrt(squares / (previewSidePx * previewSidePx));
    return rms > 0 ? std::max(1.0, shownSlope / rms) : 1;
}

std::vector<std::uint8_t> shaded(const Relief& relief) {
    const double exaggeration = exaggerationOf(relief);
    const glm::vec3 light = glm::normalize(glm::vec3(-0.6f, 0.6f, 0.9f));
    std::vector<std::uint8_t> rgba;
    rgba.reserve(std::size_t{4} * previewSidePx * previewSidePx);
    for (int row = previewSidePx - 1; row >= 0; --row) {
        for (int column = 0; column < previewSidePx; ++column) {
            const glm::dvec2 slope = exaggeration * relief.slopeAt(column, row);
            const glm::vec3 normal = glm::normalize(glm::vec3(-slope.x, -slope.y, 1));
            const float lit = 0.3f + 0.95f * std::max(0.0f, glm::dot(normal, light));
            const glm::vec3 colour = glm::clamp(relief.tintAt(column, row) * lit, 0.0f, 1.0f);
            for (int channel = 0; channel < 3; ++channel)
                rgba.push_back(static_cast<std::uint8_t>(std::lround(colour[channel] * 255)));
            rgba.push_back(255);
        }
    }
    return rgba;
}

}  // namespace

planet::SampleTile tileOfPreview(const PreviewRequest& request) {
    const int zoom = std::clamp(request.zoomLog2, 0, 14);
    const int cells = previewSidePx << zoom;
    const auto first = [&](double middle) {
        const long at = std::lround((middle + 1) / 2 * cells) - previewSidePx / 2;
        return static_cast<int>(std::clamp(at, 0l, static_cast<long>(cells - previewSidePx)));
    };
    return {request.face, cells, first(request.u), first(request.v), samplesASide, samplesASide};
}

Result<PreviewPicture> drawPreview(const planet::HeightSource& source, const PreviewRequest& request,
                                   const std::function<bool()>& goOn) {
    const Stopwatch watch;
    const Result<Relief> relief = readRelief(source, request, goOn);
    if (!relief) return tl::unexpected(relief.error());
    PreviewPicture picture{request, shaded(*relief), double(relief->lowM), double(relief->highM), 0};
    picture.seconds = watch.elapsedMs() / 1000;
    return picture;
}

PreviewJob::PreviewJob(PreviewRequest request)
    : Job([request = std::move(request)](const std::stop_token& stop) {
          planet::HeightSourceSettings settings = request.sourceSettings;
          settings.stop = stop;
          return planet::openHeightSource(request.source, settings)
              .and_then([&](const planet::HeightSource& source) {
                  return drawPreview(source, request, [&] { return !stop.stop_requested(); });
              });
      }) {}

void requestPreview(SourcePreviewer& previewer, const PreviewRequest& request) {
    previewer.next = request;
    if (previewer.job) previewer.job->cancel();
}

void advancePreview(SourcePreviewer& previewer) {
    if (previewer.job) {
        std::optional<Result<PreviewPicture>> result = previewer.job->takeResult();
        if (!result) return;
        previewer.job.reset();
        const bool cancelled = !*result && result->error().kind == planet::ErrorKind::Cancelled;
        previewer.problem = *result || cancelled ? std::string() : result->error().message;
        if (*result) {
            previewer.shown = std::move(**result);
            previewer.texture = planet::gl::makeTexture();
            glBindTexture(GL_TEXTURE_2D, previewer.texture.name());
            glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
            glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, previewSidePx, previewSidePx, 0, GL_RGBA,
                         GL_UNSIGNED_BYTE, previewer.shown->rgba.data());
            glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
            glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
            glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
            glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
            glBindTexture(GL_TEXTURE_2D, 0);
            previewer.shown->rgba.clear();
        }
    }
    if (previewer.next)
        previewer.job = std::make_unique<PreviewJob>(*std::exchange(previewer.next, std::nullopt));
}

}  // namespace worldy
