// Reads sources on threads of their own, so that no frame waits for a file.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/base/job.h"
#include "app/data/leaf_depths.h"
#include "planet/format/chunk_file.h"
#include "planet/source/height_source.h"
#include "planet/source/source_layers.h"

namespace worldy {

using SharedLayers = std::shared_ptr<const planet::SourceLayers>;

// Opens a source for its layers. A broken file is left out and listed, so that the other layers can be seen.
class SourceJob : public Job<planet::Result<SharedLayers>> {
public:
    SourceJob(std::filesystem::path source, planet::HeightSourceSettings settings);
};

// The readings of a place, the top layer first, or why there are none.
struct PlaceAnswer {
    std::vector<planet::SourceReading> readings{};
    std::string problem{};
};
// Asks layers about places. A cancelled job answers fewer places than it was asked about.
class PlacesJob : public Job<std::vector<PlaceAnswer>> {
public:
    PlacesJob(SharedLayers layers, std::vector<planet::Geographic> places);
};

class LeafDepthsJob : public Job<planet::Result<LeafDepths>> {
public:
    explicit LeafDepthsJob(planet::ChunkFile file);
};

}  // namespace worldy
