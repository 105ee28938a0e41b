// Converts the settings that users edit into the settings of the library. Pure functions, any thread.
#pragma once

#include <optional>

#include "app/settings/view_settings.h"
#include "planet/gl/draw/render_settings.h"
#include "planet/planet.h"

namespace worldy {

planet::LodSettings lodSettingsOf(const ViewSettings& settings);

// Enables colour tiles only if they are visible.
planet::TileSettings colourSettingsOf(const ViewSettings& settings);

// Enables normal tiles only if the ground is lit. Without light only texture layers use normals, and the
// slopes of the mesh are good enough for them.
planet::TileSettings normalSettingsOf(const ViewSettings& settings);

// A given time overrides the one in the settings. software: the CPU draws, or nothing is drawn; normals that
// are Automatic are off then.
planet::PagingSettings pagingSettingsOf(const ViewSettings& settings, bool paused = false,
                                        std::optional<planet::PagingTime> time = std::nullopt,
                                        bool software = true);

planet::gl::RenderSettings renderSettingsOf(const ViewSettings& settings, const planet::View& view,
                                            const planet::ChunkTree& tree);

}  // namespace worldy
