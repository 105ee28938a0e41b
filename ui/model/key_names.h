// The names of the commands' keys, for tooltips and labels: the user can change the keys. The state is global
// like that of ui/model/font_symbols.h; use it only on the thread of the user interface.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace worldy::ui {

// Pairs of a command's id, or of the name of a setting that a command changes, and the command's first key.
using KeyNames = std::vector<std::pair<std::string, std::string>>;

void setKeyNames(KeyNames names);

// Returns the key of a command or of a setting, "F2"; empty if there is none.
std::string keyOf(std::string_view command);

// Returns the text with the key in brackets: "Freeze (F2)"; the text alone if there is no key.
std::string withKey(const std::string& text, std::string_view command);

}  // namespace worldy::ui
