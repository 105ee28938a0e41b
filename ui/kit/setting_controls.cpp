#include "ui/kit/setting_controls.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "app/settings/setting_value.h"
#include "ui/kit/item_map.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"
#include "ui/model/key_names.h"

namespace worldy::ui {

namespace {

// Returns the slider's format: the digits' format, then the unit.
std::string sliderFormat(const char* digits, const NumberRange& range, const std::string& changed) {
    if (!changed.empty()) return changed;
    const char* const gap = range.unit.empty() || range.unit == "°" ? "" : " ";
    return inFont(fmt::format("{}{}{}", digits, gap, range.unit));
}

ImGuiSliderFlags flagsOf(SliderScale scale) {
    return scale == SliderScale::Logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
}

// Draws the control of each kind of setting.
struct Draw {
    const char* label;
    const ControlChange& change;
    const Field& defaults;
    Tip tip;

    template <class Kind>
    auto defaultOf(const Kind&) const {
        return *std::get<Kind>(defaults.value).value;
    }

    bool operator()(const Number& number) const {
        const NumberRange& range = change.range ? *change.range : number.range;
        return slider(label, *number.value, defaultOf(number), range.min, range.max,
                      sliderFormat(number.format, range, change.format).c_str(), tip, flagsOf(number.scale));
    }
    bool operator()(const Integer& integer) const {
        const NumberRange& range = change.range ? *change.range : integer.range;
        return slider(label, *integer.value, defaultOf(integer), static_cast<int>(range.min),
                      static_cast<int>(range.max), sliderFormat("%d", range, change.format).c_str(), tip,
                      flagsOf(integer.scale));
    }
    bool operator()(const Flag& flag) const { return checkbox(label, *flag.value, defaultOf(flag), tip); }
    bool operator()(const Choice& choice) const {
        std::string items;
        for (std::size_t i = 0; i < choice.names.size(); ++i) items += choiceLabel(choice, i) + '\0';
        int index = *choice.value;
        const bool changed = choiceIndex(label, index, defaultOf(choice), items.c_str(), tip);
        if (changed) *choice.value = static_cast<std::uint8_t>(index);
        return changed;
    }
    bool operator()(const Seed& seed) const {
        litLabel(label, *seed.value != defaultOf(seed), tip);
        const std::uint32_t step = 1;
        ImGui::PushID(label);
        const bool changed = ImGui::InputScalar("##value", ImGuiDataType_U32, seed.value, &step);
        noteItem(label);
        tooltip(tip);
        ImGui::PopID();
        return changed;
    }
    // Files, ramps and layers have their own editors.
    bool operator()(const Text&) const { return noControl(); }
    bool operator()(const Ramp&) const { return noControl(); }
    bool operator()(const LayerStack&) const { return noControl(); }
    bool operator()(const TabOrder&) const { return noControl(); }
    bool operator()(const FloatingPanels&) const { return noControl(); }
    static bool noControl() {
        assert(false);
        return false;
    }
};

std::string tipOf(const Field& field, const std::string& help) {
    const std::string key = keyOf(field.name());
    return fmt::format("{}\n{}: {}.{}", help, field.name(), summaryOf(field),
                       key.empty() ? "" : "\nKey: " + key);
}

}  // namespace

std::string settingTip(const Field& field) {
    return tipOf(field, std::string(field.help));
}

void noteSetting(const Field& field) {
    if (collectsItems()) noteItem(field.name());
}

bool settingControl(const Field& field) {
    return SettingControls::draw(field, {});
}

SettingControls::SettingControls(ViewSettings& settings) : fields_(fieldsOf(settings)) {}

SettingControls::SettingControls(std::vector<Field> fields) : fields_(std::move(fields)) {}

bool SettingControls::beside(bool& value) const {
    const Field& field = fieldOf(&value);
    secondColumn(std::string(field.label).c_str());
    return draw(field, {});
}

const Field& SettingControls::fieldOf(const void* value) const {
    const auto found = std::find_if(fields_.begin(), fields_.end(),
                                    [&](const Field& field) { return field.address() == value; });
    assert(found != fields_.end());
    return *found;
}

bool SettingControls::draw(const Field& field, const ControlChange& change) {
    const std::string label = inFont(change.label.empty() ? std::string(field.label) : change.label);
    const auto tip = [&] {
        return tipOf(field, change.help.empty() ? std::string(field.help) : change.help);
    };
    const bool changed = std::visit(Draw{label.c_str(), change, defaultOf(field), tip}, field.value);
    noteSetting(field);
    return changed;
}

}  // namespace worldy::ui
