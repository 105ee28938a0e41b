// Texts and JSON that the tables and reports of `worldy trace` share.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "planet/trace/trace_what_if.h"

namespace worldy {

// Returns a node's name; the number if nothing describes the ids.
std::string tracedNodeText(const std::optional<planet::TraceDescription>& description, std::uint64_t id);
// Returns "1.50"; "-" for an error that is not known.
std::string tracedPxText(double px);
// Returns null for what is not known, which JSON cannot represent as a number.
nlohmann::ordered_json tracedNumberJson(double value);
nlohmann::ordered_json traceTotalsJson(const planet::TraceSelectionTotals& totals,
                                       const std::optional<planet::TraceDescription>& description);

}  // namespace worldy
