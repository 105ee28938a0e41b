// Knows the source of the shown planet: reads its layers in the background, asks them about places, and keeps the layers
// that the user edits. Main thread.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/data/source_jobs.h"
#include "app/data/world_edit.h"
#include "app/editor/viewport.h"
#include "app/scene/overlay_colours.h"
#include "app/scene/overlay_lines.h"
#include "app/session/notices.h"
#include "app/session/session.h"
#include "app/settings/settings.h"
#include "ui/model/commands.h"
#include "ui/model/sources_view.h"

namespace worldy {

// The layers of a source while they are edited. They outlive the planet that a bake of them replaces.
struct LayerEditing {
    std::filesystem::path source{};   // of which they are the layers
    std::filesystem::path baked{};    // the world file of their last bake; empty if there was none
    std::optional<WorldEdit> file{};  // as they were read or saved last; none if they cannot be edited
    WorldEdit edit{};
    WorldEdit opened{};                // as they were read from the source
    WorldEdit bakedEdit{};             // the layers of the last bake of edited ones
    WorldEdit shown{};                 // those of the two that the open planet was baked from
    bool changed = false;              // edit gives another world than the planet was baked from
    bool unsaved = false;              // edit gives another world than file
    std::string problem{};             // why they cannot be edited
    std::string bakeProblem{};         // why they cannot be baked
    std::filesystem::path replaces{};  // an existing file that saving them would replace
};

// Opens the source for its layers.
struct SourceReader {
    bool asked = false;   // the user wants it to be read
    SharedLayers layers;  // null until it is read
    std::string problem;  // why it cannot be read
    std::unique_ptr<SourceJob> job;
    std::vector<std::unique_ptr<SourceJob>> ending;  // of former planets; nothing waits for them
};

// Asks the layers about places, one batch at a time.
struct PlaceQueries {
    std::unique_ptr<PlacesJob> job;
    std::vector<planet::ChunkId> chunks;  // the first places of the job; then the others, if they are set
    std::optional<planet::Geographic> selectedPlace;
    std::optional<planet::Geographic> pointedPlace;
    SourceTops tops;  // the answers
    std::optional<ui::PlaceReadings> selected;
    std::optional<ui::PlaceReadings> pointed;
};

// Reads how deep the quadtree goes.
struct DepthReader {
    std::unique_ptr<LeafDepthsJob> job;
    std::optional<LeafDepths> depths;
};

struct SourceController {
    std::shared_ptr<const int> scene;  // the planet that the rest is about
    std::filesystem::path source;      // empty: not known
    planet::HeightSourceSettings settings;
    SourceReader reader;
    LayerEditing editing;
    std::vector<LayerEditing> kept;  // changed and unsaved layers of other sources
    PlaceQueries queries;
    DepthReader depths;
    std::vector<std::filesystem::path> dropped;  // rasters that wait for the answer to the drop question
};

// Call every frame. open: null if no planet is shown.
struct SourceFrame {
    const OpenPlanet* open;
    const Settings& settings;
    const ChunkFocus& focus;
    const PlanetPicture& picture;  // the main one
};
void advanceSources(SourceController& sources, const SourceFrame& frame, const Log& log);

// next: receives commands of other features. workspace: a panel may be brought to the front.
void execute(SourceController& sources, const ui::SourceCommand& command, const OpenPlanet* open,
             Workspace& workspace, Notices& notices, ui::Commands& next);

// Takes a file that was dropped or chosen in the open dialog if it could become a layer of the shown planet; the user is asked
// about it. Returns false for any other file.
bool takeDroppedFile(SourceController& sources, const std::filesystem::path& file);

// Valid until the sources change.
ui::SourcesView sourcesViewOf(const SourceController& sources, const Session& session);
TintData tintDataOf(const SourceController& sources);

}  // namespace worldy
