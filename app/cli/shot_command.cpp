#include "app/cli/shot_command.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "app/base/message.h"
#include "app/base/picture_file.h"
#include "app/base/report.h"
#include "app/base/text.h"
#include "app/data/worlds.h"
#include "app/scene/frame_report.h"
#include "app/scene/offscreen.h"
#include "app/settings/screenshot.h"
#include "app/settings/settings_text.h"
#include "app/settings/shot_line.h"
#include "planet/source/height_source.h"

namespace worldy {

namespace {

using planet::Result;

Result<void> writeShot(const Picture& picture, const planet::CameraPose& pose, const ShotOptions& options) {
    if (options.output.extension() != ".png") return writePicture(picture, options.output);
    std::error_code status;
    const std::filesystem::path file = std::filesystem::absolute(options.file, status);
    Settings settings;
    settings.view = options.view;
    settings.dataSet = file.string();
    settings.colourImage = options.colourImage.empty()
                               ? std::string()
                               : std::filesystem::absolute(options.colourImage, status).string();
    const std::string line =
        shotLine(file, pose, options.size, options.view, settings.colourImage, options.source);
    return writeScreenshot(picture, options.output, {settingsText(settings), pose, file, line, {}});
}

void printReport(const Offscreen& offscreen, const SettledView& view, const ShotOptions& options) {
    const planet::Selection& selection = offscreen.scene.planet->selection();
    const FrameStats stats = statsOf(offscreen.scene);
    if (options.json) {
        nlohmann::ordered_json report = {{"output", options.output.string()},
                                         {"width_px", options.size.widthPx},
                                         {"height_px", options.size.heightPx},
                                         {"tau_px", options.view.lod.tauPx},
                                         {"fov_deg", options.view.camera.fovDeg},
                                         {"settled", view.settled},
                                         {"camera", poseJson(view.pose)},
                                         {"drawn_by_level", drawnByLevel(selection)},
                                         {"regions", regionsJson(offscreen.scene.planet->tree(), selection)}};
        nlohmann::ordered_json drawn = statsJson(stats);
        // Frame times need a series of frames, and there was only one.
        drawn.erase("frame_ms");
        for (const char* key : {"draw_gpu_ms", "chunks_gpu_ms", "sky_gpu_ms"}) drawn.erase(key);
        report.update(drawn);
        fmt::print("{}", jsonText(report));
        return;
    }
    fmt::print("{}: {} chunks, {} triangles, max ε {:.2f} px, max drawn bound {:.2f} px, {} read\n",
               options.output.string(), stats.selection.drawn,
               countText(static_cast<double>(stats.selection.triangles())), stats.selection.worstEpsPx,
               stats.selection.worstDrawnBoundPx, bytesText(static_cast<double>(stats.paging.bytesRead())));
}

// Opens the source if the picture shows its layers. A picture that lacks what its settings ask for is drawn with a message.
Result<std::shared_ptr<const planet::SourceLayers>> layersFor(const ShotOptions& options) {
    if (options.view.overlay.colourBy == ColourBy::Atlas)
        printMessage("worldy: only the window has an atlas, so the chunks are grey\n");
    if (!showsSource(options.view.overlay)) return nullptr;
    if (options.source.empty()) {
        printMessage(
            "worldy: no source is named, so its layers are not shown; expected --source with what {} was "
            "baked from\n",
            options.file.string());
        return nullptr;
    }
    return sourceNamed(options.source, {})
        .and_then([](const NamedSource& named) { return planet::openHeightSource(named.source, {}); })
        .map([](const planet::HeightSource& source) { return source.layers; });
}

}  // namespace

Result<void> takeShot(const ShotOptions& options) {
    // Loading the libraries that write the picture takes long, so another thread does it meanwhile.
    const std::jthread loading(loadImageLibraries);
    const Result<std::filesystem::path> colour = colourImageToDraw(options.file, options.colourImage);
    if (!colour) return tl::unexpected(colour.error());
    const SceneConfig config{options.file, options.shaderFolder, *colour};
    Result<Offscreen> offscreen = openOffscreen(config, options.view, options.size, options.samples);
    if (!offscreen) return tl::unexpected(offscreen.error());
    // A named image must be readable, even if the file has colours of its own.
    if (!options.colourImage.empty()) {
        if (Result<void> read = readColourImage(offscreen->scene); !read) return read;
    }

    Result<std::shared_ptr<const planet::SourceLayers>> layers = layersFor(options);
    if (!layers) return tl::unexpected(layers.error());
    offscreen->layers = *std::move(layers);

    const double radiusM = offscreen->scene.planet->tree().shape.radiusM;
    const SettledView view =
        settleAt(*offscreen, options.camera.value_or(startPose(options.start, radiusM)), options.view);
    if (view.lifted) {
        printMessage("worldy: the camera was below the ground; lifted to {:.1f} m, {} m above it\n",
                     view.pose.altitudeM, minGroundClearanceM);
    }
    if (!view.settled)
        printMessage("worldy: loading timed out; the picture may be coarser than the settings require\n");
    const Result<void> drawn = drawAndFinish(*offscreen, view.view, options.view);
    for (const std::string& problem : takeProblems(offscreen->scene)) printMessage("worldy: {}\n", problem);
    if (!drawn) return drawn;
    if (Result<void> written = writeShot(readPicture(*offscreen), view.pose, options); !written)
        return written;
    printReport(*offscreen, view, options);
    return {};
}

}  // namespace worldy
