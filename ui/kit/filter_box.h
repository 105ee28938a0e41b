// The field that filters a list, and hits that are highlighted in the list. One filter's hits are highlighted
// at a time; the state is global like ImGui's own.
#pragma once

#include <string>

#include "ui/model/text_filter.h"

namespace worldy::ui {

// Draws the field. Esc clears it, and a button does while there is a text. what: "lines", for its tooltip.
void filterBox(TextFilter& filter, const char* what);

// Moves the focus to the filter of the window under the pointer, or of the one with the focus, or to the first
// filter that is shown. The field takes the focus in the next frame. Returns false if no filter is shown.
bool focusFilter();
// Returns true if a filter is shown. Valid after all panels are drawn.
bool isFilterShown();

// While a HitHighlight lives, highlightHits() and the cells of tables show the hits of its filter.
class HitHighlight {
public:
    explicit HitHighlight(const TextFilter& filter);
    ~HitHighlight();
    HitHighlight(const HitHighlight&) = delete;
    HitHighlight& operator=(const HitHighlight&) = delete;
};

// Draws the background of the hits in a text that is drawn next, at the cursor.
void highlightHits(const std::string& text);

}  // namespace worldy::ui
