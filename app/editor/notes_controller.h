// The notes of the shown planet. Main thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "app/editor/notices.h"
#include "app/editor/session.h"
#include "app/notes/notebook.h"
#include "app/settings/workspace.h"
#include "ui/model/commands.h"
#include "ui/model/notes_view.h"

namespace worldy {

struct NotesController {
    Notebook book{};
    std::filesystem::path chunkFile{};  // of the shown planet
    std::optional<std::uint64_t> open{};
    std::uint64_t opened = 0;  // grows whenever a note is opened from elsewhere than the list
    double lookedAtS = 0;      // when a file that could not be read was looked at again
};

// Call every frame. Opens the notes of another planet when it is shown; shown: null if no planet is. A file that could not
// be read is tried again twice a second. Messages say what is wrong with it.
void advanceNotes(NotesController& notes, const OpenPlanet* shown, double timeS, Notices& notices);

// workspace: the panel may be brought to the front.
void execute(NotesController& notes, const ui::NoteCommand& command, Workspace& workspace, Notices& notices);

ui::NotesView notesViewOf(const NotesController& notes);

}  // namespace worldy
