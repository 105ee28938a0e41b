// Describes the source of the shown planet for the panels.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/data/world_edit.h"
#include "planet/source/source_layers.h"

namespace worldy::ui {

// The readings of a place, which come some frames after the place is asked for.
struct PlaceReadings {
    planet::Geographic place{};
    std::vector<planet::SourceReading> readings{};  // the top layer first
    std::string problem{};                          // why there are none
};

struct SourcesView {
    enum class State : std::uint8_t {
        Unknown,  // the planet was opened from a chunk file
        Unread,   // the source is known, but not open
        Reading,
        Failed,
        Read
    };
    State state = State::Unknown;
    std::filesystem::path source{};                // empty if it is unknown
    std::string problem{};                         // why it cannot be read
    const planet::SourceLayers* layers = nullptr;  // set if it is read; valid for the frame

    const WorldEdit* edit = nullptr;  // the edited layers; null if they cannot be edited; valid for the frame
    std::string editProblem{};        // why they cannot be edited
    bool edited = false;              // they differ from those that the planet was baked from
    bool unsaved = false;             // they differ from those of the file
    std::string bakeProblem{};        // why the edited layers cannot be baked
    std::filesystem::path
        replaces{};  // an existing file that saving would replace; the user is asked about it
    bool baking = false;

    std::optional<PlaceReadings> selected{};  // the middle of the selected chunk
    std::optional<PlaceReadings> pointed{};   // the ground under the pointer

    std::vector<std::filesystem::path> dropped{};  // rasters that wait for the answer to the drop question
};

}  // namespace worldy::ui
