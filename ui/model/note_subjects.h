// Finds the subjects that a new note can have, and the places of the pins in a picture. Pure functions.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ui/model/editor_view.h"
#include "ui/model/layout.h"

namespace worldy::ui {

struct NoteSubject {
    std::string label;  // "this view"
    std::optional<Note>
        note;              // its place, view and figures, without a text; none: there is nothing to note yet
    std::string whyNot{};  // why there is none, a sentence
};
// Returns the subjects: this view, the selected chunk, and the measurements. Empty without a planet.
// exaggeration: of the drawn heights, > 0.
std::vector<NoteSubject> noteSubjects(const EditorView& view, double exaggeration);

// Returns the place in the middle of a view on the drawn ground, or the place below the camera if the view shows sky there.
// Metres from the planet's centre.
glm::dvec3 groundInMiddle(const planet::View& view, const planet::ChunkTree& tree,
                          std::span<const planet::DrawItem> drawn);

// Returns a note's place, metres from the planet's centre.
glm::dvec3 placeOfNote(const Note& note, double radiusM, double exaggeration);

// Returns where a place is in the picture, in its pixels from the top left; none if it is behind the camera, outside the
// picture or behind the horizon of a sphere below the place.
std::optional<glm::dvec2> pinInPicture(const planet::View& view, const glm::dvec3& placeM, double radiusM);

// Returns true if the drawn ground lies in front of a pin. drawn: the chunks that the picture shows, which are in the tree.
bool isCoveredPin(const planet::ChunkTree& tree, std::span<const planet::DrawItem> drawn,
                  const planet::View& view, const glm::dvec3& placeM);

}  // namespace worldy::ui
