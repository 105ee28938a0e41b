// A setting that differs between two sets of settings, as text.
#pragma once

#include <string>

namespace worldy {

struct SettingDifference {
    std::string setting;  // "lod.tau_px"
    std::string here;
    std::string there;
    std::string label{};  // the title of its control: "Tolerance τ"
};

}  // namespace worldy
