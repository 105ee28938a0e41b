// The atlas of the window: opens it, surveys the shown planet in the background, and looks from its viewpoints. Main
// thread.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/base/log.h"
#include "app/editor/camera_controller.h"
#include "app/editor/settings_controller.h"
#include "app/measure/atlas_job.h"
#include "app/measure/atlas_table.h"
#include "app/scene/atlas_drape.h"
#include "app/session/notices.h"
#include "app/session/session.h"
#include "planet/base/result.h"
#include "planet/measure/atlas.h"
#include "planet/measure/atlas_sampling.h"
#include "ui/model/atlas_view.h"
#include "ui/model/commands.h"

namespace worldy {

// Names the files of the last survey.
struct AtlasFiles {
    std::filesystem::path output{};  // that it writes
    // Keeps the name of the output, by an empty file that is removed with it.
    std::shared_ptr<void> reservation{};
    std::shared_ptr<const planet::Atlas> revisited{};  // whose viewpoints it surveys; null for others
    std::filesystem::path revisitedFile{};
    std::string planet{};  // that is surveyed, as the window names it
};

// A survey keeps using the chunk file that it started with: the planet may be closed or rebaked while it runs.
struct AtlasController {
    AtlasFiles files{};               // before the job, which writes them
    std::unique_ptr<AtlasJob> job{};  // at most one
    std::optional<planet::Atlas> atlas{};
    std::filesystem::path file{};  // of the atlas
    std::vector<planet::AtlasCell> cells{};
    std::vector<AtlasSpread> spreads{};
    planet::AtlasMeasure measure = planet::AtlasMeasure::EpsPx;
    int altitude = 0;       // index
    bool isChange = false;  // shows the changes since the earlier survey
    AtlasDrape drape{};     // of the measure at the altitude
    std::string problem{};
    bool cancelled = false;  // the problem is that the user cancelled
    std::optional<ui::AtlasComparison> comparison{};
    std::string comparisonProblem{};
};

// Parts of other features that the commands use and change.
struct AtlasContext {
    const OpenPlanet* open;  // null if no planet is shown
    SettingsController& settings;
    CameraController& camera;
    const CameraContext& cameraContext;
    bool replaying = false;  // settings then stay as they are
};
void execute(AtlasController& controller, const ui::AtlasCommand& command, const AtlasContext& context,
             Notices& notices);

// Call every frame; takes the result of a survey.
void advanceAtlas(AtlasController& controller, const Log& log);

// Compares an atlas with an earlier survey of the same viewpoints, by diffOf. The Error names the file and what does not
// belong together.
planet::Result<ui::AtlasComparison> comparisonOf(const planet::Atlas& earlier,
                                                 const std::filesystem::path& earlierFile,
                                                 const planet::Atlas& now,
                                                 const std::filesystem::path& nowFile);

// Returns the settings now with those of a survey that decide what is drawn: level of detail, budgets, field of view,
// exaggeration and the sea. The way of looking at it stays: overlays, colours, light, and the disk.
ViewSettings settingsToLookWith(const ViewSettings& now, const ViewSettings& surveyed);

// open: the shown planet; null if there is none.
ui::AtlasView atlasViewOf(const AtlasController& controller, const OpenPlanet* open);

}  // namespace worldy
