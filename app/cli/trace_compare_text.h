// The comparison of the command worldy trace A B: tables and JSON (trace_compare.h).
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/trace/trace_compare_job.h"

namespace worldy {

// worst: frames to list, those with the most different nodes first, >= 0.
void printTraceComparison(const TraceCompared& compared, int worst);
nlohmann::ordered_json traceComparisonJson(const TraceCompared& compared);

}  // namespace worldy
