// The overlay of two compared pictures: their names, the divider between them, and a second pointer at the
// same place of the other picture.
#pragma once

#include <vector>

#include "ui/model/editor_view.h"
#include "ui/model/layout.h"

namespace worldy::ui {

// A picture, or a part of one, in the window: the part, and the rectangle of the whole picture.
struct ShownPart {
    bool isB = false;
    Rect part;
    Rect whole;
};
// Returns the shown parts; only A's while nothing is compared. In a difference, pointing refers to A.
std::vector<ShownPart> shownParts(const CompareView& compare, const CompareSettings& shown,
                                  const Rect& viewport);

// Lets the user drag the divider of a wipe. Call before the picture's own item, which lies below it.
void wipeHandle(CompareSettings& shown, const Rect& viewport);

void compareOverlay(const CompareView& compare, const CompareSettings& shown, const Rect& viewport);

}  // namespace worldy::ui
