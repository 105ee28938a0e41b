// Controls of settings, built from the schema (app/settings/settings_schema.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/settings/settings_schema.h"

namespace worldy::ui {

// Replaces parts of the schema's description in one panel.
struct ControlChange {
    std::string label{};
    std::string help{};
    std::string format{};  // of the whole text, with the unit
    std::optional<NumberRange> range{};
};

// Finds settings by the address of their value and draws their controls:
//     const SettingControls control(settings);
//     control(settings.lod.tauPx);
// A control is a slider, check box, list or field with the label, range, format and tooltip of the schema.
// Make one SettingControls per panel and frame.
class SettingControls {
public:
    explicit SettingControls(ViewSettings& settings);
    // Draws the controls of the given fields, a subset of fieldsOf(ViewSettings&).
    explicit SettingControls(std::vector<Field> fields);

    // Draws the control. Returns true if the value has changed.
    template <class Value>
    bool operator()(Value& value, const ControlChange& change = {}) const {
        return draw(fieldOf(&value), change);
    }
    // Draws a check box to the right of the last one, if it fits there.
    bool beside(bool& value) const;

    // Returns the field of a value, for a control that the schema cannot draw.
    template <class Value>
    const Field& of(const Value& value) const {
        return fieldOf(&value);
    }

private:
    const Field& fieldOf(const void* value) const;
    static bool draw(const Field& field, const ControlChange& change);
    friend bool settingControl(const Field& field);

    std::vector<Field> fields_;
};

// Draws the control of one setting, which is no text, ramp or layers. Returns true if the value has changed.
bool settingControl(const Field& field);
// Returns the text of a control's tooltip: the help, then the name, the allowed values and the default.
std::string settingTip(const Field& field);
// Notes the last item in the item map by the name of its setting, "lod/lod.tau_px".
void noteSetting(const Field& field);

}  // namespace worldy::ui
