#include "ui/shell/open_dialog.h"

#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <system_error>

#include "app/base/text.h"
#include "app/flight/flight_record.h"
#include "planet/measure/atlas_file.h"
#include "ui/kit/item_map.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"

namespace worldy::ui {

namespace {

namespace fs = std::filesystem;

constexpr const char* popup = "###open a file";

void setPath(OpenDialogState& state, const std::string& path) {
    const std::size_t length = std::min(path.size(), state.path.size() - 1);
    std::memcpy(state.path.data(), path.data(), length);
    state.path[length] = '\0';
}

// Lists a folder that the user has entered. The field holds its path, so that it agrees with the list.
void showFolder(const fs::path& folder, OpenDialogState& state) {
    listFolder(folder, state);
    setPath(state, state.folder.string());
}

// Draws the entries. A click picks one; a double click enters a folder or opens a file. Returns true if the
// file is to be opened.
bool entryRows(OpenDialogState& state) {
    bool chosen = false;
    fs::path entered;
    // Folders stay before files in every order.
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        const OpenDialogEntry& entry = state.entries[row];
        if (column == 0) return entry.path.filename().string();
        return entry.bytes;
    };
    std::vector<std::size_t> order = tableOrder(state.entries.size(), chosenSort(), key);
    std::stable_partition(order.begin(), order.end(),
                          [&](std::size_t row) { return state.entries[row].isFolder; });
    for (const std::size_t row : order) {
        const OpenDialogEntry& entry = state.entries[row];
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const std::string name = entry.path.filename().string() + (entry.isFolder ? "/" : "");
        const bool picked = entry.path.string() == state.path.data();
        if (entry.isFolder) ImGui::PushStyleColor(ImGuiCol_Text, palette().accent);
        if (ImGui::Selectable(name.c_str(), picked,
                              ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick |
                                  ImGuiSelectableFlags_DontClosePopups)) {
            setPath(state, entry.path.string());
            const bool twice = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
            if (twice && entry.isFolder) entered = entry.path;
            if (twice && !entry.isFolder) chosen = true;
        }
        if (entry.isFolder) ImGui::PopStyleColor();
        ImGui::TableNextColumn();
        if (!entry.isFolder) ImGui::TextDisabled("%s", bytesText(entry.bytes).c_str());
    }
    if (!entered.empty()) showFolder(entered, state);
    return chosen;
}

bool folderList(OpenDialogState& state) {
    bool chosen = false;
    const ImVec2 screen = ImGui::GetMainViewport()->WorkSize;
    const float font = ImGui::GetFontSize();
    const ImVec2 size(std::min(36 * font, screen.x - 4 * font),
                      std::clamp(screen.y - 12 * font, 4 * font, 18 * font));
    if (ImGui::BeginTable("files", 2,
                          ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersOuter |
                              ImGuiTableFlags_Sortable | ImGuiTableFlags_SortTristate,
                          size)) {
        ImGui::TableSetupScrollFreeze(0, 1);
        ImGui::TableSetupColumn("Name", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("Size", ImGuiTableColumnFlags_WidthFixed);
        ImGui::TableHeadersRow();
        chosen = entryRows(state);
        ImGui::EndTable();
    }
    return chosen;
}

// Enters the typed folder, or opens the typed file. Returns true if a file is opened.
bool accept(OpenDialogState& state, Commands& commands) {
    const fs::path path(state.path.data());
    if (path.empty()) return false;
    std::error_code status;
    if (fs::is_directory(path, status)) {
        showFolder(path, state);
        return false;
    }
    // The next time, the list shows the file. Other sources are text or a pattern and have no folder.
    if (fs::exists(path, status)) {
        showFolder(fs::absolute(path, status).parent_path(), state);
        setPath(state, (state.folder / path.filename()).string());
    }
    switch (state.purpose) {
        case FilePurpose::Open:
            commands.push_back(OpenFile{path, true});
            break;
        case FilePurpose::BakedColours:
            commands.push_back(ChooseColourImage{path});
            break;
        case FilePurpose::SideB:
            commands.push_back(StartCompare{StartCompare::With::File, {}, path});
            break;
        case FilePurpose::TraceB:
            commands.push_back(StartTraceCompare{path});
            break;
        case FilePurpose::EarlierAtlas:
            commands.push_back(CompareAtlas{path});
            break;
    }
    return true;
}

// The texts of the dialog for a purpose.
struct DialogTexts {
    const char* title;
    const char* hint;
    const char* accept;
    const char* empty = "This folder contains no file that Worldy can open.";
};
DialogTexts textsFor(FilePurpose purpose) {
    if (purpose == FilePurpose::BakedColours)
        return {"Choose a colour image", "Path of a colour image or of one of six faces", "Choose"};
    if (purpose == FilePurpose::SideB)
        return {"Choose a planet as B", "Path of a chunk file or of a source that is baked", "Choose"};
    if (purpose == FilePurpose::TraceB)
        return {"Choose a trace as B", "Path of a second trace of the same flight", "Compare",
                "This folder contains no trace (.lodtrace)."};
    if (purpose == FilePurpose::EarlierAtlas)
        return {"Choose an earlier survey", "Path of an earlier atlas of the same viewpoints", "Compare",
                "This folder contains no atlas (.atlas)."};
    return {"Open a file", "Path of a chunk file, an elevation image or raster, a world file or a cube face",
            "Open"};
}

}  // namespace

bool mayBeOpened(const fs::path& file, FilePurpose purpose) {
    static constexpr std::array endings =
        std::to_array<std::string_view>({".chk",      ".tif",
                                         ".tiff",     ".hgt",
                                         ".dt0",      ".dt1",
                                         ".dt2",      ".asc",
                                         ".nc",       ".jp2",
                                         ".img",      ".bil",
                                         ".png",      ".pgm",
                                         ".exr",      ".hdr",
                                         ".jpg",      ".raw",
                                         ".toml",     ".atlas",
                                         ".lodtrace", recordedFlightEnding});
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    if (purpose == FilePurpose::TraceB) return ending == ".lodtrace";
    if (purpose == FilePurpose::EarlierAtlas) return ending == ".atlas";
    if (planet::isNamedAtlas(file)) return true;
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

void listFolder(const fs::path& folder, OpenDialogState& state) {
    state.entries.clear();
    state.problem.clear();
    std::error_code status;
    state.folder = fs::absolute(folder, status).lexically_normal();
    fs::directory_iterator files(state.folder, fs::directory_options::skip_permission_denied, status);
    if (status) state.problem = state.folder.string() + ": " + status.message();
    for (; files != fs::directory_iterator(); files.increment(status)) {
        if (status) break;
        const fs::path path = files->path();
        if (path.filename().string().starts_with('.')) continue;
        const bool isFolder = files->is_directory(status);
        if (!isFolder && !mayBeOpened(path, state.purpose)) continue;
        const std::uintmax_t size = isFolder ? 0 : files->file_size(status);
        state.entries.push_back({path, isFolder, status ? 0 : static_cast<double>(size)});
    }
    std::sort(state.entries.begin(), state.entries.end(), [](const auto& a, const auto& b) {
        return a.isFolder != b.isFolder ? a.isFolder : a.path < b.path;
    });
}

void openDialog(OpenDialogState& state, Commands& commands) {
    if (state.opening) {
        std::error_code status;
        if (state.folder.empty()) state.folder = fs::current_path(status);
        listFolder(state.folder, state);
        ImGui::OpenPopup(popup);
        state.opening = false;
    }
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({0, 0}, ImGui::GetMainViewport()->WorkSize);
    const DialogTexts texts = textsFor(state.purpose);
    const std::string title = std::string(texts.title) + popup;
    if (!ImGui::BeginPopupModal(title.c_str(), nullptr,
                                ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings))
        return;
    setItemScope("open");
    if (ImGui::Button("Up") && state.folder.has_parent_path()) showFolder(state.folder.parent_path(), state);
    noteItem("Up");
    ImGui::SameLine();
    ImGui::TextUnformatted(state.folder.string().c_str());
    bool accepted = folderList(state);
    if (!state.problem.empty())
        ImGui::TextColored(palette().bad, "%s", state.problem.c_str());
    else if (state.entries.empty())
        ImGui::TextDisabled("%s", texts.empty);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    accepted |=
        ImGui::InputTextWithHint("##path", texts.hint, state.path.data(), state.path.size(),
                                 ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    noteItem("Path");
    accepted |= ImGui::Button(texts.accept);
    noteItem(texts.accept);
    ImGui::SameLine();
    // Esc closes popups, but a text field consumes it, so it is handled here.
    const bool left =
        ImGui::GetIO().WantTextInput && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
    const bool cancelled = ImGui::Button("Cancel") || left;
    if (cancelled || (accepted && accept(state, commands))) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

}  // namespace worldy::ui
