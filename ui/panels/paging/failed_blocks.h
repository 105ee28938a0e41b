// The blocks that could not be read: why, how often they were tried, and when they are tried again.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planet/planet.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

// Those that have failed for good first, then those that are tried again, the soonest first.
void sortFailed(std::vector<planet::FailedBlock>& blocks);

// "for good", "in 1.25 s", "when wanted".
std::string retryText(const std::optional<double>& retryInS);

// Fills the room there is. blocks: as sortFailed leaves them, of heights and tiles alike.
void failedTable(const EditorView& view, const std::vector<planet::FailedBlock>& blocks, Commands& commands);

}  // namespace worldy::ui
