// What happens in a frame of the window.
#pragma once

#include <deque>
#include <optional>

#include "app/camera_control.h"
#include "app/input.h"
#include "app/log.h"
#include "app/session.h"
#include "app/settings.h"
#include "app/window.h"
#include "planet/gl/render_target.h"
#include "ui/frame_stats.h"
#include "ui/log_panel.h"

namespace worldy {

// Where the user is and looks, and what the last frame did. Plain state; owns no window and no planet.
struct Editor {
    Settings settings;
    std::optional<Camera> camera;  // once a planet is open
    double speedFactor = 1;
    bool lodFrozen = false;
    planet::View lodView;  // follows the camera but while frozen
    PointerInput pointer;  // of the last frame's picture
    ui::FrameStats stats;
    std::optional<planet::gl::RenderTarget> target;  // as large as the viewport
    std::deque<ui::LogLine> logLines;
    ui::LogPanelState logPanel;
};

void runFrame(const Window& window, Session& session, Editor& editor, Log& log, double secondsSinceLast);

}  // namespace worldy
