// Maps the names of controls to their places on the screen, for scripts that drive the window: the tests and
// the script that takes the manual's pictures. Items are collected only after collectItems(). One thread.
#pragma once

#include <string>
#include <vector>

#include "ui/model/layout.h"

namespace worldy::ui {

struct ItemPlace {
    std::string name;  // "lod/Tolerance"
    Rect rect;
};

// Collects the following items into a list until the next call; null: stops collecting. The list must outlive
// the frame.
void collectItems(std::vector<ItemPlace>* into);
bool collectsItems();

// Sets the prefix of the names of the following items, before the slash: a panel's key.
void setItemScope(std::string_view scope);

// Notes the last ImGui item if it is visible.
void noteItem(std::string_view label);
// Notes a rectangle, for items whose place ImGui does not report afterwards.
void noteRect(std::string_view label, const Rect& rect);

}  // namespace worldy::ui
