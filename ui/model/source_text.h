// Texts about the layers of a source. Pure functions.
#pragma once

#include <string>

#include "planet/source/source_layers.h"
#include "ui/model/sources_view.h"

namespace worldy::ui {

const char* kindText(planet::LayerKind kind);  // "rasters"
const char* joinText(planet::LayerJoin join);  // "replace"

// Return "92.8 m" and "1.2 %"; empty for a layer without samples.
std::string spacingText(const planet::SourceLayer& layer, double radiusM);
std::string voidsText(const planet::SourceLayer& layer);

// Returns "700.0 m", or why the layer gives no height: "void", "not here".
std::string heightText(const planet::SourceReading& reading);
// Returns "mesa.tif 12, 40" with the column and the row; empty if no file holds the height.
std::string pixelText(const planet::SourceReading& reading);

// Returns what is known about the sources while they are not read, and what to do.
std::string stateText(const SourcesView& sources);

// Returns the description of an edited layer: that of the layer of the same name, or of as many layers of that name
// further up as there are such layers under this one. Null if the layer was not read. edited: in the order of the edit.
const planet::SourceLayer* descriptionOf(const SourcesView& sources, std::size_t edited);

}  // namespace worldy::ui
