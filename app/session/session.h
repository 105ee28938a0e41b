// The data set that the window shows, the bake that will replace it, and the previous bake. Owns the planets
// and the baking threads. Call only on the thread of the GL context.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/base/log.h"
#include "app/data/bake_job.h"
#include "app/data/data_set.h"
#include "app/data/source_jobs.h"
#include "app/scene/scene.h"
#include "planet/gl/device/gl_worker.h"
#include "planet/gl/draw/chunk_programs.h"
#include "ui/model/editor_view.h"

namespace worldy {

// A planet that can be drawn, and what is known of its bake.
struct OpenPlanet {
    DataSet data;
    BakeRequest baked;              // as far as known
    bool compressionKnown = false;  // only for bakes of this session
    bool sourceIsThere = false;     // the source existed when the planet was opened
    Scene scene;
    SharedLayers layers{};     // of the source; null unless this session baked the planet
    bool isFirstLook = false;  // a coarse bake, shown until the whole one is done
};

// A bake that is running or waiting.
struct SessionBake {
    BakeRequest request;
    DataSet data;                                  // the data set to open when it is done
    bool forComparison = false;                    // the replaced planet is kept
    bool needed = false;                           // nothing can be shown without it
    bool colourMayFail = false;                    // the image was not chosen by the user
    std::optional<DataSet> firstLook{};            // baked or opened first, so that something is shown soon
    std::optional<planet::HeightSource> opened{};  // the source, if it is open already
    std::unique_ptr<BakeJob> job;                  // none while an earlier bake is still ending

    bool stopping() const { return job && job->cancelling(); }
};

struct SessionShaders {
    std::filesystem::path folder;  // empty: the built-in shaders
    std::filesystem::file_time_type changed{};
    std::shared_ptr<planet::gl::GlWorker>
        worker;  // compiles shaders asynchronously; null: frames wait for them
    // Shared by the session's planets, so that opening another compiles nothing. Null until the first is
    // opened.
    std::shared_ptr<planet::gl::ChunkPrograms> programs;
};

struct Session {
    DataSet data;  // the data set that is shown or will be
    SessionShaders shaders;
    std::optional<OpenPlanet> open;                // none until the first data set is open
    std::optional<OpenPlanet> previous;            // the previous bake, for comparison
    bool showsPrevious = false;                    // only if there is a previous one
    std::optional<planet::Error> problem;          // why the last data set could not be opened
    std::optional<SessionBake> bake;               // running or waiting
    std::vector<std::unique_ptr<BakeJob>> ending;  // cancelled but not finished; nothing waits for them
    std::optional<planet::Error> bakeProblem;      // why the last bake failed
    std::optional<planet::BakeReport> bakeReport;  // of the last bake
};

// Starts a session. If the data set needs a bake, it runs in the background, and advanceSession() opens first a coarse
// bake and then the whole one. opened: the data set's source, if it is open already.
Session startSession(DataSet data, const std::filesystem::path& shaderFolder, const Log& log,
                     std::optional<planet::HeightSource> opened = {});

// Opens a chunk file or a source. The shown planet stays until the new one is open. A source without a bake
// is baked in the background first. A running bake is cancelled. Returns false if the file cannot be opened;
// the reason is in the log and in Session::problem, and nothing has changed.
bool openFile(Session& session, const std::filesystem::path& file, const ViewSettings& settings,
              const Log& log);

// Starts a bake into the cache. The shown planet stays usable and becomes the previous one when the bake is
// done. Refused with a warning in the log while another bake is running or if the source is missing.
void startBake(Session& session, const BakeRequest& request, const Log& log);
// Repeats the bake that the data set needs, if there is nothing to show.
void startBake(Session& session, const Log& log);
void cancelBake(Session& session);

// Opens an existing bake of a request at once; the shown planet becomes the previous one. If the file no
// longer exists, it is baked again if its source is known.
void openBake(Session& session, const BakeRequest& request, const std::filesystem::path& chunkFile,
              const ViewSettings& settings, const Log& log);

// Call at the start of a frame. Opens finished bakes, starts waiting ones, and logs the planets' problems.
void advanceSession(Session& session, const ViewSettings& settings, const Log& log);

void showPreviousBake(Session& session, bool shown);
void dismissPreviousBake(Session& session);

// Opens a second planet, from a chunk file or from a source with a bake. The session does not change. The
// Error says what cannot be opened, or that the source has to be baked first.
planet::Result<OpenPlanet> openBeside(const Session& session, const std::filesystem::path& file,
                                      const ViewSettings& settings);
planet::Result<OpenPlanet> openBeside(const Session& session, const DataSet& data,
                                      const ViewSettings& settings);
// Swaps other and the shown planet. Requires a shown planet.
void exchangeShown(Session& session, OpenPlanet& other);

// Returns the planet to draw, which may be that of the previous bake; null if there is none.
const OpenPlanet* shownPlanet(const Session& session);
Scene* shownScene(Session& session);
const Scene* shownScene(const Session& session);

// Leaves out the data of BakeController.
ui::BakeView bakeViewOf(const Session& session);
ui::DataView dataViewOf(const Session& session, std::span<const std::filesystem::path> recent);

// Returns whether a file in the folder of the shaders is newer than when they were compiled.
bool shadersHaveChanged(const Session& session);
// Recompiles the shaders of the folder if one has changed, for all planets of the session. On an Error those that were
// compiled last go on.
planet::Result<void> reloadChangedShaders(Session& session, const Log& log);

}  // namespace worldy
