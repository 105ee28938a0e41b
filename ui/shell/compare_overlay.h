// What is written over two compared pictures: which is which, where one ends and the other begins, and a
// second pointer at the same place of the other one.
#pragma once

#include <vector>

#include "ui/model/editor_view.h"
#include "ui/model/layout.h"

namespace worldy::ui {

// Where the window shows a picture, or the part of one: the part, and where all of it would lie.
struct ShownPart {
    bool isB = false;
    Rect part;
    Rect whole;
};
// One of A alone while nothing is compared. What stands in a difference stands at A's place.
std::vector<ShownPart> shownParts(const CompareView& compare, const CompareSettings& shown,
                                  const Rect& viewport);

// What is dragged: over the divider of a wipe. Call before the picture's own item, which lies under it.
void wipeHandle(CompareSettings& shown, const Rect& viewport);

void compareOverlay(const CompareView& compare, const CompareSettings& shown, const Rect& viewport);

}  // namespace worldy::ui
