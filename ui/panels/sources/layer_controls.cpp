#include "ui/panels/sources/layer_controls.h"

#include <imgui.h>

#include <algorithm>

#include "ui/kit/item_map.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

bool numberRow(const char* label, double& value, double least, double most, const char* format,
               const char* tip) {
    labelledControl(label, tip);
    ImGui::PushID(label);
    const bool changed = numberField("##number", value, format);
    ImGui::PopID();
    noteItem(label);
    value = std::clamp(value, least, most);
    return changed;
}

bool voidsRows(planet::WorldLayer& layer) {
    labelledControl(
        "Voids",
        "What samples without a height show: the layers under this one, heights interpolated from those "
        "around them, or a height of your own.");
    int voids = static_cast<int>(layer.voids);
    bool changed = combo("Voids", voids, "below\0fill\0a height\0");
    layer.voids = static_cast<planet::LayerVoids>(voids);
    if (layer.voids == planet::LayerVoids::Height)
        changed |= numberRow("Void height", layer.voidM, -1e6, 1e6, "%.6g m",
                             "The height of samples without one, before scale and offset.");
    return changed;
}

bool datumRow(planet::WorldLayer& layer) {
    labelledControl(
        "Datum",
        "What the heights of the files are measured from. They are converted to the planet's datum.");
    int datum = layer.datum ? static_cast<int>(*layer.datum) : 0;
    const bool changed = combo("Datum", datum, "ellipsoid\0EGM96\0EGM2008\0");
    if (changed) layer.datum = static_cast<planet::VerticalDatum>(datum);
    return changed;
}

}  // namespace

bool sourceLayerControls(planet::WorldLayer& layer, const std::optional<planet::VerticalDatum>& planetDatum) {
    bool changed = false;
    if (layer.detail.empty()) {
        labelledControl(
            "Join",
            "How the layer joins what lies under it. Replace: its heights count. Max: the higher one "
            "counts. Add: its heights are added.");
        int join = static_cast<int>(layer.join);
        changed |= combo("Join", join, "replace\0max\0add\0");
        layer.join = static_cast<planet::LayerJoin>(join);
    }
    if (!layer.files.empty()) {
        changed |= voidsRows(layer);
        changed |= numberRow(
            "Feather", layer.featherM, 0, 1e6, "%.6g m",
            "Width of the blend at the rim of the coverage, inwards, in metres. 0 leaves a step. With "
            "voids below, a void has a rim too.");
    }
    if (layer.detail.empty()) {
        changed |= numberRow("Scale", layer.scale, -1e6, 1e6, "%.6g",
                             "Factor on the heights that the files say. It must not be 0.");
        const bool moved =
            numberRow("Offset", layer.offsetM, -1e6, 1e6, "%.6g m",
                      "Added to the heights. An offset in a layer of another datum takes the place of "
                      "the conversion.");
        layer.hasOffset |= moved;
        changed |= moved;
    }
    // Heights that are added have no datum.
    if (planetDatum && !layer.files.empty()) {
        if (layer.join == planet::LayerJoin::Add)
            layer.datum.reset();
        else if (!layer.datum)
            layer.datum = planetDatum;
        if (layer.datum) changed |= datumRow(layer);
    }
    return changed;
}

}  // namespace worldy::ui
