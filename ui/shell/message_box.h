// Messages in front of everything else: an error, which stays until it is closed, and a
// confirmation, which goes by itself.
#pragma once

#include <string>

#include "ui/model/commands.h"
#include "ui/model/layout.h"

namespace worldy::ui {

struct Message {
    std::string title;        // "broken.chk cannot be opened"; empty: no message
    std::string text;         // what is wrong
    std::string advice;       // what to do; may be empty
    bool offersOpen = false;  // has a button that asks for another file
    bool opening = true;      // until it is first drawn
};

struct Confirmation {
    std::string text;   // "Preset ridge saved"; empty: none
    double untilS = 0;  // as EditorView::timeS
};

// Call every frame. A modal window while there is a message; clears the message when it is closed, by its
// buttons, by Enter, or by whatever closes popups.
void messageBox(Message& message, Commands& commands);

// A line at the top of the viewport until its time is over; then clears it.
void confirmationLine(Confirmation& confirmation, double timeS, const Rect& viewport);

}  // namespace worldy::ui
