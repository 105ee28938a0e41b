// Checks the encoding of text, and replaces what cannot be drawn. Pure functions, any thread.
#pragma once

#include <string>
#include <string_view>

namespace worldy {

// Returns true if the text is well-formed UTF-8, as TOML requires.
bool isUtf8(std::string_view text);

// Returns a text in ASCII that reads alike: "Zurich" for "Zürich", "tau" for "τ". Each other letter, and each byte that is
// not UTF-8, becomes a question mark.
std::string asciiOf(std::string_view text);

}  // namespace worldy
