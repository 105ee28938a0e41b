#include "ui/shell/panels.h"

namespace worldy::ui {

void drawPanel(PanelId id, const EditorView& view, PanelStates& states, ViewSettings& settings,
               Commands& commands) {
    switch (id) {
        case PanelId::Lod:
            return lodPanel(view, settings, commands);
        case PanelId::Seams:
            return seamsPanel(view, settings, commands);
        case PanelId::Overlay:
            return overlayPanel(view, settings);
        case PanelId::Surface:
            return surfacePanel(view, states.surface, settings, commands);
        case PanelId::Camera:
            return cameraPanel(view, states.camera, settings, commands);
        case PanelId::Presets:
            return presetsPanel(view, states.presets, commands);
        case PanelId::Quadtree:
            return quadtreePanel(view, states.quadtree, settings, commands);
        case PanelId::Chunk:
            return chunkPanel(view, states.chunk, commands);
        case PanelId::Paging:
            return pagingPanel(view, states.paging, settings, commands);
        case PanelId::Frame:
            return framePanel(view, commands);
        case PanelId::Bake:
            return bakePanel(view, states.bake, settings, commands);
        case PanelId::Log:
            return logPanel(view.log, states.log, commands);
        case PanelId::Errors:
            return errorsPanel(view, states.errors, settings, commands);
        case PanelId::Cracks:
            return cracksPanel(view, settings, commands);
        case PanelId::Pops:
            return popsPanel(view, states.pops, commands);
        case PanelId::Probe:
            return probePanel(view, commands);
        case PanelId::Flight:
            return flightPanel(view, states.flight, settings, commands);
        case PanelId::Compare:
            return comparePanel(view, states.compare, settings, commands);
        case PanelId::Sweep:
            return sweepPanel(view, states.sweep, settings, commands);
        case PanelId::Light:
            return lightPanel(view, settings, commands);
        case PanelId::Sources:
            return sourcesPanel(view, states.sources, settings, commands);
        case PanelId::Trace:
            return tracePanel(view, states.trace, commands);
        case PanelId::TraceNodes:
            return traceNodesPanel(view, states.traceNodes, commands);
        case PanelId::TraceNode:
            return traceNodePanel(view, commands);
        case PanelId::TracePaging:
            return tracePagingPanel(view, states.tracePaging, commands);
        case PanelId::TraceFindings:
            return traceFindingsPanel(view, states.traceFindings, commands);
        case PanelId::TraceWhatIf:
            return whatIfPanel(view, states.traceWhatIf, commands);
        case PanelId::Ruler:
            return rulerPanel(view, commands);
        case PanelId::Notes:
            return notesPanel(view, states.notes, settings, commands);
        case PanelId::Timeline:
            return timelinePanel(view, states.timeline, commands);
        case PanelId::Regions:
            return regionsPanel(view, states.regions, settings, commands);
        case PanelId::Atlas:
            return atlasPanel(view, states.atlas, settings, commands);
        case PanelId::Suggest:
            return suggestPanel(view, states.suggest, commands);
    }
}

}  // namespace worldy::ui
