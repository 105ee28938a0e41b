#include "ui/model/key_names.h"

#include <algorithm>

namespace worldy::ui {

namespace {

// Global like ImGui's own state.
KeyNames currentNames;

}  // namespace

void setKeyNames(KeyNames names) {
    currentNames = std::move(names);
}

std::string keyOf(std::string_view command) {
    const auto found = std::find_if(currentNames.begin(), currentNames.end(),
                                    [&](const auto& name) { return name.first == command; });
    return found == currentNames.end() ? std::string() : found->second;
}

std::string withKey(const std::string& text, std::string_view command) {
    const std::string key = keyOf(command);
    return key.empty() ? text : text + " (" + key + ")";
}

}  // namespace worldy::ui
