#include "app/scene/offscreen.h"

#include <epoxy/gl.h>

#include <glm/trigonometric.hpp>
#include <memory>
#include <utility>

#include "app/data/data_set.h"
#include "app/scene/overlay_colours.h"
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
    // As wide as in the window.
    offscreen.lines->draw(view, offscreen.scene.renderer.chunks().projection(), lines, 1.5f,
                          planet::gl::LineDepth::Hidden);
    return {};
}

// In short stretches, between which it can be given up.
bool settleWhile(Scene& scene, const planet::View& view, const ViewSettings& settings,
                 const std::function<bool()>& goOn) {
    if (!goOn) return settleScene(scene, view, settings, settleTimeoutS);
    constexpr int stretches = 600;
    for (int i = 0; i < stretches; ++i) {
        if (settleScene(scene, view, settings, settleTimeoutS / stretches)) return true;
        if (!goOn()) return false;
    }
    return false;
}

// Nothing where chunks are not coloured by it.
planet::Result<std::optional<ErrorMeasurement>> measuredFor(const planet::Planet& planet,
                                                            const ViewSettings& settings) {
    if (settings.overlay.colourBy != ColourBy::Measured) return std::nullopt;
    const planet::LodSettings& lod = planet.views()[0].input.lod;
    planet::FinestHeights heights(std::make_shared<const planet::ChunkFile>(planet.file()));
    auto report = planet::measureTrueError(
        planet::snapshotOf(planet.tree(), planet.selection().draw, planet.views()[0].input.lodView,
                           lod.seams == planet::SeamMode::Stitched),
        heights);
    if (!report) return tl::unexpected(report.error());
    ErrorMeasurement measured = measurementOf(std::move(*report));
    measured.tauPx = lod.tauPx;
    return measured;
}

}  // namespace

planet::Result<Offscreen> openOffscreen(const SceneConfig& config, const ViewSettings& settings,
                                        const PictureSize& size, int samples) {
    auto context = planet::gl::OffscreenContext::create();
    if (!context) return tl::unexpected(context.error());
    auto scene = openScene(config, settings);
    if (!scene) return tl::unexpected(scene.error());
    const int most = std::max(scene->renderer.chunks().capabilities().samples, 1);
    auto target = planet::gl::RenderTarget::create(size.widthPx, size.heightPx, std::min(samples, most));
    if (!target) return tl::unexpected(target.error());
    return Offscreen{std::move(*context), std::move(*target), std::move(*scene)};
}

planet::Result<std::optional<Picture>> colourPictureOf(const std::filesystem::path& file,
                                                       const std::filesystem::path& colourImage) {
    std::filesystem::path picture = colourImage;
    if (picture.empty()) {
        const planet::Result<DataSet> set = findDataSet(file, {});
        if (!set) return tl::unexpected(set.error());
        picture = set->colourImage;
    }
    if (picture.empty()) return std::optional<Picture>();
    return readPlanetPicture(picture).map(
        [](Picture&& read) { return std::optional<Picture>(std::move(read)); });
}

planet::Result<void> drawAndFinish(Offscreen& offscreen, const planet::View& view,
                                   const ViewSettings& settings) {
    Scene& scene = offscreen.scene;
    const planet::Selection& selection = scene.planet->selection();
    const auto measured = measuredFor(*scene.planet, settings);
    if (!measured) return tl::unexpected(measured.error());
    offscreen.target.bind();
    drawScene(scene, view, settings, 0,
              chunkTints(*scene.planet, selection, settings.overlay, settings.lod.tauPx,
                         *measured ? &**measured : nullptr));
    const planet::Lines lines = linesOver(scene, selection, view, settings);
    // Lines are those of the sphere.
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
    const auto settle = [&] {
        result.view = viewOf(camera, glm::radians(settings.camera.fovDeg), offscreen.target.widthPx(),
                             offscreen.target.heightPx());
        result.pose = planet::poseFromView(result.view, radiusM);
        scene.planet->tools().forgetSelections();
        result.settled = settleWhile(scene, result.view, settings, goOn);
    };
    settle();
    // The ground below is known as finely as the view needs only now; lifted, it may become finer still.
    for (int attempt = 0; attempt < 4 && (result.settled || !goOn); ++attempt) {
        const Ground ground = groundBelow(scene, camera.eyeM);
        if (altitudeM(camera, ground) >= ground.heightM + minGroundClearanceM - 1e-3) break;
        camera = keepInRange(camera, ground);
        result.lifted = true;
        settle();
    }
    return result;
}

}  // namespace worldy
