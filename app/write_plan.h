// The files that each command reads and writes, as its options name them (app/write_check.h).
#pragma once

#include "app/app.h"
#include "app/audit_command.h"
#include "app/bake_command.h"
#include "app/bench_command.h"
#include "app/compare_command.h"
#include "app/costs_command.h"
#include "app/cracks_command.h"
#include "app/fly_command.h"
#include "app/layer_materials.h"
#include "app/pops_command.h"
#include "app/replay_command.h"
#include "app/shot_command.h"
#include "app/sweep_command.h"
#include "app/write_check.h"

namespace worldy {

CommandFiles filesOf(const AppOptions& options);
CommandFiles filesOf(const AuditOptions& options);
CommandFiles filesOf(const BakeOptions& options);
CommandFiles filesOf(const BenchOptions& options);
CommandFiles filesOf(const CompareOptions& options);
CommandFiles filesOf(const CostsOptions& options);
CommandFiles filesOf(const CracksOptions& options);
CommandFiles filesOf(const FlyOptions& options);
CommandFiles filesOf(const MakeLayersOptions& options);
CommandFiles filesOf(const PopsOptions& options);
// Without the chunk file of the recording, which is known once that is read.
CommandFiles filesOf(const ReplayOptions& options);
CommandFiles filesOf(const ShotOptions& options);
CommandFiles filesOf(const SweepOptions& options);

// Adds the files that the texts name.
void addInputs(CommandFiles& files, const ViewTexts& texts);

}  // namespace worldy
