// The states of a block: the four children of a chunk, or of a tile of colours or normals. The parent's node
// keeps the state, from when it becomes resident until it is dropped.
//
//                .-------- withdrawn --------.
//                v                           |
//     begin -> Absent --- asked for ---> Requested --- read, and as it should be ---> Resident
//       |       ^ ^ ^                     |    |                                          |
//       |       | | |      reading failed |    | failed for good                          |
//       |       | | |                     v    |                                          |
//       |       | | '- time has come - AwaitingRetry                                      |
//       |       | |                            v                                          |
//       |       | '------ told to ---------- Failed                                       |
//       |       '------------------------ dropped, to make room --------------------------'
//       '----> None, where the file has nothing finer
//
// A block that had failed before its node was dropped goes from Absent back to AwaitingRetry or Failed as
// soon as the node is there again. A Requested block is queued, being read, or read and waiting for its
// upload; the queue and the pager know which. A block of colours that has failed for good is Resident as a
// checker pattern (tile_tree.h).
#pragma once

#include <cassert>
#include <cstdint>

namespace planet {

enum class ChildrenState : std::uint8_t {
    None,           // a leaf
    Absent,         // in the file, not asked for
    Requested,      // queued or being read
    Resident,       // all four are nodes
    AwaitingRetry,  // could not be read; may be asked for again after a while
    Failed,         // could not be read; not asked for again until told to
};

// Returns whether the diagram has such a step.
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

// Changes the state of a node; nothing else does.
inline void changeState(ChildrenState& state, ChildrenState to) {
    assert(isStep(state, to));
    state = to;
}

}  // namespace planet
