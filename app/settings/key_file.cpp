#include "app/settings/key_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "app/base/edit_distance.h"
#include "app/base/output_file.h"
#include "app/base/places.h"
#include "app/base/toml_file.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

constexpr std::size_t mostKeys = 4;            // of a command
constexpr std::size_t mostKeyNameBytes = 100;  // that are compared and shown
constexpr const char* exampleKeys = "expected keys such as \"F2\", \"Ctrl+Shift+Z\" or \"Alt+M\"";

// An entry of the file.
struct Entry {
    std::size_t command = 0;
    KeyChords keys;
    std::string place;  // "keys.toml: line 3"
    std::uint32_t line = 0;
    bool isRefused = false;
};

class KeyFileReader {
public:
    KeyFileReader(const fs::path& place, std::span<const KeyedCommand> commands)
        : place_(place), commands_(commands) {}

    KeyFile read(const toml::table& document) {
        for (const auto& [name, node] : inFileOrder(document)) readEntry(name, *node);
        refuseSharedKeys();
        KeyFile file;
        for (std::size_t i = 0; i < commands_.size(); ++i) file.keys.push_back(keysOf(i).first);
        file.problems = std::move(problems_);
        return file;
    }

private:
    using Named = std::pair<std::string, const toml::node*>;

    // TOML's tables are sorted by name.
    static std::vector<Named> inFileOrder(const toml::table& document) {
        std::vector<Named> entries;
        for (const auto& [name, node] : document) entries.emplace_back(std::string(name.str()), &node);
        std::ranges::stable_sort(entries, {}, [](const Named& entry) {
            const toml::source_position at = entry.second->source().begin;
            return std::pair(at.line, at.column);
        });
        return entries;
    }

    void readEntry(const std::string& name, const toml::node& node) {
        const std::string place = placeOf(place_, node);
        const auto found = std::ranges::find_if(commands_, [&](const KeyedCommand& command) {
            return command.id == name || command.name == name;
        });
        if (found == commands_.end()) return refuse(place, unknownCommand(name));
        const auto index = static_cast<std::size_t>(found - commands_.begin());
        const auto twice = std::ranges::find(entries_, index, &Entry::command);
        if (twice != entries_.end()) {
            return refuse(place,
                          fmt::format("{} has its keys in line {} already; expected one entry per command",
                                      found->id, twice->line));
        }
        const std::optional<KeyChords> keys = keysIn(place, found->id, node);
        if (keys) entries_.push_back({index, *keys, place, node.source().begin.line});
    }

    std::string unknownCommand(const std::string& name) const {
        const std::string shown = name.substr(0, mostKeyNameBytes);
        std::string nearest;
        std::size_t least = std::numeric_limits<std::size_t>::max();
        for (const KeyedCommand& command : commands_) {
            const std::size_t distance = editDistance(command.id, shown);
            if (distance < least) nearest = command.id;
            least = std::min(least, distance);
        }
        const bool isNear = 3 * least <= std::max(shown.size(), nearest.size());
        return fmt::format("{:.60} is not a command; {}", shown,
                           isNear ? "did you mean " + nearest + "?"
                                  : "expected a command of the Keys window, such as freeze_lod");
    }

    std::optional<KeyChords> keysIn(const std::string& place, const std::string& id, const toml::node& node) {
        KeyChords keys;
        const toml::array* const list = node.as_array();
        const auto add = [&](const toml::node& one) {
            const toml::value<std::string>* const text = one.as_string();
            if (!text) {
                refuse(place, fmt::format("{} is {}; {}", id, planet::shownValue(one), exampleKeys));
                return false;
            }
            if (text->get().empty() && !list) return true;
            const std::optional<KeyChord> chord = keyChordFrom(text->get().substr(0, mostKeyNameBytes));
            if (!chord) {
                refuse(place, fmt::format("{} is {}, which is not a key; {}", id, planet::shownValue(one),
                                          exampleKeys));
                return false;
            }
            if (const std::string use = fixedUseOf(*chord); !use.empty()) {
                refuse(place, fmt::format("{} is {}, but {}; expected another key, or the same with Ctrl", id,
                                          nameOf(*chord), use));
                return false;
            }
            if (std::ranges::find(keys, *chord) == keys.end()) keys.push_back(*chord);
            return true;
        };
        if (!list) return add(node) ? std::optional(keys) : std::nullopt;
        if (list->size() > mostKeys) {
            refuse(place, fmt::format("{} has {} keys; expected at most {}", id, list->size(), mostKeys));
            return std::nullopt;
        }
        for (const toml::node& one : *list)
            if (!add(one)) return std::nullopt;
        return keys;
    }

