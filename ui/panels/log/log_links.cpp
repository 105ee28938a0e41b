#include "ui/panels/log/log_links.h"

namespace worldy::ui {

namespace {

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

// Returns true for characters that a chunk's name may contain.
bool isNameCharacter(char c) {
    return isDigit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '/';
}

// Returns true for characters that may follow a path; the end of the text ends one too.
bool mayEndPath(char c) {
    constexpr std::string_view ends = " :,;)]}'\"";
    return ends.find(c) != std::string_view::npos;
}

bool exists(std::string_view path) {
    std::error_code status;
    return std::filesystem::exists(std::filesystem::path(path), status);
}

// Returns the first square that the text names, of the tiles or of the chunks.
std::optional<planet::ChunkId> squareNamedIn(std::string_view text, bool colourTile) {
    std::size_t at = 0;
    while (at < text.size()) {
        if (!isNameCharacter(text[at])) {
            ++at;
            continue;
        }
        std::size_t end = at;
        while (end < text.size() && isNameCharacter(text[end])) ++end;
        const bool isTile = text.substr(0, at).ends_with("colour tile ");
        const auto id = planet::chunkIdFromString(text.substr(at, end - at));
        if (id && isTile == colourTile) return id;
        at = end;
    }
    return std::nullopt;
}

}  // namespace

std::optional<planet::ChunkId> chunkNamedIn(std::string_view text) {
    return squareNamedIn(text, false);
}

std::optional<planet::ChunkId> colourTileNamedIn(std::string_view text) {
    return squareNamedIn(text, true);
}

std::optional<std::filesystem::path> fileNamedIn(std::string_view text) {
    for (std::size_t start = text.find('/'); start != std::string_view::npos;
         start = text.find('/', start + 1)) {
        // An absolute path starts at the beginning of a word.
        if (start > 0 && !mayEndPath(text[start - 1]) && text[start - 1] != '(' && text[start - 1] != '[')
            continue;
        for (std::size_t end = text.size(); end > start + 1; --end) {
            if (end < text.size() && !mayEndPath(text[end])) continue;
            const std::string_view path = text.substr(start, end - start);
            if (exists(path)) return std::filesystem::path(path);
        }
    }
    return std::nullopt;
}

}  // namespace worldy::ui
