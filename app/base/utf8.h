// Checks the encoding of text. Pure function, any thread.
#pragma once

#include <string_view>

namespace worldy {

// Returns true if the text is well-formed UTF-8, as TOML requires.
bool isUtf8(std::string_view text);

}  // namespace worldy
