// The command worldy audit: checks that tolerances hold. It settles at each view, measures the true error of
// every drawn chunk (planet/measure/true_error.h), compares it with the drawn bound, and counts violations.
// Needs no GL.
#pragma once

#include <filesystem>
#include <vector>

#include "app/base/report.h"
#include "app/flight/flight_path.h"
#include "app/settings/camera_text.h"
#include "app/settings/view_settings.h"
#include "planet/measure/true_error.h"
#include "planet/select/lod_select.h"

namespace worldy {

struct AuditOptions {
    std::filesystem::path file;
    std::vector<planet::CameraPose> cameras;  // empty without a flight: auditPoses()
    std::filesystem::path flight;             // camera keys; empty: none
    FlightSampling sampling;
    ReportTo report;  // contains every chunk of every view
    int worst = 20;   // chunks to list, the worst over all views; >= 0
    PictureSize size;
    ViewSettings view;
};

struct AuditedView {
    planet::CameraPose pose;  // lifted if it was below the ground
    bool settled = true;      // false: loading timed out
    std::uint64_t groundTriangles = 0;
    std::uint64_t skirtTriangles = 0;
    planet::TrueErrorReport report;
};

struct Audit {
    std::vector<AuditedView> views;
    double measuringS = 0;  // wall time, with all cores
    std::uint64_t blocksRead = 0;

    std::uint32_t violations() const;
};

// Returns true if no chunk exceeded its bound.
planet::Result<bool> runAudit(const AuditOptions& options);

// The parts of runAudit().
planet::Result<Audit> audit(const AuditOptions& options);
void printAudit(const AuditOptions& options, const Audit& audit);
nlohmann::ordered_json auditJson(const AuditOptions& options, const Audit& audit);

}  // namespace worldy
