// The controls of the colours that are baked with the heights: none, the source's own image or another image,
// and their size and packing.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "ui/model/editor_view.h"

namespace worldy::ui {

struct ColourEdit {
    enum class From : int { None, Own, Image };
    From from = From::None;
    std::array<char, 1024> imageText{};  // the path being typed
    std::string problem;                 // why the image cannot be baked; empty: it can
    std::filesystem::path chosen;        // from the dialog or a drop; used in the next frame
    bool takesDrops = false;             // the pointer is over the controls
};

// Sets edit from the request's image.
void setColour(const BakeRequest& request, ColourEdit& edit);

// Call when the request's source has changed: if the source's own image is chosen, takes that of the new
// source.
void followSource(BakeRequest& request, ColourEdit& edit);

// Draws the controls and returns true if the request has changed. The labels of values that differ from the
// open file's are lit.
bool colourControls(const EditorView& view, ColourEdit& edit, BakeRequest& request, Commands& commands);

// Returns for example "1025 texels, BC1".
std::string colourText(const planet::ColourBakeSettings& colour);

}  // namespace worldy::ui
