// The notes of the shown planet. Main thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "app/notes/notebook.h"
#include "app/session/notices.h"
#include "app/session/session.h"
#include "app/settings/workspace.h"
#include "ui/model/commands.h"
#include "ui/model/notes_view.h"

namespace worldy {

struct NotesController {
    Notebook book{};
    std::filesystem::path chunkFile{};  // of the shown planet
    std::optional<std::uint64_t> open{};
    std::uint64_t opened = 0;              // grows whenever a note is opened from elsewhere than the list
    double lookedAtS = 0;                  // when a file that could not be read was looked at again
    std::vector<std::uint64_t> covered{};  // ids of the notes whose pins lie behind the drawn ground
    std::size_t nextPin = 0;               // index of the note whose pin is looked at next
};

// Call every frame. Opens the notes of another planet when it is shown; shown: null if no planet is. A file that could not
// be read is tried again twice a second. Messages say what is wrong with it.
void advanceNotes(NotesController& notes, const OpenPlanet* shown, double timeS, Notices& notices);

// Finds the pins in a picture that lie behind the drawn ground. Looks at some pins in each call, because each is a ray
// through the drawn chunks, and keeps what it found of the others.
void coverPins(NotesController& notes, const planet::Planet& planet, const planet::View& view,
               double exaggeration);

// workspace: the panel may be brought to the front.
void execute(NotesController& notes, const ui::NoteCommand& command, Workspace& workspace, Notices& notices);

ui::NotesView notesViewOf(const NotesController& notes);

}  // namespace worldy
