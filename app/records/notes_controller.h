// The notes of the shown planet. Main thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/data/data_set.h"
#include "app/notes/notebook.h"
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

// Messages for the user.
struct NotesNews {
    std::string problem{};    // why the file of the notes cannot be read, for a message
    std::string confirmed{};  // what is done
};
// Call every frame. Opens the notes of another planet when it is shown; shown: null if no planet is. A file that could not
// be read is tried again twice a second.
NotesNews advanceNotes(NotesController& notes, const DataSet* shown, double timeS);

// Returns what is done, for the log: where the note was saved. The Error says why nothing has changed.
planet::Result<std::string> execute(NotesController& notes, const ui::NoteCommand& command);

ui::NotesView notesViewOf(const NotesController& notes);

}  // namespace worldy
