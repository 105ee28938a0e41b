// Greek letters and arrows that the font of the user interface may lack. The state is global; use it only on
// the thread of the user interface.
#pragma once

#include <string>

namespace worldy::ui {

// Tells whether the current font has Greek letters and arrows; the theme calls it when it loads a font.
// Before the first call symbols are written out.
void setFontHasGreek(bool hasGreek);

// Return "τ" and "ε", or "tau" and "eps" if the font has no Greek.
const char* tauSymbol();
const char* epsSymbol();
// Returns the text with "τ", "ε", "δ", "→", "≤" and "≥" written out if the font lacks them: "δc" becomes "delta_c".
std::string inFont(std::string text);

}  // namespace worldy::ui
