// One function object out of several lambdas, for std::visit.
#pragma once

namespace worldy {

template <class... Functions>
struct Overloaded : Functions... {
    using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;  // Clang 14 does not deduce aggregates without it

}  // namespace worldy
