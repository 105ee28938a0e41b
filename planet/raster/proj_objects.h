// Owners of PROJ's objects. Internal to the library.
#pragma once

#include <proj.h>

#include <memory>

namespace planet {

struct ProjContextDestroyer {
    void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
struct ProjDestroyer {
    void operator()(PJ* pj) const { proj_destroy(pj); }
};
using ProjContextPtr = std::unique_ptr<PJ_CONTEXT, ProjContextDestroyer>;
using ProjPtr = std::unique_ptr<PJ, ProjDestroyer>;

// Makes a context that writes no messages and fetches nothing from a network. One thread at a time may use it and what
// is made in it.
inline ProjContextPtr makeProjContext() {
    ProjContextPtr context(proj_context_create());
    proj_log_func(context.get(), nullptr, [](void*, int, const char*) {});
    proj_context_set_enable_network(context.get(), 0);
    return context;
}

}  // namespace planet
