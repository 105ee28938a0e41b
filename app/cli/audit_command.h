// worldy audit: whether thresholds mean what they say. Settles at each view, measures the true error of every
// drawn chunk (planet/measure/true_error.h) beside the bound of what is drawn, and counts what is over it.
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
    std::vector<planet::CameraPose> cameras;  // none, and no flight: auditPoses
    std::filesystem::path flight;             // of keys; empty: none
    FlightSampling sampling;
    ReportTo report;  // every chunk of every view
    int worst = 20;   // chunks that are listed, the worst over all views; >= 0
    PictureSize size;
    ViewSettings view;
};

struct AuditedView {
    planet::CameraPose pose;  // lifted above the ground where it was below
    bool settled = true;      // false: not everything was loaded in time
    std::uint64_t groundTriangles = 0;
    std::uint64_t skirtTriangles = 0;
    planet::TrueErrorReport report;
};

struct Audit {
    std::vector<AuditedView> views;
    double measuringS = 0;  // by the clock, on all cores
    std::uint64_t blocksRead = 0;

    std::uint32_t violations() const;
};

// True: no chunk was over its prediction.
planet::Result<bool> runAudit(const AuditOptions& options);

// The parts of it.
planet::Result<Audit> audit(const AuditOptions& options);
void printAudit(const AuditOptions& options, const Audit& audit);
nlohmann::ordered_json auditJson(const AuditOptions& options, const Audit& audit);

}  // namespace worldy
