#include "app/scene/offscreen.h"

#include <epoxy/gl.h>

#include <glm/trigonometric.hpp>
#include <memory>
#include <utility>

#include "app/data/data_set.h"
#include "app/scene/overlay_colours.h"
#include "app/scene/source_lines.h"
#include "app/settings/camera_text.h"
#include "planet/measure/true_error.h"
#include "planet/planet_tools.h"

namespace worldy {

namespace {

planet::Result<void> drawLines(Offscreen& offscreen, const planet::View& view, const planet::Lines& lines) {
    if (!offscreen.lines) {
        planet::Result<planet::gl::DebugLines> made = planet::gl::DebugLines::create();
        if (!made) return tl::unexpected(made.error());
        offscreen.lines.emplace(std::move(*made));
    }
    offscreen.lines->draw(view, offscreen.scene.renderer.chunks().projection(), lines, 1.5f,
                          planet::gl::LineDepth::Hidden);
    return {};
}

bool settle(Scene& scene, const planet::View& view, const ViewSettings& settings,
            const std::function<bool()>& goOn) {
    const auto settleFor = [&](double timeoutS) { return settleScene(scene, view, settings, timeoutS); };
    return goOn ? settleWhile(settleFor, goOn) : settleFor(settleTimeoutS);
}

// Returns nothing if chunks are not coloured by their measured error.
planet::Result<std::optional<ErrorMeasurement>> measuredFor(const planet::Planet& planet,
                                                            const ViewSettings& settings) {
    if (settings.overlay.colourBy != ColourBy::Measured) return std::nullopt;
    planet::FinestHeights heights(std::make_shared<const planet::ChunkFile>(planet.file()));
    auto report = planet::measureTrueError(drawnSnapshotOf(planet), heights);
    if (!report) return tl::unexpected(report.error());
    ErrorMeasurement measured = measurementOf(std::move(*report));
    measured.tauPx = planet.views()[0].input.lod.tauPx;
    return measured;
}

// Reads the index once if chunks are coloured by the leaves under them.
planet::Result<void> readDepths(Offscreen& offscreen, const ViewSettings& settings) {
    const ColourBy by = settings.overlay.colourBy;
    if (offscreen.depths || (by != ColourBy::LeafDepth && by != ColourBy::Spacing)) return {};
    auto depths = leafDepthsOf(offscreen.scene.planet->file());
    if (!depths) return tl::unexpected(depths.error());
    offscreen.depths = *std::move(depths);
    return {};
}

planet::Result<void> readTops(Offscreen& offscreen, const ViewSettings& settings) {
    if (settings.overlay.colourBy != ColourBy::Source || !offscreen.layers) return {};
    return addTops(*offscreen.layers, offscreen.scene.planet->selection().draw, offscreen.tops);
}

}  // namespace

planet::Result<Offscreen> openOffscreen(const SceneConfig& config, const ViewSettings& settings,
                                        const PictureSize& size, int samples) {
    auto context = planet::gl::OffscreenContext::create();
    if (!context) return tl::unexpected(context.error());
    auto scene = openScene(config, settings);
    if (!scene) return tl::unexpected(scene.error());
    if (drawsColourImage(*scene, settings.surface)) {
        if (const planet::Result<void> read = readColourImage(*scene); !read)
            return tl::unexpected(read.error());
    }
    const int most = std::max(scene->renderer.chunks().capabilities().samples, 1);
    auto target = planet::gl::RenderTarget::create(size.widthPx, size.heightPx, std::min(samples, most));
    if (!target) return tl::unexpected(target.error());
    return Offscreen{std::move(*context), std::move(*target), std::move(*scene)};
}

planet::Result<std::filesystem::path> colourImageToDraw(const std::filesystem::path& file,
                                                        const std::filesystem::path& named) {
    if (!named.empty()) return named;
    return findDataSet(file, {}).map([](const DataSet& set) { return set.colourImage; });
}

planet::Result<void> drawAndFinish(Offscreen& offscreen, const planet::View& view,
                                   const ViewSettings& settings) {
    Scene& scene = offscreen.scene;
    const planet::Selection& selection = scene.planet->selection();
    const auto measured = measuredFor(*scene.planet, settings);
    if (!measured) return tl::unexpected(measured.error());
    if (planet::Result<void> read = readDepths(offscreen, settings); !read) return read;
    if (planet::Result<void> read = readTops(offscreen, settings); !read) return read;
    const TintData data{.measured = *measured ? &**measured : nullptr,
                        .depths = offscreen.depths ? &*offscreen.depths : nullptr,
                        .tops = offscreen.layers ? &offscreen.tops : nullptr};
    offscreen.target.bind();
    drawScene(scene, view, settings, 0,
              chunkTints(*scene.planet, selection, settings.overlay, settings.lod.tauPx, data));
    planet::Lines lines = linesOver(scene, selection, view, settings);
    if (settings.overlay.sources && offscreen.layers) {
        const planet::Lines outlines = sourceLines(*offscreen.layers, scene.planet->tree(), view);
        lines.insert(lines.end(), outlines.begin(), outlines.end());
    }
    // The lines are made for the sphere, not for the cube.
    if (!lines.empty() && !settings.overlay.cube) {
        if (planet::Result<void> drawn = drawLines(offscreen, view, lines); !drawn) return drawn;
    }
    offscreen.target.resolve();
    glFinish();
    return {};
}

Picture readPicture(const Offscreen& offscreen) {
    return {offscreen.target.widthPx(), offscreen.target.heightPx(), offscreen.target.readRgb()};
}

SettledView settleAt(Offscreen& offscreen, const planet::CameraPose& pose, const ViewSettings& settings,
                     const std::function<bool()>& goOn) {
    Scene& scene = offscreen.scene;
    const double radiusM = scene.planet->tree().shape.radiusM;
    Camera camera = cameraFromPose(pose, radiusM);
    SettledView result;
    const auto settleCamera = [&] {
        result.view = viewOf(camera, glm::radians(settings.camera.fovDeg), offscreen.target.widthPx(),
                             offscreen.target.heightPx());
        result.pose = planet::poseFromView(result.view, radiusM);
        scene.planet->tools().forgetSelections();
        result.settled = settle(scene, result.view, settings, goOn);
    };
    settleCamera();
    // Only now the ground below is resident at the level of the view; after a lift it may be refined further.
    for (int attempt = 0; attempt < 4 && (result.settled || !goOn); ++attempt) {
        const Ground ground = groundBelow(scene, camera.eyeM);
        if (altitudeM(camera, ground) >= ground.heightM + minGroundClearanceM - 1e-3) break;
        camera = keepInRange(camera, ground);
        result.lifted = true;
        settleCamera();
    }
    return result;
}

}  // namespace worldy
