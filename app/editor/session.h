// The data set that the window shows, the bake on its way to replace it, and the one it replaced. Owns the
// planets and the threads that bake; all calls from the thread of the GL context.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/base/log.h"
#include "app/base/picture.h"
#include "app/data/bake_job.h"
#include "app/data/data_set.h"
#include "app/data/source_preview.h"
#include "app/data/worlds.h"
#include "app/scene/scene.h"
#include "planet/gl/device/gl_worker.h"
#include "planet/gl/draw/chunk_programs.h"
#include "ui/model/editor_view.h"

namespace worldy {

// A planet that can be drawn, and what is known of how it was made.
struct OpenPlanet {
    DataSet data;
    BakeRequest baked;              // as far as it is known
    bool compressionKnown = false;  // only of what was baked here
    bool sourceIsThere = false;     // when it was opened
    Scene scene;
};

// A bake on its way.
struct SessionBake {
    BakeRequest request;
    DataSet data;                  // what to open once it is done
    bool forComparison = false;    // the planet that it replaces is kept
    bool needed = false;           // without it there is nothing to show
    bool colourMayFail = false;    // the image was not asked for by name
    std::unique_ptr<BakeJob> job;  // none while an earlier bake into the same file comes to its end

    bool stopping() const { return job && job->cancelling(); }
};

struct SessionEstimate {
    std::unique_ptr<EstimateJob> job;
    std::optional<BakeRequest> next;  // asked about while another one ran
    std::optional<planet::BakeEstimate> result;
    std::string problem;
};

struct SessionShaders {
    std::filesystem::path folder;  // empty: the built-in shaders
    std::filesystem::file_time_type changed{};
    std::shared_ptr<planet::gl::GlWorker>
        worker;  // compiles shaders off the frame; null: frames wait for them
    // Shared by the session's planets, so opening another one compiles nothing. Null until the first one is
    // opened.
    std::shared_ptr<planet::gl::ChunkPrograms> programs;
};

struct Session {
    DataSet data;  // what is shown, or is to be
    SessionShaders shaders;
    std::optional<Picture> colour;
    std::filesystem::path colourFile;              // where it comes from
    std::optional<OpenPlanet> open;                // none until the first data set is there
    std::optional<OpenPlanet> previous;            // the bake before, for comparison
    bool showsPrevious = false;                    // only where there is one
    std::optional<planet::Error> problem;          // why the last data set could not be opened
    std::optional<SessionBake> bake;               // running, or about to
    std::vector<std::unique_ptr<BakeJob>> ending;  // cancelled, not yet at their end; nobody waits for them
    std::optional<planet::Error> bakeProblem;      // why the last bake came to nothing
    std::optional<planet::BakeReport> bakeReport;  // of the last bake
    SessionEstimate estimate;
    SourcePreviewer preview;
    std::vector<World> worlds = worldy::worlds();
};

// Bakes in the background where the data set needs it; advanceSession opens it.
Session startSession(DataSet data, const std::filesystem::path& shaderFolder, const Log& log);

// A chunk file or a source in place of what is shown, which stays until the new one is open. A source without
// a bake is baked in the background first. A bake that runs is cancelled. False if it cannot be opened; the
// reason is in the log and in Session::problem, and nothing has changed.
bool openFile(Session& session, const std::filesystem::path& file, const ViewSettings& settings,
              const Log& log);

// Bakes into the cache; the planet flies on, and becomes the previous one when the bake is done. Refused,
// with a line in the log, while another bake runs or where the source is not there.
void startBake(Session& session, const BakeRequest& request, const Log& log);
// The bake that the data set needs, again: for a window with nothing to show.
void startBake(Session& session, const Log& log);
void cancelBake(Session& session);

// Shows a bake of a request that lies in a file, at once; the planet becomes the previous one. Where the file
// is not there any more, it is baked anew if its source is known.
void openBake(Session& session, const BakeRequest& request, const std::filesystem::path& chunkFile,
              const ViewSettings& settings, const Log& log);

// At a frame's start: opens what has been baked, starts what waits, and passes the planets' problems to the
// log.
void advanceSession(Session& session, const ViewSettings& settings, const Log& log);

void showPreviousBake(Session& session, bool shown);
void dismissPreviousBake(Session& session);

// A second planet beside the one that is shown, from a chunk file or from what one is baked from. Nothing of
// the session changes. The Error says what cannot be opened, and of a source that it has to be baked first.
planet::Result<OpenPlanet> openBeside(const Session& session, const std::filesystem::path& file,
                                      const ViewSettings& settings);
planet::Result<OpenPlanet> openBeside(const Session& session, const DataSet& data,
                                      const ViewSettings& settings);
// Exchanges it for the one that is shown; only while one is.
void exchangeShown(Session& session, OpenPlanet& other, const Log& log);

// Replaces what was asked before. What is estimated is in bakeViewOf.
void requestEstimate(Session& session, const BakeRequest& request);

// The planet that is to be drawn, the previous bake's where that is shown: null while there is nothing.
const OpenPlanet* shownPlanet(const Session& session);
Scene* shownScene(Session& session);
const Scene* shownScene(const Session& session);

ui::BakeView bakeViewOf(const Session& session);
ui::DataView dataViewOf(const Session& session, std::span<const std::filesystem::path> recent);

// Compiles the shaders of the folder again once one of them has changed, for all planets of the session.
void reloadChangedShaders(Session& session, const Log& log);

}  // namespace worldy
