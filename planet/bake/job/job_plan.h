// The plan of a job, which all ranks know before they begin: the sources, and the units that the bake falls into.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planet/bake/bake_settings.h"
#include "planet/bake/bake_tile.h"
#include "planet/bake/job/job_units.h"
#include "planet/bake/job/team.h"
#include "planet/format/source_record.h"
#include "planet/source/colour_source.h"

namespace planet {

struct JobPlan {
    const HeightSource& source;
    const ColourSource* colour = nullptr;  // null: no colours
    const BakeSettings& settings;
    BakeContext bake;
    std::optional<SourceRecord> record;
    TreeCount tree;
    int tileLevels = 0;
    int unitLevels = 0;
    std::vector<ChunkId> heightUnits;  // the roots; unit i is i
    ColourTree colourTree;
    std::vector<ColourUnit> colourUnits;  // unit i is heightUnits.size() + i

    std::uint64_t unitCount() const { return heightUnits.size() + colourUnits.size(); }
    std::uint64_t samplesTotal() const;
};

// source, colour, settings: must outlive the plan. The Error names the setting or the source.
Result<JobPlan> planJob(const HeightSource& source, const ColourSource* colour, const BakeSettings& settings);

// Returns a hash of everything that the finished units depend on.
std::uint64_t hashOf(const JobPlan& plan);

// Checks that all ranks run the same program with the same plan; all ranks call it together. program: its version and
// build. The Error names the rank that differs from rank 0, and in what.
Result<void> checkSamePlan(Team& team, const Result<JobPlan>& plan, const std::string& program);

}  // namespace planet
