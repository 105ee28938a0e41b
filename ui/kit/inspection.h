// Moves the camera to a place that an instrument has found. LOD is frozen as it was when the place was
// measured, so that the chunks measured are still drawn. One click goes back.
#pragma once

#include "ui/model/editor_view.h"
#include "ui/model/layout.h"

namespace worldy::ui {

// Returns the command that inspects a place, from 0.35 times the distance of the measured view. placeM:
// metres from the planet's centre.
InspectPlace inspectionOf(const planet::View& lodView, const planet::View& measured, const glm::dvec3& placeM,
                          double radiusM);

// Draws a small button "Go" that inspects a place and selects a chunk.
void inspectButton(const planet::View& lodView, const planet::View& measured, const planet::ChunkId& chunk,
                   const glm::dvec3& placeM, double radiusM, Commands& commands);

// Draws a window at the bottom of the viewport that says that LOD is frozen and offers to go back.
void inspectionNotice(const EditorView& view, const Rect& viewport, Commands& commands);

}  // namespace worldy::ui
