// Queues input events in order and hands them out frame by frame. Dear ImGui 1.86 only sees which keys and
// buttons are down when a frame begins, so a key pressed and released between two frames would be lost. No
// GLFW calls; one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <glm/vec2.hpp>
#include <unordered_map>
#include <vector>

namespace worldy {

enum class InputKind : std::uint8_t { KeyDown, KeyRepeat, KeyUp, Text, ButtonDown, ButtonUp };

struct InputEvent {
    InputKind kind = InputKind::KeyDown;
    int code = 0;  // GLFW's key or mouse button; for Text the character
    int scancode = 0;
    int modifiers = 0;         // GLFW's
    glm::dvec2 pointer{0, 0};  // for a button: the pointer's position in window coordinates
    double atS = 0;            // for a key or button: time of the event, seconds on any clock
};

class InputQueue {
public:
    // Keyboards do not repeat a key within this time after the press.
    static constexpr double leastHoldS = 0.1;

    // GLFW reports a key released and pressed again within 20 ms as a repeat, without the release. So a
    // repeat within leastHoldS of the press is added as a release and a press.
    void add(const InputEvent& event);
    bool empty() const { return waiting_.empty(); }

    // Returns the events of the next frame, oldest first; the others wait. Each key or button changes at most
    // once per frame. A frame ends after a key that acts instead of writing (Enter, an arrow, a key held with
    // Ctrl), so that its effect precedes what is typed after it. The same holds between keys and mouse
    // buttons. A modifier released after a key press is released in the next frame. While a text field is
    // edited, keys that write a character do not end a frame, so that typing does not lag in slow frames: the
    // field reads characters, not keys.
    std::vector<InputEvent> takeFrame(bool textFieldIsEdited = false);
    std::size_t size() const { return waiting_.size(); }

private:
    std::deque<InputEvent> waiting_;
    std::unordered_map<int, double> downAtS_;  // of the held keys
};

}  // namespace worldy
