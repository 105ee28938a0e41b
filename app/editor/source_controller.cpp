#include "app/editor/source_controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/base/places.h"
#include "app/session/overloaded.h"
#include "planet/measure/pick.h"
#include "planet/source/height_source.h"
#include "ui/model/docking.h"

namespace worldy {

namespace {

constexpr std::size_t mostAskedChunks = 64;  // in a job
constexpr std::size_t mostTops = 1'000'000;  // chunks whose topmost layer is kept

void changeEdit(LayerEditing& editing, WorldEdit edit) {
    editing.edit = std::move(edit);
    const planet::Result<void> good = checkEdit(editing.edit);
    editing.bakeProblem = good ? std::string() : good.error().message;
    editing.changed = editing.file && !sameWorld(editing.shown, editing.edit);
    editing.unsaved = editing.file && !sameWorld(*editing.file, editing.edit);
}

// Reads the layers of a source to edit them. Unsaved changes of another source are kept until that is opened again.
void readEdits(SourceController& sources, const std::filesystem::path& source) {
    LayerEditing& editing = sources.editing;
    // The layers of the world file that a bake of them wrote are the edited ones.
    const auto isOf = [&](const LayerEditing& each) {
        return !source.empty() && (source == each.source || source == each.baked);
    };
    if (isOf(editing)) {
        editing.shown = source == editing.baked ? editing.bakedEdit : editing.opened;
        return changeEdit(editing, editing.edit);
    }
    if (editing.changed || editing.unsaved) sources.kept.push_back(editing);
    editing = {.source = source};
    if (source.empty()) return;
    const auto kept = std::ranges::find_if(sources.kept, isOf);
    if (kept != sources.kept.end()) {
        editing.source = kept->source;
        editing.baked = kept->baked;
        editing.bakedEdit = kept->bakedEdit;
    }
    planet::Result<WorldEdit> read = editOf(editing.source, sources.settings);
    if (!read) {
        editing.problem = read.error().message;
        return;
    }
    editing.file = editing.opened = *read;
    editing.shown = source == editing.baked ? editing.bakedEdit : editing.opened;
    changeEdit(editing, kept == sources.kept.end() ? *std::move(read) : kept->edit);
    if (kept != sources.kept.end()) sources.kept.erase(kept);
}

void meetPlanet(SourceController& sources, const OpenPlanet& open) {
    if (open.scene.identity == sources.scene) return;
    if (sources.reader.job) sources.reader.ending.push_back(std::move(sources.reader.job));
    sources.scene = open.scene.identity;
    sources.source = open.sourceIsThere ? open.baked.source : std::filesystem::path();
    sources.settings = open.baked.sourceSettings;
    sources.reader.asked = false;
    sources.reader.layers = open.layers;
    sources.reader.problem.clear();
    sources.queries.job.reset();
    sources.queries.tops.clear();
    sources.queries.selected.reset();
    sources.queries.pointed.reset();
    sources.depths.job.reset();
    sources.depths.depths.reset();
    readEdits(sources, sources.source);
}

void readSource(SourceController& sources, const Settings& settings, const Log& log) {
    std::erase_if(sources.reader.ending, [](const auto& job) { return job->takeResult().has_value(); });
    if (sources.reader.job) {
        std::optional<planet::Result<SharedLayers>> result = sources.reader.job->takeResult();
        if (!result) return;
        sources.reader.job.reset();
        if (*result) {
            sources.reader.layers = **result;
        } else {
            sources.reader.problem = result->error().message;
            log.error("{}", sources.reader.problem);
        }
    }
    const OverlaySettings& overlay = settings.view.overlay;
    const bool wanted = sources.reader.asked || ui::isVisible(PanelId::Sources, settings.workspace) ||
                        overlay.sources || overlay.colourBy == ColourBy::Source;
    if (!wanted || sources.reader.layers || !sources.reader.problem.empty() || sources.source.empty()) return;
    sources.reader.job = std::make_unique<SourceJob>(sources.source, sources.settings);
}

void readDepths(SourceController& sources, const planet::Planet& planet, const OverlaySettings& overlay,
                const Log& log) {
    if (sources.depths.job) {
        std::optional<planet::Result<LeafDepths>> result = sources.depths.job->takeResult();
        if (!result) return;
        sources.depths.job.reset();
        // Without the index, only leaves have a tint.
        if (!*result) log.error("{}", result->error().message);
        sources.depths.depths = *result ? **std::move(result) : LeafDepths{};
    }
    if (sources.depths.depths ||
        (overlay.colourBy != ColourBy::LeafDepth && overlay.colourBy != ColourBy::Spacing))
        return;
    sources.depths.job = std::make_unique<LeafDepthsJob>(planet.file());
}

void takeAnswers(SourceController& sources) {
    if (!sources.queries.job) return;
    const std::optional<std::vector<PlaceAnswer>> answers = sources.queries.job->takeResult();
    if (!answers) return;
    sources.queries.job.reset();
    std::size_t next = 0;
    if (sources.queries.tops.size() > mostTops) sources.queries.tops.clear();
    for (const planet::ChunkId& chunk : sources.queries.chunks) {
        const planet::SourceReading* const top = planet::topmost((*answers)[next++].readings);
        sources.queries.tops[chunk] = top ? std::optional(top->layer) : std::nullopt;
    }
    const auto take = [&](std::optional<planet::Geographic>& asked, std::optional<ui::PlaceReadings>& into) {
        if (!asked) return;
        const PlaceAnswer& answer = (*answers)[next++];
        into = ui::PlaceReadings{*asked, answer.readings, answer.problem};
        asked.reset();
    };
    take(sources.queries.selectedPlace, sources.queries.selected);
    take(sources.queries.pointedPlace, sources.queries.pointed);
}

bool isSame(const planet::Geographic& a, const planet::Geographic& b) {
    return a.latitudeRad == b.latitudeRad && a.longitudeRad == b.longitudeRad;
}

// Returns the ground under the pointer, if a panel shows what made it.
std::optional<planet::Geographic> pointedPlace(const SourceFrame& frame) {
    const Workspace& workspace = frame.settings.workspace;
    if (!ui::isVisible(PanelId::Sources, workspace) && !ui::isVisible(PanelId::Probe, workspace))
        return std::nullopt;
    const PlanetPicture& picture = frame.picture;
    if (!picture.shown() || !picture.pointer.over) return std::nullopt;
    const planet::Planet& planet = *frame.open->scene.planet;
    const std::optional<planet::SurfaceHit> hit =
        planet::pickSurface(planet.tree(), planet.selection().draw, picture.view.eyeM,
                            rayThrough(picture.view, picture.pointer.positionPx));
    if (!hit) return std::nullopt;
    return planet::geographicFromDirection(hit->positionM);
}

// Asks about one batch of places at a time.
void askPlaces(SourceController& sources, const SourceFrame& frame) {
    takeAnswers(sources);
    const std::optional<planet::Geographic> middle =
        frame.focus.selected ? std::optional(placeInMiddleOf(*frame.focus.selected)) : std::nullopt;
    if (sources.queries.selected && (!middle || !isSame(sources.queries.selected->place, *middle)))
        sources.queries.selected.reset();
    if (!sources.reader.layers || sources.queries.job) return;
    std::vector<planet::Geographic> places;
    sources.queries.chunks.clear();
    if (frame.settings.view.overlay.colourBy == ColourBy::Source) {
        for (const planet::DrawItem& item : frame.open->scene.planet->selection().draw) {
            if (sources.queries.chunks.size() == mostAskedChunks) break;
            if (sources.queries.tops.contains(item.id)) continue;
            sources.queries.chunks.push_back(item.id);
            places.push_back(placeInMiddleOf(item.id));
        }
    }
    const auto ask = [&](const std::optional<planet::Geographic>& place,
                         const std::optional<ui::PlaceReadings>& known,
                         std::optional<planet::Geographic>& asked) {
        if (!place || (known && isSame(known->place, *place))) return;
        asked = place;
        places.push_back(*place);
    };
    ask(middle, sources.queries.selected, sources.queries.selectedPlace);
    ask(pointedPlace(frame), sources.queries.pointed, sources.queries.pointedPlace);
    if (!places.empty())
        sources.queries.job = std::make_unique<PlacesJob>(sources.reader.layers, std::move(places));
}

void bakeEdited(SourceController& sources, const OpenPlanet& open, Notices& notices, ui::Commands& next) {
    LayerEditing& editing = sources.editing;
    const std::string stem = planet::heightSourceFiles(editing.source).stem;
    const planet::Result<std::filesystem::path> file =
        writeForBake(editing.edit, cacheFolder() / "worlds", stem);
    if (!file)
        return tellError(notices,
                         {"The layers cannot be baked", file.error().message, "Change the layers.", false});
    editing.baked = *file;
    editing.bakedEdit = editing.edit;
    BakeRequest request{*file, {}, open.baked.settings, open.baked.colour};
    // The finest samples may be those of another layer now, and the heights may have another range.
    request.settings.faceSize.reset();
    request.settings.quantumM.reset();
    request.settings.finestQuantumM.reset();
    next.push_back(ui::StartBake{std::move(request)});
}

void saveEdited(LayerEditing& editing, const ui::SaveLayers& save, Notices& notices) {
    const std::filesystem::path& file = save.file;
    std::error_code status;
    editing.replaces.clear();
    if (!save.replaces && std::filesystem::exists(file, status)) {
        editing.replaces = file;
        return;
    }
    if (!succeeded(notices, saveWorld(editing.edit, file),
                   fmt::format("{} cannot be saved", file.filename().string())))
        return;
    editing.file = editing.edit;
    editing.unsaved = false;
    confirm(notices, fmt::format("World file {} saved", std::filesystem::absolute(file, status).string()));
}

// Returns the source that names all files: one, or a list.
std::filesystem::path sourceOfFiles(const std::vector<std::filesystem::path>& files) {
    std::string text;
    for (const std::filesystem::path& file : files) text += (text.empty() ? "" : "|") + file.string();
    return text;
}

}  // namespace

void advanceSources(SourceController& sources, const SourceFrame& frame, const Log& log) {
    if (!frame.open) return;
    meetPlanet(sources, *frame.open);
    readSource(sources, frame.settings, log);
    readDepths(sources, *frame.open->scene.planet, frame.settings.view.overlay, log);
    askPlaces(sources, frame);
}

void execute(SourceController& sources, const ui::SourceCommand& command, const OpenPlanet* open,
             Workspace& workspace, Notices& notices, ui::Commands& next) {
    LayerEditing& editing = sources.editing;
    std::visit(Overloaded{
                   [&](const ui::ReadSource&) {
                       sources.reader.asked = true;
                       sources.reader.problem.clear();
                   },
                   [&](const ui::EditLayers& edit) { changeEdit(editing, edit.edit); },
                   [&](const ui::RevertLayers&) {
                       if (editing.file) changeEdit(editing, editing.changed ? editing.shown : *editing.file);
                   },
                   [&](const ui::BakeLayers&) {
                       if (open) bakeEdited(sources, *open, notices, next);
                   },
                   [&](const ui::SaveLayers& save) { saveEdited(editing, save, notices); },
                   [&](const ui::AddDroppedFiles&) {
                       WorldEdit edit = editing.edit;
                       addLayer(edit, std::exchange(sources.dropped, {}));
                       changeEdit(editing, std::move(edit));
                       ui::showPanel(PanelId::Sources, workspace);
                   },
                   [&](const ui::OpenDroppedFiles&) {
                       next.push_back(ui::OpenFile{sourceOfFiles(std::exchange(sources.dropped, {}))});
                   },
                   [&](const ui::DismissDrop&) { sources.dropped.clear(); },
               },
               command);
}

bool takeDroppedFile(SourceController& sources, const std::filesystem::path& file) {
    if (!sources.editing.file || !planet::isGeoreferenced(file)) return false;
    sources.dropped.push_back(file);
    return true;
}

ui::SourcesView sourcesViewOf(const SourceController& sources, const Session& session) {
    using State = ui::SourcesView::State;
    ui::SourcesView view;
    // The world file of a bake of edited layers stands for their own source.
    const bool isBakeOfEdits = !sources.source.empty() && sources.source == sources.editing.baked;
    view.source = isBakeOfEdits ? sources.editing.source : sources.source;
    view.problem = sources.reader.problem;
    view.layers = sources.reader.layers.get();
    view.state = sources.reader.layers             ? State::Read
                 : sources.source.empty()          ? State::Unknown
                 : sources.reader.job              ? State::Reading
                 : !sources.reader.problem.empty() ? State::Failed
                                                   : State::Unread;
    const LayerEditing& editing = sources.editing;
    if (editing.file) view.edit = &editing.edit;
    view.editProblem = editing.problem;
    view.edited = editing.changed;
    view.unsaved = editing.unsaved;
    view.bakeProblem = editing.bakeProblem;
    view.replaces = editing.replaces;
    view.baking = session.bake.has_value();
    view.selected = sources.queries.selected;
    view.pointed = sources.queries.pointed;
    view.dropped = sources.dropped;
    return view;
}

TintData tintDataOf(const SourceController& sources) {
    return {.depths = sources.depths.depths ? &*sources.depths.depths : nullptr,
            .tops = sources.reader.layers ? &sources.queries.tops : nullptr};
}

}  // namespace worldy
