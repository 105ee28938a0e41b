// The rows of the palette (Ctrl+K): entries ranked by how well they match the typed text. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ui/model/text_filter.h"

namespace worldy::ui {

enum class PaletteKind : std::uint8_t {
    Command,
    Panel,
    Setting,
    Bookmark,
    Flight,
    Preset,
    File,
    Chunk,
    Place
};
// Returns the word on screen: "command".
const char* paletteKindName(PaletteKind kind);

struct PaletteEntry {
    PaletteKind kind = PaletteKind::Command;
    std::string title{};   // "Tolerance τ"
    std::string also{};    // searched but not shown: "lod.tau_px"
    std::string detail{};  // shown but not searched: "2 px"
    std::string key{};     // "F2"
    std::string help{};    // what it does, sentences
    std::string whyNot{};  // why it cannot be chosen; empty: it can
    bool isTyped = false;  // it is what was typed, so it always matches and is the first
};

// Returns a name that tells entries apart: "setting/lod.tau_px".
std::string nameOf(const PaletteEntry& entry);

struct PaletteRow {
    std::size_t entry = 0;
    std::vector<TextPart> matched;  // in the title
};

// Returns the rows, best first: by the score of the match of the title or of the other text, then recent
// entries, then in the order of the entries. An empty query lists all, the recent ones first. recent: names,
// newest first.
std::vector<PaletteRow> paletteRows(std::string_view query, std::span<const PaletteEntry> entries,
                                    std::span<const std::string> recent);

inline constexpr std::size_t mostRecent = 10;
// Puts a name at the front of the recent ones.
void remember(std::vector<std::string>& recent, const std::string& name);

}  // namespace worldy::ui
