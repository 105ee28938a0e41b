#include "ui/model/font_symbols.h"

#include <array>
#include <string_view>

namespace worldy::ui {

namespace {

bool fontHasGreek = false;

}  // namespace

void setFontHasGreek(bool hasGreek) {
    fontHasGreek = hasGreek;
}

const char* tauSymbol() {
    return fontHasGreek ? "\u03c4" : "tau";
}

const char* epsSymbol() {
    return fontHasGreek ? "\u03b5" : "eps";
}

std::string inFont(std::string text) {
    if (fontHasGreek) return text;
    constexpr std::array<std::array<std::string_view, 2>, 6> names = {{{"\u03b4", "delta_"},
                                                                       {"\u03b5", "eps"},
                                                                       {"\u03c4", "tau"},
                                                                       {"\u2192", "->"},
                                                                       {"\u2264", "<="},
                                                                       {"\u2265", ">="}}};
    for (const auto& [symbol, name] : names) {
        for (std::size_t at = text.find(symbol); at != std::string::npos; at = text.find(symbol, at))
            text.replace(at, symbol.size(), name);
    }
    return text;
}

}  // namespace worldy::ui
