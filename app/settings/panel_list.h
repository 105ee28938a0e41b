// The list of panels and their default places.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace worldy {

enum class PanelId : std::uint8_t {
    Lod,
    Seams,
    Overlay,
    Surface,
    Camera,
    Presets,
    Quadtree,
    Chunk,
    Paging,
    Frame,
    Bake,
    Log,
    Errors,
    Cracks,
    Pops,
    Probe,
    Flight,
    Compare,
    Sweep,
    Light,
    Sources,
    Trace,
    TraceNodes,
    TraceNode,
    TracePaging,
    TraceFindings,
    TraceWhatIf,
    Ruler,
    Notes,
    Timeline,
    Regions,
    Atlas,
    Suggest
};

// Second: a window of the operating system for a second monitor, which is open while it has panels.
enum class Dock : std::uint8_t { Left, Right, Bottom, Second };
inline constexpr std::size_t dockCount = 4;

struct PanelInfo {
    PanelId id;
    const char* title;
    std::string_view key;  // in the settings file and for --panels
    const char* shortcut;  // "Ctrl+1"
    Dock dock;             // default dock
    bool shown;            // by default
};
inline constexpr auto panelInfos = std::to_array<PanelInfo>({
    {PanelId::Lod, "LOD", "lod", "Ctrl+1", Dock::Right, true},
    {PanelId::Seams, "Seams", "seams", "Ctrl+6", Dock::Right, true},
    {PanelId::Overlay, "Overlay", "overlay", "Ctrl+4", Dock::Right, true},
    {PanelId::Surface, "Surface", "surface", "Ctrl+7", Dock::Right, true},
    {PanelId::Camera, "Camera", "camera", "Ctrl+0", Dock::Right, true},
    {PanelId::Presets, "Presets", "presets", "Ctrl+P", Dock::Right, false},
    {PanelId::Quadtree, "Quadtree", "quadtree", "Ctrl+2", Dock::Left, true},
    {PanelId::Chunk, "Chunk", "chunk", "Ctrl+5", Dock::Left, true},
    {PanelId::Paging, "Paging", "paging", "Ctrl+3", Dock::Bottom, true},
    {PanelId::Frame, "Frame", "frame", "Ctrl+9", Dock::Bottom, true},
    {PanelId::Bake, "Bake", "bake", "Ctrl+8", Dock::Left, true},
    {PanelId::Log, "Log", "log", "Ctrl+L", Dock::Bottom, true},
    {PanelId::Errors, "True error", "errors", "Ctrl+Shift+1", Dock::Left, false},
    {PanelId::Cracks, "Cracks", "cracks", "Ctrl+Shift+2", Dock::Left, false},
    {PanelId::Pops, "Pops", "pops", "Ctrl+Shift+3", Dock::Bottom, false},
    {PanelId::Probe, "Precision", "probe", "Ctrl+Shift+4", Dock::Left, false},
    {PanelId::Flight, "Flight", "flight", "Ctrl+Shift+5", Dock::Bottom, false},
    {PanelId::Compare, "Compare", "compare", "Ctrl+Shift+6", Dock::Left, false},
    {PanelId::Sweep, "Sweep", "sweep", "Ctrl+Shift+7", Dock::Bottom, false},
    {PanelId::Light, "Light", "light", "Ctrl+Shift+8", Dock::Right, true},
    {PanelId::Sources, "Sources", "sources", "Ctrl+Shift+9", Dock::Left, false},
    {PanelId::Trace, "Trace", "trace", "Ctrl+T", Dock::Bottom, false},
    {PanelId::TraceNodes, "Trace nodes", "trace_nodes", "Ctrl+Shift+N", Dock::Left, false},
    {PanelId::TraceNode, "Trace node", "trace_node", "Ctrl+Shift+E", Dock::Right, false},
    {PanelId::TracePaging, "Trace paging", "trace_paging", "Ctrl+Shift+P", Dock::Bottom, false},
    {PanelId::TraceFindings, "Trace findings", "trace_findings", "Ctrl+Shift+F", Dock::Bottom, false},
    {PanelId::TraceWhatIf, "What if", "trace_what_if", "Ctrl+Shift+W", Dock::Bottom, false},
    {PanelId::Ruler, "Ruler", "ruler", "Ctrl+Shift+R", Dock::Left, false},
    {PanelId::Notes, "Notes", "notes", "Ctrl+M", Dock::Left, false},
    {PanelId::Timeline, "Timeline", "timeline", "Ctrl+Shift+T", Dock::Bottom, false},
    {PanelId::Regions, "Regions", "regions", "Ctrl+R", Dock::Right, false},
    {PanelId::Atlas, "Atlas", "atlas", "Ctrl+Shift+A", Dock::Bottom, false},
    {PanelId::Suggest, "Suggest", "suggest", "Ctrl+Shift+G", Dock::Bottom, false},
});
inline constexpr std::size_t panelCount = panelInfos.size();
static_assert(
    [] {
        for (std::size_t i = 0; i < panelCount; ++i)
            if (static_cast<std::size_t>(panelInfos[i].id) != i) return false;
        return true;
    }(),
    "panelInfos: expected the rows in the order of PanelId");

}  // namespace worldy
