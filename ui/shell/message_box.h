// Messages in front of everything else: an error in a box, which stays until it is closed; a confirmation and alerts,
// which disappear by themselves.
#pragma once

#include <string>
#include <vector>

#include "app/base/log_lines.h"
#include "ui/model/commands.h"
#include "ui/model/layout.h"

namespace worldy::ui {

struct Message {
    std::string title;        // "broken.chk cannot be opened"; empty: no message
    std::string text;         // what is wrong
    std::string advice;       // what to do; may be empty
    bool offersOpen = false;  // has a button that opens another file
    bool opening = true;      // not drawn yet
};

struct Confirmation {
    std::string text;   // "Preset ridge saved"; empty: none
    double untilS = 0;  // in FramesView::timeS
};

// A warning or an error that no message box shows: one of the log, or why a request is refused.
struct Alert {
    LogLevel level = LogLevel::Warning;
    std::string text;
    int count = 1;      // how often it came since it is shown
    double untilS = 0;  // in FramesView::timeS
};

// Call every frame. Shows a modal window while there is a message. Clears the message when it is closed by
// its buttons, by Enter, or by anything that closes popups.
void messageBox(Message& message, Commands& commands);

// Draws a line at the top of the viewport until untilS, then clears it. Returns the line's lower edge, or the
// viewport's upper edge if there is none.
float confirmationLine(Confirmation& confirmation, double timeS, const Rect& viewport);

// Draws each alert as a box below top until its untilS or until it is clicked, then removes it. Boxes that would cover more
// than half of the viewport are left out; a line says how many.
void alertBoxes(std::vector<Alert>& alerts, double timeS, const Rect& viewport, float top);

}  // namespace worldy::ui
