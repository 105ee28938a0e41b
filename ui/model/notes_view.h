// The notes on the shown planet.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "app/notes/note.h"

namespace worldy::ui {

struct NotesView {
    std::span<const Note> notes{};
    std::filesystem::path file{};              // in which they are kept; empty if no planet is open
    std::string problem{};                     // why another file is used; empty: none is
    std::optional<std::uint64_t> open{};       // the note that the panel shows
    std::uint64_t opened = 0;                  // grows whenever a note is opened from elsewhere
    std::span<const std::uint64_t> covered{};  // ids of the notes whose pins lie behind the drawn ground
};

}  // namespace worldy::ui
