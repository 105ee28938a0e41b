// What colours are baked with the heights: none, the source's own image, or another; their size and packing.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "ui/model/editor_view.h"

namespace worldy::ui {

struct ColourEdit {
    enum class From : int { None, Own, Image };
    From from = From::None;
    std::array<char, 1024> imageText{};  // being typed
    std::string problem;                 // why it cannot be baked; empty: it can
    std::filesystem::path chosen;        // in the dialog, or dropped: taken over with the next frame
    bool takesDrops = false;             // the pointer is over the controls
};

// Takes a request's image apart.
void setColour(const BakeRequest& request, ColourEdit& edit);

// Another source: where its own image was meant, that is now another one.
void followSource(BakeRequest& request, ColourEdit& edit);

// True where the request has changed. Lit where it is not the open file's.
bool colourControls(const EditorView& view, ColourEdit& edit, BakeRequest& request, Commands& commands);

// "1025 texels, BC1".
std::string colourText(const planet::ColourBakeSettings& colour);

}  // namespace worldy::ui
