#include "app/window/input_queue.h"

#include <GLFW/glfw3.h>

#include <algorithm>

namespace worldy {

namespace {

bool isModifier(int key) {
    return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
}

bool isButton(const InputEvent& event) {
    return event.kind == InputKind::ButtonDown || event.kind == InputKind::ButtonUp;
}

// GLFW's codes of keys that write nothing start at Escape.
bool actsAlone(const InputEvent& event) {
    if (event.kind != InputKind::KeyDown || isModifier(event.code)) return false;
    return event.code >= GLFW_KEY_ESCAPE || (event.modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT)) != 0;
}

bool changesState(const InputEvent& event) {
    return event.kind != InputKind::Text && event.kind != InputKind::KeyRepeat;
}

bool writesOnly(const InputEvent& event) {
    return !isButton(event) && event.code < GLFW_KEY_ESCAPE && !actsAlone(event);
}

bool endsFrame(const std::vector<InputEvent>& frame, const InputEvent& next, bool textFieldIsEdited) {
    return std::any_of(frame.begin(), frame.end(), [&](const InputEvent& before) {
        const bool sameKeyOrButton = changesState(before) && changesState(next) &&
                                     isButton(before) == isButton(next) && before.code == next.code;
        const bool typed = textFieldIsEdited && writesOnly(before) && writesOnly(next);
        if (sameKeyOrButton && !typed) return true;
        const bool begins = next.kind == InputKind::KeyDown || next.kind == InputKind::Text ||
                            next.kind == InputKind::ButtonDown;
        if (actsAlone(before) && begins) return true;
        // A key or button acts with the modifiers held at the end of its frame.
        const bool acts = isButton(before) || (before.kind == InputKind::KeyDown && !isModifier(before.code));
        if (acts && next.kind == InputKind::KeyUp && isModifier(next.code)) return true;
        // Ctrl may be pressed in the frame of a click, but typed text must precede the click.
        return isButton(before) ? next.kind == InputKind::KeyDown || next.kind == InputKind::Text
                                : before.kind == InputKind::Text && isButton(next);
    });
}

}  // namespace

void InputQueue::add(const InputEvent& event) {
    if (event.kind == InputKind::KeyUp) downAtS_.erase(event.code);
    if (event.kind == InputKind::KeyDown) downAtS_[event.code] = event.atS;
    const auto down = downAtS_.find(event.code);
    const bool isTap =
        event.kind == InputKind::KeyRepeat && down != downAtS_.end() && event.atS - down->second < leastHoldS;
    if (!isTap) return waiting_.push_back(event);
    for (const InputKind kind : {InputKind::KeyUp, InputKind::KeyDown}) {
        waiting_.push_back(event);
        waiting_.back().kind = kind;
    }
    down->second = event.atS;
}

std::vector<InputEvent> InputQueue::takeFrame(bool textFieldIsEdited) {
    std::vector<InputEvent> frame;
    while (!waiting_.empty() && !endsFrame(frame, waiting_.front(), textFieldIsEdited)) {
        frame.push_back(waiting_.front());
        waiting_.pop_front();
    }
    return frame;
}

}  // namespace worldy
