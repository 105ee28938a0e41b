// The state of the Atlas panel.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "app/scene/atlas_drape.h"
#include "planet/measure/atlas.h"
#include "planet/measure/atlas_run.h"
#include "planet/measure/atlas_sampling.h"

namespace worldy::ui {

struct AtlasView {
    const planet::Atlas* atlas = nullptr;        // null before one is opened or surveyed
    std::string name{};                          // of its file; empty: it is not saved
    std::span<const planet::AtlasCell> cells{};  // that are not split
    const AtlasDrape* drape = nullptr;           // of the chosen measure and altitude; null without an atlas
    int altitude = 0;                            // index of the chosen one
    std::string otherBake{};  // why it does not fit the shown planet; empty: it does, as far as is known
    bool running = false;
    bool cancelling = false;
    std::optional<planet::AtlasProgress> progress{};  // none while the tree is read
    std::string problem{};                            // why the last survey or file failed
};

}  // namespace worldy::ui
