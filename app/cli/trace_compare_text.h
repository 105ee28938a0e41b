// The comparison of the command worldy trace A B: tables and JSON (trace_compare.h).
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "planet/trace/trace_compare.h"

namespace worldy {

// files: the names of A and B. worst: frames to list, those with the most different nodes first, >= 0.
void printTraceComparison(const std::array<std::string, 2>& files, const planet::TraceComparison& found,
                          int worst);
nlohmann::ordered_json traceComparisonJson(const std::array<std::string, 2>& files,
                                           const planet::TraceComparison& found);

}  // namespace worldy
