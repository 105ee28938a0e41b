// Combines several lambdas into one function object for std::visit.
#pragma once

namespace worldy {

template <class... Functions>
struct Overloaded : Functions... {
    using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;  // Clang 14 does not deduce aggregates without this

}  // namespace worldy
