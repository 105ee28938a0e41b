// The dialog that asks for a file: folders and what Worldy opens, and a line to type or paste a path.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "ui/model/commands.h"

namespace worldy::ui {

struct OpenDialogEntry {
    std::filesystem::path path;
    bool isFolder = false;
    double bytes = 0;
};

struct OpenDialogState {
    bool opening = false;     // shows the dialog with the next frame
    bool forColours = false;  // asks for the Bake panel's image of colours instead of a file to open
    std::filesystem::path folder;
    std::vector<OpenDialogEntry> entries;  // of the folder: folders first, by name
    std::string problem;                   // why they cannot be listed
    std::array<char, 1024> path{};
};

// Files that Worldy may open go by their endings: chunk files, images, raw faces, presets.
bool mayBeOpened(const std::filesystem::path& file);

// The folder's entries as the dialog lists them. Hidden ones are left out.
void listFolder(const std::filesystem::path& folder, OpenDialogState& state);

// Call every frame. Appends OpenFile or ChooseColourImage.
void openDialog(OpenDialogState& state, Commands& commands);

}  // namespace worldy::ui
