#include "app/scene/frame_stats.h"

namespace worldy {

FrameStats smoothed(const FrameStats& before, const FrameStats& now) {
    constexpr double newest = 0.08;  // share of the newest frame: settles within half a second
    const auto mix = [](double old, double value) { return old + newest * (value - old); };
    FrameStats stats = now;
    stats.stages.uploadMs = mix(before.stages.uploadMs, now.stages.uploadMs);
    stats.stages.selectMs = mix(before.stages.selectMs, now.stages.selectMs);
    stats.stages.pagingMs = mix(before.stages.pagingMs, now.stages.pagingMs);
    stats.render.chunksMs = mix(before.render.chunksMs, now.render.chunksMs);
    stats.render.skyMs = mix(before.render.skyMs, now.render.skyMs);
    stats.render.shadowsMs = mix(before.render.shadowsMs, now.render.shadowsMs);
    stats.drawCpuMs = mix(before.drawCpuMs, now.drawCpuMs);
    stats.overlaysMs = mix(before.overlaysMs, now.overlaysMs);
    stats.panelsMs = mix(before.panelsMs, now.panelsMs);
    stats.panelsGpuMs = mix(before.panelsGpuMs, now.panelsGpuMs);
    stats.presentMs = mix(before.presentMs, now.presentMs);
    stats.frameMs = mix(before.frameMs, now.frameMs);
    return stats;
}

}  // namespace worldy
