// One function object out of several lambdas, for std::visit.
#pragma once

namespace worldy {

template <class... Functions>
struct Overloaded : Functions... {
    using Functions::operator()...;
};

}  // namespace worldy
