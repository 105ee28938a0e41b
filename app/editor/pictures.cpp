#include "app/editor/pictures.h"

#include <vector>

#include "app/editor/compare_controller.h"
#include "app/scene/observer.h"
#include "app/scene/overlay_colours.h"
#include "app/scene/overlay_lines.h"
#include "app/scene/region_lines.h"
#include "app/scene/source_lines.h"

namespace worldy {

namespace {

std::vector<planet::gl::ChunkTint> tintsOf(const Scene& scene, const planet::Selection& selection,
                                           const ViewSettings& settings, TintData data,
                                           const InstrumentsController& instruments) {
    if (instruments.errors.last) data.measured = &*instruments.errors.last;
    if (instruments.atlas.atlas) data.atlas = &instruments.atlas.drape;
    return chunkTints(*scene.planet, selection, settings.overlay, settings.lod.tauPx, data);
}

void appendOutlines(const PictureInput& input, PictureContent& content) {
    const planet::Lines nodes = traceLinesOf(input.trace, input.scene.planet->tree().shape.radiusM,
                                             content.view.eyeM, input.settings.overlay);
    content.frontLines.insert(content.frontLines.end(), nodes.begin(), nodes.end());
    const planet::ChunkTree& tree = input.scene.planet->tree();
    follow(input.scene.regionOutlines, tree);
    const auto append = [&](const planet::Lines& more) {
        content.frontLines.insert(content.frontLines.end(), more.begin(), more.end());
    };
    if (input.settings.overlay.regions) append(regionLines(input.scene.regionOutlines, tree, content.view));
    if (input.draft) append(draftLines(*input.draft, {255, 255, 255, 255}, tree, content.view));
    if (!input.layers || !input.settings.overlay.sources) return;
    const planet::Lines lines = sourceLines(*input.layers, input.scene.planet->tree(), content.view);
    content.frontLines.insert(content.frontLines.end(), lines.begin(), lines.end());
}

void appendRuler(const Ruler& ruler, const Scene& scene, PictureContent& content) {
    const planet::Lines lines = rulerLines(ruler, content.view, scene.planet->tree().shape.radiusM);
    content.frontLines.insert(content.frontLines.end(), lines.begin(), lines.end());
}

void appendAtlas(const InstrumentsController& instruments, const Scene& scene, const OverlaySettings& overlay,
                 PictureContent& content) {
    if (overlay.colourBy != ColourBy::Atlas || !instruments.atlas.atlas) return;
    const planet::Lines lines = atlasLines(instruments.atlas.drape, scene.planet->tree(), content.view);
    content.frontLines.insert(content.frontLines.end(), lines.begin(), lines.end());
}

}  // namespace

void drawMainPicture(Viewport& viewport, const PictureInput& input, InstrumentsController& instruments,
                     bool comparing, const Log& log) {
    Scene& scene = input.scene;
    const ViewSettings settings = comparing ? comparedSettings(input.settings) : input.settings;
    PictureContent content;
    content.view = mainView(input.camera, viewport, input.settings.camera);
    viewport.main.view = content.view;
    if (!viewport.main.shown()) return;
    const std::optional<KeptPicture> kept = keptPicture(scene.planet->tree(), instruments.pops);
    if (kept) content.kept = KeptItems{kept->selection.draw, kept->stitched};
    const planet::Selection& shown = kept ? kept->selection : scene.planet->selection();
    const std::vector<planet::gl::ChunkTint> tints =
        tintsOf(scene, shown, settings, input.tints, instruments);
    content.tints = tints;
    content.hiddenLines = linesOver(scene, shown, content.view, settings);
    ChunkFocus focus = input.focus;
    if (input.draft) focus.hovered.reset();  // its outline would look like a part of the draft
    content.frontLines = focusLines(scene.planet->tree(), focus, content.view);
    appendOutlines(input, content);
    appendRuler(instruments.ruler, scene, content);
    appendAtlas(instruments, scene, settings.overlay, content);
    drawPicture(viewport, viewport.main, scene, settings, content, log);
}

void drawObserverPicture(Viewport& viewport, const PictureInput& input,
                         const InstrumentsController& instruments, const Log& log) {
    if (!viewport.observer.shown()) return;
    Scene& scene = input.scene;
    const ViewSettings& settings = input.settings;
    PictureContent content;
    content.view = observerView(input.camera, viewport, settings.camera);
    content.selection = observerSelection(scene, viewport, settings.camera);
    const planet::Selection& shown = scene.planet->selection(content.selection);
    const std::vector<planet::gl::ChunkTint> tints =
        tintsOf(scene, shown, settings, input.tints, instruments);
    content.tints = tints;
    content.hiddenLines = linesOver(scene, shown, content.view, settings);
    content.frontLines =
        observerLines(*scene.planet, input.camera.lodView, settings.camera, input.focus.selected);
    const planet::Lines focus = focusLines(scene.planet->tree(), input.focus, content.view);
    content.frontLines.insert(content.frontLines.end(), focus.begin(), focus.end());
    appendOutlines(input, content);
    appendRuler(instruments.ruler, scene, content);
    appendAtlas(instruments, scene, settings.overlay, content);
    drawPicture(viewport, viewport.observer, scene, settings, content, log);
}

}  // namespace worldy
