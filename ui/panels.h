// All panels, each of which has a file of its own, behind one function.
#pragma once

#include "ui/bake_panel.h"
#include "ui/camera_panel.h"
#include "ui/chunk_panel.h"
#include "ui/compare_panel.h"
#include "ui/cracks_panel.h"
#include "ui/editor_view.h"
#include "ui/errors_panel.h"
#include "ui/flight_panel.h"
#include "ui/frame_panel.h"
#include "ui/light_panel.h"
#include "ui/lod_panel.h"
#include "ui/log_panel.h"
#include "ui/overlay_panel.h"
#include "ui/paging_panel.h"
#include "ui/panel_list.h"
#include "ui/pops_panel.h"
#include "ui/presets_panel.h"
#include "ui/probe_panel.h"
#include "ui/quadtree_panel.h"
#include "ui/seams_panel.h"
#include "ui/surface_panel.h"
#include "ui/sweep_panel.h"

namespace ui {

// What panels remember from frame to frame that is no setting.
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
    CracksPanelState cracks;
    PopsPanelState pops;
    ProbePanelState probe;
    FlightPanelState flight;
    ComparePanelState compare;
    SweepPanelState sweep;
};

// Fills the current window with a panel.
void drawPanel(PanelId id, const EditorView& view, PanelStates& states, ViewSettings& settings,
               Commands& commands);

}  // namespace ui
