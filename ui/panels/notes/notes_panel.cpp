#include "ui/panels/notes/notes_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "app/base/text.h"
#include "ui/kit/item_map.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/note_subjects.h"

namespace worldy::ui {

namespace {

constexpr std::size_t shownLetters = 60;

void keep(NotesPanelState::Text& field, const std::string& text) {
    field.fill(0);
    std::memcpy(field.data(), text.data(), std::min(text.size(), field.size() - 1));
}

bool textField(const char* id, NotesPanelState::Text& text, const char* label) {
    const float lines = 3.6f * ImGui::GetTextLineHeight();
    const bool changed = ImGui::InputTextMultiline(id, text.data(), text.size(), {-1, lines});
    noteItem(label);
    return changed;
}

void writeNote(const EditorView& view, double exaggeration, NotesPanelState& state, Commands& commands) {
    std::vector<NoteSubject> subjects = noteSubjects(view, exaggeration);
    state.subject = std::clamp(state.subject, 0, static_cast<int>(subjects.size()) - 1);
    std::string items;
    for (const NoteSubject& subject : subjects) items += subject.label + '\0';
    items += '\0';
    constexpr const char* explanation =
        "What the note is about. Its pin lies there on the globe. \"Fly there\" shows the view in which the "
        "note was written, or for a pop the view in which it was seen. A note about a measurement keeps its "
        "figures.";
    labelledControl("About", explanation);
    combo("About", state.subject, items.c_str());
    tooltip(explanation);
    NoteSubject& subject = subjects[static_cast<std::size_t>(state.subject)];
    textField("##text", state.text, "Text");
    tooltip("The text of the new note. Its first words are shown beside its pin.");
    const bool isEmpty = state.text[0] == 0;
    const std::string whyNot = !subject.note ? subject.whyNot : isEmpty ? "Type a text first." : "";
    beginGrey(!whyNot.empty(), whyNot.c_str());
    if (button("Add note", "Saves the note beside the planet's file.")) {
        subject.note->text = state.text.data();
        commands.emplace_back(AddNote{*subject.note});
        state.text.fill(0);
    }
    endGrey();
    if (subject.note && !subject.note->measurement.empty()) {
        sameLineIfRoom(ImGui::CalcTextSize(subject.note->measurement.c_str()).x);
        wrappedText(subject.note->measurement, palette().dim);
    }
}

void noteRow(const Note& note, const NotesView& notes, bool scrolls, Commands& commands) {
    ImGui::TableNextColumn();
    if (scrolls) ImGui::SetScrollHereY(0.4f);
    const bool isOpen = notes.open == note.id;
    const std::string label = fmt::format("{}###note", firstWords(note, shownLetters));
    if (ImGui::Selectable(label.c_str(), isOpen,
                          ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick)) {
        commands.emplace_back(OpenNote{note.id});
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
            commands.emplace_back(MoveCamera{note.camera, true});
    }
    noteItem(fmt::format("Note {}", note.id));
    tooltip([&] { return note.text + "\n\nClick to open, double-click to fly there."; });
    cell(note.about, palette().dim);
    cell(note.chunk.empty() ? placeText(note.latitudeDeg, note.longitudeDeg, 2) : note.chunk, palette().dim);
    cell(note.created, palette().dim);
}

void noteList(const NotesView& notes, NotesPanelState& state, Commands& commands) {
    if (notes.notes.empty()) return wrappedText("There are no notes on this planet yet.", palette().dim);
    constexpr std::array columns = {
        TableColumn{"Note", 3, "The first words.", "A note about a place"},
        TableColumn{"About", 0.6f, "The view, a chunk, or what was measured.", "true error"},
        TableColumn{"Place", 1, nullptr, "z_pos/12/4095/4095"},
        TableColumn{"Written", 0.6f, nullptr, "2026-11-26 16:50"}};
    if (!beginListTable("notes", columns, notes.notes.size(), 10)) return;
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        const Note& note = notes.notes[row];
        if (column == 0) return note.text;
        if (column == 1) return note.about;
        return column == 2 ? (note.chunk.empty() ? SortKey(note.latitudeDeg) : SortKey(note.chunk))
                           : note.created;
    };
    const bool isNew = state.opened != notes.opened;
    tableRows(notes.notes.size(), key, [&](std::size_t row) {
        const Note& note = notes.notes[row];
        noteRow(note, notes, isNew && notes.open == note.id, commands);
    });
    state.opened = notes.opened;
    endTable(exportTable<Note>("notes", notes.notes.size(), [&](std::size_t row) { return notes.notes[row]; },
                               {{"id", [](const Note& note) { return note.id; }, true},
                                {"text", [](const Note& note) { return note.text; }},
                                {"about", [](const Note& note) { return note.about; }},
                                {"created", [](const Note& note) { return note.created; }},
                                {"latitude_deg", [](const Note& note) { return note.latitudeDeg; }},
                                {"longitude_deg", [](const Note& note) { return note.longitudeDeg; }},
                                {"height_m", [](const Note& note) { return note.heightM; }},
                                {"chunk", [](const Note& note) { return note.chunk; }},
                                {"measurement", [](const Note& note) { return note.measurement; }}}));
}

void deletePopup(const Note& note, Commands& commands) {
    if (!ImGui::BeginPopup("delete")) return;
    ImGui::Text("Delete \"%s\" permanently?", firstWords(note, 40).c_str());
    if (ImGui::Button("Delete")) {
        commands.emplace_back(DeleteNote{note.id});
        ImGui::CloseCurrentPopup();
    }
    noteItem("Delete");
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

void editControls(const Note& note, NotesPanelState& state, Commands& commands) {
    textField("##edited", state.editedText, "Edited text");
    const bool isEmpty = state.editedText[0] == 0;
    beginGrey(isEmpty, "Type a text first; \"Delete...\" deletes a note.");
    if (button("Save", "Saves the changed text.")) {
        commands.emplace_back(EditNote{note.id, state.editedText.data()});
        state.edited.reset();
    }
    endGrey();
    ImGui::SameLine();
    if (button("Discard", "Keeps the text as it was.")) state.edited.reset();
}

void openNote(const Note& note, NotesPanelState& state, Commands& commands) {
    if (state.edited == note.id)
        editControls(note, state, commands);
    else
        wrappedText(note.text, palette().text);
    if (!note.measurement.empty())
        wrappedText(fmt::format("{}: {}", note.about, note.measurement), palette().dim);
    wrappedText(fmt::format("{}, height {}", placeText(note.latitudeDeg, note.longitudeDeg),
                            distanceText(note.heightM)),
                palette().dim);
    if (button("Fly there", "Moves the camera to the view in which the note was written.")) {
        commands.emplace_back(MoveCamera{note.camera, true});
        if (const auto chunk = planet::chunkIdFromString(note.chunk))
            commands.emplace_back(SelectChunk{chunk});
    }
    sameLineForButton("Edit");
    beginGrey(state.edited == note.id, "The text is being edited.");
    if (button("Edit", "Changes the text.")) {
        state.edited = note.id;
        keep(state.editedText, note.text);
    }
    endGrey();
    sameLineForButton("Delete...");
    if (button("Delete...", "Deletes the note after confirmation.")) ImGui::OpenPopup("delete");
    deletePopup(note, commands);
}

}  // namespace

void notesPanel(const EditorView& view, NotesPanelState& state, const ViewSettings& settings,
                Commands& commands) {
    if (!view.planet) return emptyState("No planet is open. Open one to see and write its notes.");
    const NotesView& notes = view.notes;
    if (!notes.problem.empty()) {
        wrappedText(fmt::format("{}. It is left as it is; notes are kept in {} until it is mended.",
                                notes.problem, notes.file.filename().string()),
                    palette().bad);
    }
    if (section("New note")) writeNote(view, settings.surface.exaggeration, state, commands);
    if (!section("Notes")) return;
    noteList(notes, state, commands);
    const auto open = std::find_if(notes.notes.begin(), notes.notes.end(),
                                   [&](const Note& note) { return notes.open == note.id; });
    if (open != notes.notes.end()) openNote(*open, state, commands);
    ImGui::Spacing();
    ImGui::TextDisabled("in %s", notes.file.filename().c_str());
    tooltip([&] { return notes.file.string(); });
}

}  // namespace worldy::ui
