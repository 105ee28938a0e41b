#include "app/editor/notes_controller.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <string>
#include <utility>
#include <variant>

#include "app/base/new_file.h"
#include "ui/model/docking.h"
#include "ui/model/note_subjects.h"

namespace worldy {

namespace {

using planet::Result;

constexpr double lookedEveryS = 0.5;

std::string whereKept(const NotesController& notes) {
    return notes.book.writesTo.string();
}

Result<std::string> add(NotesController& notes, Note note) {
    note.created = fmt::format("{:%Y-%m-%d %H:%M}", localTimeNow());
    const Result<std::uint64_t> id = addNote(notes.book, std::move(note));
    if (!id) return tl::unexpected(id.error());
    notes.open = *id;
    ++notes.opened;
    return fmt::format("Note saved in {}", whereKept(notes));
}

void openNotes(NotesController& notes, const std::filesystem::path& file, Notices& notices) {
    notes.book = openNotebook(file);
    notes.open.reset();
    notes.covered.clear();
    if (notes.book.problem.empty()) return;
    tellError(notices, {"The notes cannot be read", notes.book.problem,
                        fmt::format("The file is left as it is. Until it is mended, notes are kept in {}.",
                                    whereKept(notes))});
}

// Returns what is done and where the note was saved.
struct Executor {
    NotesController& notes;

    Result<std::string> operator()(const ui::AddNote& command) const { return add(notes, command.note); }
    Result<std::string> operator()(const ui::EditNote& command) const {
        return editNote(notes.book, command.id, command.text).map([&] {
            return fmt::format("Note changed in {}", whereKept(notes));
        });
    }
    Result<std::string> operator()(const ui::DeleteNote& command) const {
        return deleteNote(notes.book, command.id).map([&] {
            if (notes.open == command.id) notes.open.reset();
            return fmt::format("Note deleted from {}", whereKept(notes));
        });
    }
    Result<std::string> operator()(const ui::OpenNote& command) const {
        notes.open = command.id;
        ++notes.opened;
        return std::string();
    }
};

}  // namespace

void advanceNotes(NotesController& notes, const OpenPlanet* shown, double timeS, Notices& notices) {
    const std::filesystem::path chunkFile = shown ? shown->data.chunkFile : std::filesystem::path();
    if (chunkFile != notes.chunkFile) {
        notes.chunkFile = chunkFile;
        // Another bake of the same source has the same notes.
        const std::filesystem::path file =
            shown ? notesFileOf(shown->data.source, chunkFile) : std::filesystem::path();
        if (file != notes.book.file) openNotes(notes, file, notices);
    }
    if (notes.book.problem.empty() || timeS < notes.lookedAtS + lookedEveryS) return;
    notes.lookedAtS = timeS;
    if (mendNotebook(notes.book))
        confirm(notices, fmt::format("Notes: {} can be read again", notes.book.file.string()));
}

void coverPins(NotesController& notes, const planet::Planet& planet, const planet::View& view,
               double exaggeration) {
    constexpr std::size_t mostPins = 32;  // about 1 ms
    const planet::ChunkTree& tree = planet.tree();
    const std::vector<Note>& all = notes.book.notes;
    std::size_t looked = 0;
    for (std::size_t i = 0; i < all.size() && looked < mostPins; ++i) {
        const Note& note = all[notes.nextPin++ % all.size()];
        std::erase(notes.covered, note.id);
        const glm::dvec3 placeM = ui::placeOfNote(note, tree.shape.radiusM, exaggeration);
        if (!ui::pinInPicture(view, placeM, tree.shape.radiusM)) continue;
        ++looked;
        if (ui::isCoveredPin(tree, planet.selection().draw, view, placeM)) notes.covered.push_back(note.id);
    }
}

void execute(NotesController& notes, const ui::NoteCommand& command, Workspace& workspace, Notices& notices) {
    const Result<std::string> done = std::visit(Executor{notes}, command);
    if (!done) return tellError(notices, {"The note was not saved", done.error().message, ""});
    if (std::holds_alternative<ui::OpenNote>(command)) return ui::showPanel(PanelId::Notes, workspace);
    confirm(notices, *done);
}

ui::NotesView notesViewOf(const NotesController& notes) {
    return {.notes = notes.book.notes,
            .file = notes.book.writesTo,
            .problem = notes.book.problem,
            .open = notes.open,
            .opened = notes.opened,
            .covered = notes.covered};
}

}  // namespace worldy
