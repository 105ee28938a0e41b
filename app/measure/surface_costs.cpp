#include "app/measure/surface_costs.h"

#include <epoxy/gl.h>

#include <utility>

#include "app/base/stopwatch.h"
#include "planet/base/percentile.h"
#include "planet/gl/device/keep_framebuffers.h"

namespace worldy {

namespace {

using planet::gl::FeatureUse;

// Turns on the physical atmosphere, or the analytic one if `physical` is Off.
void useAir(SurfaceSettings& surface, FeatureUse physical) {
    surface.atmosphere = true;
    surface.light.air.use = physical;
}

// Returns settings that draw only the lit ground.
ViewSettings barePicture(const ViewSettings& settings) {
    ViewSettings bare = settings;
    SurfaceSettings& surface = bare.surface;
    surface.lighting = true;
    surface.atmosphere = surface.streamed = false;
    surface.detail = surface.layers.use = surface.light.air.use = surface.light.sea.use = FeatureUse::Off;
    surface.light.shadows.use = surface.light.normals.use = FeatureUse::Off;
    return bare;
}

}  // namespace

std::vector<PartSettings> partsOf(const ViewSettings& settings, const PartsThere& there) {
    const ViewSettings bare = barePicture(settings);
    ViewSettings all = bare;
    std::vector<PartSettings> parts;
    const auto add = [&](const char* name, const auto& turnOn) {
        parts.push_back({name, bare});
        turnOn(parts.back().settings.surface);
        turnOn(all.surface);
    };
    add("analytic atmosphere", [](SurfaceSettings& surface) { useAir(surface, FeatureUse::Off); });
    add("physical atmosphere", [](SurfaceSettings& surface) { useAir(surface, FeatureUse::On); });
    add("sea surface", [](SurfaceSettings& surface) { surface.light.sea.use = FeatureUse::On; });
    add("shadows", [](SurfaceSettings& surface) { surface.light.shadows.use = FeatureUse::On; });
    if (there.normals)
        add("normals", [](SurfaceSettings& surface) { surface.light.normals.use = FeatureUse::On; });
    add("detail", [](SurfaceSettings& surface) { surface.detail = FeatureUse::On; });
    add("layers", [](SurfaceSettings& surface) { surface.layers.use = FeatureUse::On; });
    if (there.colours) add("streamed colours", [](SurfaceSettings& surface) { surface.streamed = true; });
    parts.push_back({"all features", all});
    return parts;
}

CostMeter::CostMeter(planet::gl::RenderTarget target, const planet::View& view, ViewSettings bare,
                     std::vector<Part> parts, int rounds)
    : target_(std::move(target)),
      view_(view),
      bare_(std::move(bare)),
      parts_(std::move(parts)),
      wanted_(parts_.size() * static_cast<std::size_t>(rounds)) {}

planet::Result<CostMeter> CostMeter::create(const Scene& scene, const planet::View& view,
                                            const ViewSettings& settings, int rounds) {
    auto target = planet::gl::RenderTarget::create(view.widthPx, view.heightPx);
    if (!target) return tl::unexpected(target.error());
    const PartsThere there{scene.planet->colour().has_value(),
                           scene.planet->paging()[planet::BlockKind::Normals].capacity > 0};
    std::vector<Part> parts;
    for (PartSettings& part : partsOf(settings, there)) parts.push_back({std::move(part), {}, {}});
    return CostMeter(std::move(*target), view, barePicture(settings), std::move(parts), rounds);
}

// Draws once untimed, because creating resources for new settings is not part of a frame.
double CostMeter::drawnMs(Scene& scene, const ViewSettings& settings) const {
    drawScene(scene, view_, settings);
    glFinish();
    const Stopwatch watch;
    drawScene(scene, view_, settings);
    glFinish();
    return watch.elapsedMs();
}

bool CostMeter::step(Scene& scene) {
    if (done_ == wanted_) return false;
    const auto kept = std::pair(scene.drawn, scene.drawCpuMs);
    const planet::gl::KeepFramebuffers keep;
    target_.bind();
    Part& part = parts_[done_ % parts_.size()];
    part.withoutMs.push_back(drawnMs(scene, bare_));
    part.withMs.push_back(drawnMs(scene, part.settings.settings));
    std::tie(scene.drawn, scene.drawCpuMs) = kept;
    return ++done_ < wanted_;
}

double CostMeter::share() const {
    return wanted_ == 0 ? 1 : static_cast<double>(done_) / static_cast<double>(wanted_);
}

std::vector<PartCost> CostMeter::costs() const {
    std::vector<PartCost> costs;
    for (const Part& part : parts_)
        costs.push_back({part.settings.name, planet::percentileOf(std::vector(part.withoutMs), 0.5),
                         planet::percentileOf(std::vector(part.withMs), 0.5)});
    return costs;
}

}  // namespace worldy
