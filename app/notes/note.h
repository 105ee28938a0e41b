// A note that lies on the planet.
#pragma once

#include <cstdint>
#include <string>

#include "planet/sphere/view.h"

namespace worldy {

inline constexpr std::size_t longestNoteBytes = 4000;
inline constexpr std::size_t mostNotes = 10'000;

struct Note {
    std::uint64_t id = 0;       // in its file, from 1; 0: it is in none yet
    std::string text{};         // UTF-8, [1, longestNoteBytes] bytes
    std::string about{"view"};  // "view", "chunk" or what was measured: "true error"
    std::string created{};      // local time: "2026-11-26 16:50"
    // The place of its pin.
    double latitudeDeg = 0;       // [-90, 90]
    double longitudeDeg = 0;      // [-360, 360]
    double heightM = 0;           // above the planet's radius, without exaggeration
    planet::CameraPose camera{};  // the view in which it was written
    std::string chunk{};          // "y_pos/4/6/13"; empty: it is about no chunk
    std::string measurement{};    // the figures at that time as text; empty: none
};

// Returns the first words of a note on one line, at most about `letters` letters, with "..." if there are more.
std::string firstWords(const Note& note, std::size_t letters);

}  // namespace worldy
