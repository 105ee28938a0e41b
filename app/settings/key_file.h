// The file of changed keys, keys.toml: the keys of commands, by their ids or their names.
//
//     freeze_lod = "F3"
//     redo = ["Ctrl+Shift+Z", "Ctrl+Y"]
//     "Unprojected cube" = ""          # no key
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/settings/key_chord.h"
#include "planet/base/result.h"

namespace worldy {

using KeyChords = std::vector<KeyChord>;

// A command that may have keys.
struct KeyedCommand {
    std::string id;    // "freeze_lod"
    std::string name;  // "Freeze LOD"
    std::string help;  // a sentence
    KeyChords keys;    // by default
};

struct KeyFile {
    std::vector<KeyChords> keys;        // of each command, in their order
    std::vector<std::string> problems;  // "keys.toml: line 3: ..."; an entry with a problem is left out
};

// Returns configFolder()/keys.toml.
std::filesystem::path keyFilePath();

// Reads the file. Commands that it does not name keep their default keys. An entry that names an unknown
// command or key, or a key that another command has, is left out, and a problem says so. If the file is not
// TOML, all keys are the defaults. A missing file is no problem. The default keys of the commands differ.
KeyFile readKeyFile(const std::filesystem::path& file, std::span<const KeyedCommand> commands);
// Does the same with a text. place stands for the file name in problems.
KeyFile keysFromText(std::string_view text, const std::filesystem::path& place,
                     std::span<const KeyedCommand> commands);

// Returns a file that lists all commands and their default keys in comments.
std::string keyFileText(std::span<const KeyedCommand> commands);
// Writes keyFileText(). The Error says that the file exists, which is never overwritten, or cannot be written.
planet::Result<void> writeKeyFile(const std::filesystem::path& file, std::span<const KeyedCommand> commands);

}  // namespace worldy
