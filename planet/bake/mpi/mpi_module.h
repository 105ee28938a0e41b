// The module worldy_mpi.so, which is built with -DWORLDY_MPI=ON and holds all that knows MPI. A program loads it only when it
// was started as one of several ranks, so nothing else needs MPI to be installed.
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

#include "planet/bake/job/ranks.h"

namespace planet {

// The module exports one object of this type, under the name planetMpiModule.
struct MpiModule {
    std::string_view version;  // of the program that it belongs to
    std::size_t messageBytes = sizeof(RankMessage);
    // Starts MPI, once in a process, from the thread that will use it. Its end ends MPI.
    std::unique_ptr<Ranks> (*start)() = nullptr;
};

}  // namespace planet
