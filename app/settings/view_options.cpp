#include "app/settings/view_options.h"

#include <system_error>
#include <utility>

#include "app/settings/layer_file.h"
#include "app/settings/screenshot.h"
#include "app/settings/settings_text.h"

namespace worldy {

planet::Result<Settings> settingsFrom(const ViewTexts& texts) {
    Settings settings;
    if (!texts.settingsFile.empty()) {
        planet::Result<Settings> loaded = loadSettingsOfAnyKind(texts.settingsFile);
        if (!loaded) return loaded;
        settings = std::move(*loaded);
    }
    ViewSettings& view = settings.view;
    view.lod.tauPx = texts.tauPx.value_or(view.lod.tauPx);
    view.camera.fovDeg = texts.fovDeg.value_or(view.camera.fovDeg);
    view.paging.budgetMB = texts.budgetMB.value_or(view.paging.budgetMB);
    if (texts.noCulling) view.lod.frustumCulling = view.lod.horizonCulling = false;
    if (texts.noSkirts) view.seams.mode = planet::SeamMode::None;
    if (texts.wireframe) view.overlay.wireframe = true;
    if (texts.cube) view.overlay.cube = true;
    if (!texts.layerSet.empty()) {
        planet::Result<planet::LayerSet> set = loadLayerSet(texts.layerSet);
        if (!set) return tl::unexpected(set.error());
        view.surface.layers.set = std::move(*set);
        // A picture's note of it must hold wherever it is read.
        std::error_code status;
        view.surface.layers.file = std::filesystem::absolute(texts.layerSet, status).string();
    }
    std::vector<std::string> assignments;
    if (!texts.colourBy.empty()) assignments.push_back("overlay.colour_by=" + texts.colourBy);
    if (!texts.surface.empty()) assignments.push_back("surface.colour=" + texts.surface);
    if (!texts.seams.empty()) assignments.push_back("seams.mode=" + texts.seams);
    assignments.insert(assignments.end(), texts.assignments.begin(), texts.assignments.end());
    for (const std::string& assignment : assignments) {
        if (const planet::Result<void> set = setSetting(settings, assignment); !set)
            return planet::badInput("--set " + set.error().message);
    }
    return settings;
}

}  // namespace worldy
