// Input events in the order in which they came, handed out frame by frame: Dear ImGui 1.86 sees only which
// keys and buttons are down when a frame begins, so a key that is pressed and released between two frames
// would be lost. No GLFW calls; one thread.
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
    int code = 0;  // GLFW's key or mouse button; of Text the character
    int scancode = 0;
    int modifiers = 0;         // GLFW's
    glm::dvec2 pointer{0, 0};  // of a button: where the pointer was, in the window's coordinates
    double atS = 0;            // of a key: when it came, seconds on any clock
};

class InputQueue {
public:
    // No keyboard repeats a key as soon as this after it went down.
    static constexpr double leastHoldS = 0.1;

    // GLFW takes a key that goes up and down again within 20 ms for one that repeats, and leaves out its
    // release: a repeat within leastHoldS of the press is added as a release and a press.
    void add(const InputEvent& event);
    bool empty() const { return waiting_.empty(); }

    // Returns the events of the next frame, oldest first; the others wait. A key or a button changes once a
    // frame. A frame ends after a key that acts rather than writes (Enter, an arrow, one held with Ctrl), so
    // that what is typed after it comes after what it does, and likewise between keys and mouse buttons. A
    // modifier that is released after a key was pressed is released in the next frame. While a text field is
    // edited, keys that write a character need no frame of their own, so that typing never lags behind slow
    // frames: the field reads the characters, not the keys.
    std::vector<InputEvent> takeFrame(bool textFieldIsEdited = false);
    std::size_t size() const { return waiting_.size(); }

private:
    std::deque<InputEvent> waiting_;
    std::unordered_map<int, double> downAtS_;  // of the keys that are held
};

}  // namespace worldy
