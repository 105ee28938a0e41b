// Messages in front of everything else: an error, which stays until it is closed, and a confirmation, which
// disappears by itself.
#pragma once

#include <string>

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

// Call every frame. Shows a modal window while there is a message. Clears the message when it is closed by
// its buttons, by Enter, or by anything that closes popups.
void messageBox(Message& message, Commands& commands);

// Draws a line at the top of the viewport until untilS, then clears it.
void confirmationLine(Confirmation& confirmation, double timeS, const Rect& viewport);

}  // namespace worldy::ui
