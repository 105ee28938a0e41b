// The files that each command reads and writes, according to its options (app/data/write_check.h).
#pragma once

#include "app/bench/bench_command.h"
#include "app/cli/app.h"
#include "app/cli/atlas_command.h"
#include "app/cli/audit_command.h"
#include "app/cli/bake_command.h"
#include "app/cli/compare_command.h"
#include "app/cli/costs_command.h"
#include "app/cli/cracks_command.h"
#include "app/cli/fly_command.h"
#include "app/cli/pops_command.h"
#include "app/cli/prefetch_command.h"
#include "app/cli/replay_command.h"
#include "app/cli/schedule_command.h"
#include "app/cli/shot_command.h"
#include "app/cli/suggest_command.h"
#include "app/cli/sweep_command.h"
#include "app/cli/trace_command.h"
#include "app/data/layer_materials.h"
#include "app/data/write_check.h"
#include "app/settings/view_options.h"

namespace worldy {

CommandFiles filesOf(const AppOptions& options);
CommandFiles filesOf(const AtlasOptions& options);
CommandFiles filesOf(const AuditOptions& options);
CommandFiles filesOf(const BakeOptions& options);
CommandFiles filesOf(const BenchOptions& options);
CommandFiles filesOf(const CompareOptions& options);
CommandFiles filesOf(const CostsOptions& options);
CommandFiles filesOf(const ScheduleOptions& options);
CommandFiles filesOf(const CracksOptions& options);
CommandFiles filesOf(const FlyOptions& options);
CommandFiles filesOf(const MakeLayersOptions& options);
CommandFiles filesOf(const PopsOptions& options);
CommandFiles filesOf(const PrefetchOptions& options);
// Returns the files without the recording's chunk file, which is known only after the recording is read.
CommandFiles filesOf(const ReplayOptions& options);
CommandFiles filesOf(const ShotOptions& options);
CommandFiles filesOf(const SuggestOptions& options);
CommandFiles filesOf(const SweepOptions& options);
CommandFiles filesOf(const TraceCommandOptions& options);

// Adds the files that the texts name.
void addInputs(CommandFiles& files, const ViewTexts& texts);

}  // namespace worldy