    // Returns the keys of a command, and the entry that they are from; null: the defaults.
    std::pair<KeyChords, const Entry*> keysOf(std::size_t command) const {
        for (const Entry& entry : entries_)
            if (entry.command == command && !entry.isRefused) return {entry.keys, &entry};
        return {commands_[command].keys, nullptr};
    }

    // A refused entry falls back to its default keys, which another entry may have taken, so this is repeated
    // until no key is shared. The defaults share none.
    void refuseSharedKeys() {
        for (bool changed = true; changed;) {
            changed = false;
            std::map<KeyChord, std::size_t> owners;
            for (std::size_t i = 0; i < commands_.size(); ++i)
                if (!keysOf(i).second)
                    for (const KeyChord& chord : commands_[i].keys) owners.emplace(chord, i);
            for (Entry& entry : entries_) {
                if (entry.isRefused) continue;
                const auto taken = std::ranges::find_if(
                    entry.keys, [&](const KeyChord& chord) { return owners.contains(chord); });
                if (taken != entry.keys.end()) {
                    refuseShared(entry, *taken, owners.at(*taken));
                    entry.isRefused = changed = true;
                    break;
                }
                for (const KeyChord& chord : entry.keys) owners.emplace(chord, entry.command);
            }
        }
    }

    void refuseShared(const Entry& entry, const KeyChord& chord, std::size_t owner) {
        const KeyedCommand& other = commands_[owner];
        const Entry* const from = keysOf(owner).second;
        refuse(
            entry.place,
            from ? fmt::format("{} is {}, which {} has in line {}; expected each key once",
                               commands_[entry.command].id, nameOf(chord), other.id, from->line)
                 : fmt::format("{} is {}, which is the key of {}; expected a free key, or another key for {} "
                               "in this file",
                               commands_[entry.command].id, nameOf(chord), other.id, other.id));
    }

    void refuse(const std::string& place, const std::string& why) {
        problems_.push_back(fmt::format("{}: {}", place, why));
    }

    const fs::path& place_;
    std::span<const KeyedCommand> commands_;
    std::vector<Entry> entries_;
    std::vector<std::string> problems_;
};

KeyFile keysFrom(const Result<toml::table>& document, const fs::path& place,
                 std::span<const KeyedCommand> commands) {
    // A copy of the document would not know its lines.
    const toml::table empty;
    KeyFile file = KeyFileReader(place, commands).read(document ? *document : empty);
    if (!document) file.problems.push_back(document.error().message);
    return file;
}

std::string quotedKeys(const KeyChords& keys) {
    if (keys.empty()) return "\"\"";
    std::string text;
    for (const KeyChord& chord : keys) {
        const std::string name = nameOf(chord);
        text += text.empty() ? "" : ", ";
        text += '"' + (name.ends_with('\\') ? name + '\\' : name) + '"';
    }
    return keys.size() > 1 ? "[" + text + "]" : text;
}

}  // namespace

fs::path keyFilePath() {
    return configFolder() / "keys.toml";
}

KeyFile readKeyFile(const fs::path& file, std::span<const KeyedCommand> commands) {
    std::error_code status;
    if (!fs::exists(file, status)) return keysFrom(toml::table(), file, commands);
    return keysFrom(parseTomlFile(file), file, commands);
}

KeyFile keysFromText(std::string_view text, const fs::path& place, std::span<const KeyedCommand> commands) {
    return keysFrom(parseTomlText(text, place), place, commands);
}

std::string keyFileText(std::span<const KeyedCommand> commands) {
    std::string text =
        "# Keys of Worldy's commands. Remove the # in front of a line and change its keys.\n"
        "# A key is a letter, a digit, a sign, F1 to F12, or one of Esc, Enter, Tab, Space, Backspace, "
        "Insert,\n"
        "# Delete, Home, End, PageUp, PageDown, Left, Right, Up, Down, Menu and Pause, with Ctrl+, Shift+ or "
        "Alt+\n"
        "# in front. \"\" is no key, and [\"F2\", \"Ctrl+F2\"] are two. No two commands may have the same "
        "key.\n"
        "# Worldy reads this file when it starts, and by Help > Reload keys.\n";
    for (const KeyedCommand& command : commands) {
        text += fmt::format("\n# {}: {}\n# {} = {}\n", command.name, command.help, command.id,
                            quotedKeys(command.keys));
    }
    return text;
}

Result<void> writeKeyFile(const fs::path& file, std::span<const KeyedCommand> commands) {
    std::error_code status;
    if (fs::exists(fs::symlink_status(file, status))) {
        return planet::badInput(fmt::format(
            "{}: exists and is not overwritten; edit it, or move it away to get a new one", file.string()));
    }
    fs::create_directories(fs::absolute(file, status).parent_path(), status);
    return writeTextFile(file, keyFileText(commands));
}

}  // namespace worldy
