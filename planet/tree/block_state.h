// The states of a block: the four children of a chunk, or of a tile of colours or normals. The parent's node
// stores the state while it is resident.
//
//                .-------- withdrawn --------.
//                v                           |
//     begin -> Absent --- requested ---> Requested --- read and valid ---------------> Resident
//       |       ^ ^ ^                     |    |                                          |
//       |       | | |      read failed    |    | failed for good                          |
//       |       | | |                     v    |                                          |
//       |       | | '- time has come - AwaitingRetry                                      |
//       |       | |                            v                                          |
//       |       | '------ by command ------- Failed                                       |
//       |       '------------------------ dropped, to make room --------------------------'
//       '----> None, if the file has nothing finer
//
// If a block failed before its parent's node was dropped, it changes from Absent back to AwaitingRetry or
// Failed as soon as the node is resident again. A Requested block is queued, being read, or waiting for its
// upload; the queue and the pager know which. A block of colours that has failed for good is Resident as a
// checker pattern (tile_tree.h).
#pragma once

#include <cassert>
#include <cstdint>

namespace planet {

enum class ChildrenState : std::uint8_t {
    None,           // a leaf
    Absent,         // in the file, not requested
    Requested,      // queued or being read
    Resident,       // all four are nodes
    AwaitingRetry,  // could not be read; requested again after a delay
    Failed,         // could not be read; not requested again until a command
};

// Returns whether the diagram has this transition.
constexpr bool isStep(ChildrenState from, ChildrenState to) {
    using enum ChildrenState;
    switch (from) {
        case None:
            return false;
        case Absent:
            return to == Requested || to == AwaitingRetry || to == Failed;
        case Requested:
            return to == Absent || to == Resident || to == AwaitingRetry || to == Failed;
        case Resident:
        case AwaitingRetry:
        case Failed:
            return to == Absent;
    }
    return false;
}

// Changes the state of a node. All changes go through this function.
inline void changeState(ChildrenState& state, ChildrenState to) {
    assert(isStep(state, to));
    state = to;
}

}  // namespace planet
