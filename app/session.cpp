#include "app/session.h"

#include <algorithm>
#include <utility>

#include "ui/text.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;

void openBaked(Session& session, const ui::ViewSettings& settings, const Log& log) {
    const SceneConfig config{session.data.chunkFile, session.shaderFolder,
                             session.colour ? &*session.colour : nullptr};
    planet::Result<Scene> scene = openScene(config, settings);
    if (!scene) {
        log->error("{}", scene.error().message);
        session.problem = scene.error();
        return;
    }
    session.scene.emplace(std::move(*scene));
    log->info("Open: {}, {} on disk, {} levels", session.data.chunkFile.string(),
              ui::bytesText(static_cast<double>(session.scene->planet->file().sizeBytes())),
              planet::leafLevel(session.scene->planet->shape()) + 1);
    log->debug("Depth buffer: {}", session.scene->renderer.capabilities().reversedZ
                                       ? "float, reversed"
                                       : "the near plane follows the ground");
}

void finishBake(Session& session, const ui::ViewSettings& settings, const Log& log) {
    const std::optional<planet::Result<planet::BakeReport>> result = session.bake->takeResult();
    if (!result) return;
    session.bake.reset();
    if (!*result) {
        const bool cancelled = result->error().kind == planet::ErrorKind::Cancelled;
        log->log(cancelled ? spdlog::level::warn : spdlog::level::err, "{}",
                 cancelled ? "The bake was cancelled" : result->error().message);
        session.problem = result->error();
        return;
    }
    const planet::BakeReport& report = **result;
    log->info("Baked: {} samples in {}, {}", ui::countText(static_cast<double>(report.samples)),
              ui::durationText(report.seconds), ui::bytesText(static_cast<double>(report.fileBytes)));
    session.data.needsBake = false;
    openBaked(session, settings, log);
}

fs::file_time_type newestIn(const fs::path& folder) {
    fs::file_time_type newest = fs::file_time_type::min();  // today is negative on some clocks
    std::error_code status;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, status)) {
        newest = std::max(newest, entry.last_write_time(status));
    }
    return newest;
}

}  // namespace

Session startSession(DataSet data, const fs::path& shaderFolder, const Log& log) {
    Session session;
    session.data = std::move(data);
    session.shaderFolder = shaderFolder;
    if (!shaderFolder.empty()) session.shadersChanged = newestIn(shaderFolder);
    if (!session.data.colourImage.empty()) {
        planet::Result<Picture> colour = readPicture(session.data.colourImage);
        if (colour)
            session.colour = std::move(*colour);
        else
            log->warn("{}", colour.error().message);
    }
    if (session.data.needsBake) startBake(session, log);
    return session;
}

void startBake(Session& session, const Log& log) {
    std::error_code status;
    fs::create_directories(session.data.chunkFile.parent_path(), status);
    log->info("Baking {} into {}", session.data.source.string(), session.data.chunkFile.string());
    session.problem.reset();
    session.bake =
        std::make_unique<BakeJob>(session.data.source, session.bakeSettings, session.data.chunkFile);
}

void advanceSession(Session& session, const ui::ViewSettings& settings, const Log& log) {
    if (session.problem) return;
    if (session.bake) {
        finishBake(session, settings, log);
    } else if (!session.scene) {
        openBaked(session, settings, log);
    }
    if (!session.scene) return;
    for (const std::string& problem : session.scene->planet->takeProblems()) log->error("{}", problem);
}

void reopenScene(Session& session, const ui::ViewSettings& settings, const Log& log) {
    if (!session.scene) return;
    // The old planet first gives its memory back.
    session.scene.reset();
    openBaked(session, settings, log);
}

void reloadChangedShaders(Session& session, const Log& log) {
    if (!session.scene || session.shaderFolder.empty()) return;
    const fs::file_time_type newest = newestIn(session.shaderFolder);
    if (newest == session.shadersChanged) return;
    session.shadersChanged = newest;
    const planet::Result<void> reloaded = session.scene->renderer.reloadShaders();
    if (reloaded)
        log->info("Shaders of {} reloaded", session.shaderFolder.string());
    else
        log->error("{}", reloaded.error().message);
}

}  // namespace worldy
