// The point of the ground that commands of the camera are about. Pure function.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "ui/model/editor_view.h"

namespace worldy::ui {

// Returns the point under the pointer; else the middle of the selected chunk; else the point in the middle of the picture;
// none if that is sky or no planet is open. Metres from the planet's centre, on the drawn ground.
std::optional<glm::dvec3> pickedPoint(const EditorView& view);

}  // namespace worldy::ui
