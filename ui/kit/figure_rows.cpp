#include "ui/kit/figure_rows.h"

#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

const ImVec4* colourOf(FigureMood mood) {
    switch (mood) {
        case FigureMood::Plain:
            break;
        case FigureMood::Good:
            return &palette().good;
        case FigureMood::Warning:
            return &palette().warning;
        case FigureMood::Bad:
            return &palette().bad;
    }
    return nullptr;
}

}  // namespace

void figureRows(std::span<const Figure> figures) {
    for (const Figure& figure : figures)
        valueRow(figure.name.c_str(), figure.value, figure.explanation.c_str(), colourOf(figure.mood));
}

}  // namespace worldy::ui
