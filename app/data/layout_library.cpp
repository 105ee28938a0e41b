#include "app/data/layout_library.h"

#include <fmt/format.h>

#include <utility>

#include "app/base/output_file.h"
#include "app/base/places.h"
#include "app/data/write_check.h"
#include "app/settings/settings_text.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

constexpr std::string_view what = "layout";

}  // namespace

NamedFolders layoutFolders() {
    return {dataFolder() / "layouts", configFolder() / "layouts"};
}

bool areSameLayout(const Workspace& a, const Workspace& b) {
    Workspace compared = withLayout(b, a);
    compared.inFront = b.inFront;
    compared.maximised = b.maximised;
    return compared == b;
}

Workspace withLayout(const Workspace& now, const Workspace& layout) {
    Workspace workspace = layout;
    workspace.preferences = now.preferences;
    return workspace;
}

LayoutLibrary::LayoutLibrary(NamedFolders folders) : folders_(std::move(folders)) {
    reload();
}

void LayoutLibrary::reload() {
    layouts_.clear();
    for (NamedFile& named : namedFiles(folders_)) {
        Result<Workspace> workspace = loadLayout(named.file);
        if (named.isHidden) {
            workspace = planet::badInput(
                fmt::format("{}: a built-in layout has that name; rename the file", named.file.string()));
        }
        layouts_.push_back({std::move(named), std::move(workspace)});
    }
}

Result<const NamedLayout*> LayoutLibrary::existing(std::string_view name) const {
    return itemNamed(layouts_, name, folders_, what);
}

Result<Workspace> LayoutLibrary::load(std::string_view name) const {
    return existing(name).and_then([](const NamedLayout* layout) { return layout->workspace; });
}

Result<void> LayoutLibrary::save(std::string_view name, const Workspace& workspace, bool replaces) {
    const Result<fs::path> file = fileToWrite(folders_, name, what);
    if (!file) return tl::unexpected(file.error());
    // Other files in the folder are not overwritten.
    if (Result<void> kind = checkKinds({{*file, OutputKind::Layout}}); !kind) return kind;
    std::error_code status;
    if (!replaces && fs::exists(*file, status)) {
        return planet::badInput(
            fmt::format("{}: exists; expected another name, or a request to replace it", file->string()));
    }
    Result<void> written = writeTextFile(*file, layoutText(workspace));
    reload();
    return written;
}

Result<void> LayoutLibrary::remove(std::string_view name) {
    const Result<const NamedLayout*> layout = existing(name);
    if (!layout) return tl::unexpected(layout.error());
    Result<void> deleted = deleteNamed((*layout)->named, what);
    reload();
    return deleted;
}

}  // namespace worldy
