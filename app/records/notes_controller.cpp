#include "app/records/notes_controller.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <utility>

#include "app/base/new_file.h"

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

NotesNews advanceNotes(NotesController& notes, const DataSet* shown, double timeS) {
    NotesNews news;
    const std::filesystem::path chunkFile = shown ? shown->chunkFile : std::filesystem::path();
    if (chunkFile != notes.chunkFile) {
        notes.chunkFile = chunkFile;
        const std::filesystem::path file =
            shown ? notesFileOf(shown->source, chunkFile) : std::filesystem::path();
        // Another bake of the same source has the same notes.
        if (file != notes.book.file) {
            notes.book = openNotebook(file);
            notes.open.reset();
            news.problem = notes.book.problem;
        }
    }
    if (notes.book.problem.empty() || timeS < notes.lookedAtS + lookedEveryS) return news;
    notes.lookedAtS = timeS;
    if (mendNotebook(notes.book))
        news.confirmed = fmt::format("Notes: {} can be read again", notes.book.file.string());
    return news;
}

Result<std::string> execute(NotesController& notes, const ui::NoteCommand& command) {
    return std::visit(Executor{notes}, command);
}

ui::NotesView notesViewOf(const NotesController& notes) {
    return {.notes = notes.book.notes,
            .file = notes.book.writesTo,
            .problem = notes.book.problem,
            .open = notes.open,
            .opened = notes.opened};
}

}  // namespace worldy
