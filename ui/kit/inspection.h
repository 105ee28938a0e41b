// Going to a place that an instrument has found: LOD is frozen as it was chosen when the place was measured,
// so that what was found there is still drawn, and one click leads back.
#pragma once

#include "ui/model/editor_view.h"
#include "ui/model/layout.h"

namespace worldy::ui {

// Asks to inspect a place of a measurement, from 0.35 of the distance that the measured view had.
// placeM: metres from the planet's centre.
InspectPlace inspectionOf(const planet::View& lodView, const planet::View& measured, const glm::dvec3& placeM,
                          double radiusM);

// A small button "Go" that inspects a place and selects a chunk.
void inspectButton(const planet::View& lodView, const planet::View& measured, const planet::ChunkId& chunk,
                   const glm::dvec3& placeM, double radiusM, Commands& commands);

// A window at the bottom of the viewport that says that LOD is frozen, and offers the way back.
void inspectionNotice(const EditorView& view, const Rect& viewport, Commands& commands);

}  // namespace worldy::ui
