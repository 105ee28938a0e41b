// The notes of one planet, and the TOML file in which they are kept beside the planet's file:
//
//     format = 1
//
//     [[note]]
//     id = 1
//     text = "The ridge pops here"
//     about = "view"
//     created = "2026-11-26 16:50"
//     latitude_deg = 46.4
//     longitude_deg = 6.9
//     height_m = 2400.5            # above the planet's radius
//     camera_latitude_deg = 46.2   # the view in which it was written
//     camera_longitude_deg = 6.8
//     camera_altitude_m = 6000
//     camera_heading_deg = 10
//     camera_pitch_deg = -20
//     chunk = "y_pos/4/6/13"       # optional
//     measurement = "0.8 px"       # optional
//
// A file that cannot be read is never overwritten. Until it is mended, notes are kept in a second file beside it,
// "planet.notes.session.toml", which joins the first one as soon as that can be read. One thread.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/notes/note.h"
#include "planet/base/result.h"

namespace worldy {

struct Notebook {
    std::filesystem::path file;      // empty: there is no planet to write about
    std::filesystem::path writesTo;  // file, or the second file while file cannot be read
    std::vector<Note> notes{};
    std::string
        problem{};  // why file cannot be read, with the line and what is right; empty: it can, or is missing
    std::string keptText{};    // what writesTo held when it was read or written last
    std::string brokenText{};  // what file held when it could not be read
};

// Returns the file of the notes of a planet: "planet.notes.toml" beside "planet.chk" or beside its source, "planet.tif";
// in configFolder()/notes if the source has no folder of its own that can be written: generated terrain, the data that
// comes with Worldy, or a bake in the cache. source: what the user opened; chunkFile: what is drawn.
std::filesystem::path notesFileOf(const std::filesystem::path& source,
                                  const std::filesystem::path& chunkFile);

// Opens the notes. A missing file has none.
Notebook openNotebook(const std::filesystem::path& file);

// Change the notes and write them atomically. On an Error nothing has changed. If another program has changed the file,
// it is read again first, so that its notes are kept.
planet::Result<std::uint64_t> addNote(Notebook& notebook, Note note);
planet::Result<void> editNote(Notebook& notebook, std::uint64_t id, std::string_view text);
planet::Result<void> deleteNote(Notebook& notebook, std::uint64_t id);

// Tries a file that could not be read again, if it has changed. Returns true if it is mended: the notes of the second
// file are then in it.
bool mendNotebook(Notebook& notebook);

// Returns the text of the file, and reads such a text. file: for errors, which name the line and what is right.
std::string notesText(const std::vector<Note>& notes);
planet::Result<std::vector<Note>> notesFromText(std::string_view text, const std::filesystem::path& file);

}  // namespace worldy
