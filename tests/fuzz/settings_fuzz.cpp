// Fuzzes settings files and presets: settings that are read are written as the same settings.
#include "app/settings/settings_text.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace worldy;
using fuzz::isRead;
using fuzz::require;

void readSettings(std::string_view text) {
    const auto settings = settingsFromText(text, "fuzzed.toml");
    if (!isRead(settings)) return;
    const std::string written = settingsText(*settings);
    const auto again = settingsFromText(written, "written.toml");
    require(isRead(again), "what is written can be read");
    require(settingsText(*again) == written, "what is read again is the same");
}

void readPreset(std::string_view text) {
    const auto part = viewPartFromText(text, "fuzzed.toml");
    if (!isRead(part)) return;
    const ViewSettings view = applied(*part, {});
    require(differences(view, *part).empty(), "a preset that is laid over differs no more");
    require(isRead(viewPartFromText(viewSettingsText(view), "written.toml")), "what is written can be read");
}

// Reads a line as an assignment on the command line.
void setOne(std::string_view text) {
    Settings settings;
    const auto line = text.substr(0, text.find('\n'));
    if (isRead(setSetting(settings, line)))
        require(isRead(settingsFromText(settingsText(settings), "set.toml")), "what is set can be written");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::textOf(data, size);
    readSettings(text);
    readPreset(text);
    setOne(text);
    return 0;
}
