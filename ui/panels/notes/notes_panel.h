// The Notes panel: writes notes about the view, a chunk or a measurement, and lists those of the planet.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "ui/model/editor_view.h"

namespace worldy::ui {

struct NotesPanelState {
    using Text = std::array<char, longestNoteBytes + 1>;

    int subject = 0;                      // index in noteSubjects()
    Text text{};                          // of the new note
    std::optional<std::uint64_t> edited;  // the note that is being edited
    Text editedText{};
    std::uint64_t opened = 0;  // NotesView::opened of the note that was scrolled to
};

// Fills the current window.
void notesPanel(const EditorView& view, NotesPanelState& state, const ViewSettings& settings,
                Commands& commands);

}  // namespace worldy::ui
