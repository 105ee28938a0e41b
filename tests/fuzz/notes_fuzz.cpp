// Fuzzes files of notes: notes that are read lie on a planet, and are written and read again as they are.
#include <cmath>

#include "app/notes/notebook.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using fuzz::require;
    const auto notes = worldy::notesFromText(fuzz::textOf(data, size), "fuzzed.toml");
    if (!fuzz::isRead(notes)) return 0;
    for (const worldy::Note& note : *notes) {
        require(note.id > 0, "a note has a number");
        require(!note.text.empty() && note.text.size() <= worldy::longestNoteBytes, "a note has a text");
        require(std::abs(note.latitudeDeg) <= 90 && std::abs(note.camera.pitchDeg) <= 90,
                "angles are in range");
        require(std::isfinite(note.heightM) && std::isfinite(note.camera.altitudeM), "heights are finite");
        require(worldy::firstWords(note, 24).size() <= 24 * 4 + 3, "words of a pin are short");
    }
    const std::string text = worldy::notesText(*notes);
    const auto again = worldy::notesFromText(text, "written.toml");
    require(again.has_value(), "written notes are read");
    require(worldy::notesText(*again) == text, "notes are the same after reading");
    return 0;
}
