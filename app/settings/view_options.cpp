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
    for (const std::string& option : texts.options) {
        if (const planet::Result<void> set = setSetting(settings, option); !set)
            return tl::unexpected(set.error());
    }
    if (!texts.layerSet.empty()) {
        planet::Result<planet::LayerSet> set = loadLayerSet(texts.layerSet);
        if (!set) return tl::unexpected(set.error());
        view.surface.layers.set = std::move(*set);
        // The path is stored in pictures, so it must be valid in any folder.
        std::error_code status;
        view.surface.layers.file = std::filesystem::absolute(texts.layerSet, status).string();
    }
    for (const std::string& assignment : texts.assignments) {
        if (const planet::Result<void> set = setSetting(settings, assignment); !set)
            return planet::badInput("--set " + set.error().message);
    }
    return settings;
}

}  // namespace worldy
