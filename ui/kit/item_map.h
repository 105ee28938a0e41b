// Maps the names of controls to their places on the screen, for scripts that drive the window: the tests and
// the script that takes the manual's pictures. Nothing is collected unless collectItems() asks for it. One
// thread.
#pragma once

#include <string>
#include <vector>

#include "ui/model/layout.h"

namespace worldy::ui {

struct ItemPlace {
    std::string name;  // "lod/Tolerance"
    Rect rect;
};

// What follows is noted there, until told otherwise; null: nowhere. It must outlive the frame.
void collectItems(std::vector<ItemPlace>* into);
bool collectsItems();

// What comes before the slash in the names of the items that follow: a panel's key.
void setItemScope(std::string_view scope);

// Notes the last ImGui item, if it is in sight.
void noteItem(std::string_view label);
// Where ImGui does not say afterwards where an item was.
void noteRect(std::string_view label, const Rect& rect);

}  // namespace worldy::ui
