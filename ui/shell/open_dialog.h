// The dialog that asks for a file: folders and files that Worldy opens, and a line to type or paste a path.
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
    bool opening = false;  // shows the dialog in the next frame
    FilePurpose purpose = FilePurpose::Open;
    std::filesystem::path folder;
    std::vector<OpenDialogEntry> entries;  // of the folder: folders first, sorted by name
    std::string problem;                   // why the folder cannot be listed
    std::array<char, 1024> path{};
};

// Returns true for the endings of files that Worldy may open for the purpose, such as chunk files, images and traces.
bool mayBeOpened(const std::filesystem::path& file, FilePurpose purpose);

// Sets the dialog's folder and its entries, without hidden files.
void listFolder(const std::filesystem::path& folder, OpenDialogState& state);

// Call every frame. Appends OpenFile, ChooseColourImage, StartCompare, StartTraceCompare or CompareAtlas, by the purpose.
void openDialog(OpenDialogState& state, Commands& commands);

}  // namespace worldy::ui
