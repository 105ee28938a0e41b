#define LOD_TRACE_IMPLEMENTATION
#include "planet/trace/lod_trace.h"
