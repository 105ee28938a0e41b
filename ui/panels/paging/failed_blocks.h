// The table of blocks that could not be read: why, after how many attempts, and when they are retried.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planet/planet.h"
#include "ui/model/editor_view.h"
#include "ui/model/text_filter.h"

namespace worldy::ui {

// Sorts blocks that failed permanently first, then the others by the time of their next retry.
void sortFailed(std::vector<planet::FailedBlock>& blocks);

// Returns "never", "in 1.25 s" or "when needed".
std::string retryText(const std::optional<double>& retryInS);

// Draws the filter and the table in the remaining room. blocks: heights and tiles alike, sorted by sortFailed().
void failedTable(const EditorView& view, const std::vector<planet::FailedBlock>& blocks, TextFilter& filter,
                 Commands& commands);

}  // namespace worldy::ui
