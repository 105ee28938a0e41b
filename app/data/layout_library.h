// Layouts of the window: named workspaces in TOML files. Those that come with Worldy are in its data folder and
// are read-only; the user's own are in the config folder, beside the presets.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/data/named_files.h"
#include "app/settings/workspace.h"
#include "planet/base/result.h"

namespace worldy {

NamedFolders layoutFolders();

struct NamedLayout {
    NamedFile named;
    planet::Result<Workspace> workspace;  // with the default theme and scale; an Error if it cannot be read
};

// Returns true if the panels lie in the same places. Ignores which tabs are in front and which dock is
// maximised, which change all the time, and the theme and the scale, which are no part of a layout.
bool areSameLayout(const Workspace& a, const Workspace& b);

// Returns the layout with the theme and the scale of another workspace.
Workspace withLayout(const Workspace& now, const Workspace& layout);

// All layouts, read once. Call reload() after files may have changed.
class LayoutLibrary {
public:
    explicit LayoutLibrary(NamedFolders folders);

    void reload();

    // Returns the layouts: shipped ones first, then by name; unreadable files with their problem.
    std::span<const NamedLayout> layouts() const { return layouts_; }
    planet::Result<Workspace> load(std::string_view name) const;

    // Saves a layout as one of the user's. Refuses to replace an existing one unless replaces is true, and a
    // shipped one always.
    planet::Result<void> save(std::string_view name, const Workspace& workspace, bool replaces);
    planet::Result<void> remove(std::string_view name);

private:
    planet::Result<const NamedLayout*> existing(std::string_view name) const;

    NamedFolders folders_;
    std::vector<NamedLayout> layouts_;
};

}  // namespace worldy
