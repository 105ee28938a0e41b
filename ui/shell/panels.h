// All panels behind one function; each has its own file.
#pragma once

#include "app/settings/panel_list.h"
#include "ui/model/editor_view.h"
#include "ui/panels/bake/bake_panel.h"
#include "ui/panels/camera/camera_panel.h"
#include "ui/panels/camera/presets_panel.h"
#include "ui/panels/compare/compare_panel.h"
#include "ui/panels/flight/flight_panel.h"
#include "ui/panels/frame/frame_panel.h"
#include "ui/panels/frame/timeline_panel.h"
#include "ui/panels/light/light_panel.h"
#include "ui/panels/lod/chunk_panel.h"
#include "ui/panels/lod/lod_panel.h"
#include "ui/panels/lod/overlay_panel.h"
#include "ui/panels/lod/quadtree_panel.h"
#include "ui/panels/lod/regions_panel.h"
#include "ui/panels/lod/seams_panel.h"
#include "ui/panels/log/log_panel.h"
#include "ui/panels/measure/atlas_panel.h"
#include "ui/panels/measure/cracks_panel.h"
#include "ui/panels/measure/errors_panel.h"
#include "ui/panels/measure/pops_panel.h"
#include "ui/panels/measure/probe_panel.h"
#include "ui/panels/measure/ruler_panel.h"
#include "ui/panels/notes/notes_panel.h"
#include "ui/panels/paging/paging_panel.h"
#include "ui/panels/sources/sources_panel.h"
#include "ui/panels/surface/surface_panel.h"
#include "ui/panels/sweep/suggest_panel.h"
#include "ui/panels/sweep/sweep_panel.h"
#include "ui/panels/trace/trace_findings_panel.h"
#include "ui/panels/trace/trace_node_panel.h"
#include "ui/panels/trace/trace_nodes_panel.h"
#include "ui/panels/trace/trace_paging_panel.h"
#include "ui/panels/trace/trace_panel.h"
#include "ui/panels/trace/what_if_panel.h"

namespace worldy::ui {

// The panels' state between frames that is not a setting.
struct PanelStates {
    QuadtreePanelState quadtree;
    ChunkPanelState chunk;
    PagingPanelState paging;
    BakePanelState bake;
    SurfacePanelState surface;
    CameraPanelState camera;
    PresetsPanelState presets;
    LogPanelState log;
    ErrorsPanelState errors;
    PopsPanelState pops;
    FlightPanelState flight;
    ComparePanelState compare;
    SweepPanelState sweep;
    SourcesPanelState sources;
    TracePanelState trace;
    TraceNodesPanelState traceNodes;
    TracePagingPanelState tracePaging;
    TraceFindingsPanelState traceFindings;
    WhatIfPanelState traceWhatIf;
    NotesPanelState notes;
    TimelinePanelState timeline;
    RegionsPanelState regions;
    AtlasPanelState atlas;
    SuggestPanelState suggest;
};

// Fills the current window with a panel.
void drawPanel(PanelId id, const EditorView& view, PanelStates& states, ViewSettings& settings,
               Commands& commands);

}  // namespace worldy::ui
