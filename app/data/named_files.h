// TOML files that the user names, such as presets and layouts: those that come with Worldy, which are
// read-only, and the user's own.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "planet/base/result.h"

namespace worldy {

struct NamedFolders {
    std::filesystem::path shipped;
    std::filesystem::path own;  // need not exist yet
};

struct NamedFile {
    std::string name;  // the file's name without ".toml"
    std::filesystem::path file;
    bool shipped = false;
    bool isHidden = false;  // a shipped file has the same name
};

// Checks that a name is a valid file name on all systems: 1 to 60 bytes of UTF-8, without / \ : * ? " < >
// and control characters, and without a dot or space at either end. The Error says what is wrong.
planet::Result<void> checkFileName(std::string_view name);

// Returns true if the names clash on a file system that ignores the case of ASCII letters.
bool areSameName(std::string_view a, std::string_view b);

// Returns the files of both folders: shipped ones first, then by name. Hidden files are left out.
std::vector<NamedFile> namedFiles(const NamedFolders& folders);

// Returns the Error of a name that no file has. what: "preset".
planet::Error unknownName(std::string_view name, const NamedFolders& folders, std::string_view what);

// Returns the item whose member named has the name, or the Error of an unknown one. The items must outlive the result.
template <class Item>
planet::Result<const Item*> itemNamed(const std::vector<Item>& items, std::string_view name,
                                      const NamedFolders& folders, std::string_view what) {
    for (const Item& item : items)
        if (item.named.name == name) return &item;
    return tl::unexpected(unknownName(name, folders, what));
}

// Returns the file to write for a name, and creates the user's folder. A name that differs only in case keeps
// the name of the existing file. The Error says why the name cannot be used: it is no file name, or a shipped
// file has it. what: "preset".
planet::Result<std::filesystem::path> fileToWrite(const NamedFolders& folders, std::string_view name,
                                                  std::string_view what);

// Deletes a file of the user. The Error says that it is shipped, or why it cannot be deleted.
planet::Result<void> deleteNamed(const NamedFile& file, std::string_view what);

}  // namespace worldy
