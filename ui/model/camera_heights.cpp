#include "ui/model/camera_heights.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace worldy::ui {

CameraHeights cameraHeights(const EditorView& view, const ViewSettings& settings) {
    const double altitudeM = view.camera.pose.altitudeM;
    const glm::dvec3& eyeM = view.camera.renderView.eyeM;
    const bool hasPlace = view.planet && glm::dot(eyeM, eyeM) > 0;
    const double groundM = hasPlace ? planet::sampledHeightM(view.planet->tree(), eyeM) : 0;
    const double drawnM = std::max(groundM, view.camera.seaSurfaceM.value_or(groundM));
    return {altitudeM - drawnM, altitudeM - groundM,
            altitudeM - settings.surface.seaLevelM * settings.surface.exaggeration};
}

std::vector<NamedHeight> namedHeights(const CameraHeights& heights) {
    constexpr double sameM = 0.5;
    const NamedHeight bed{
        "above the sea bed", heights.aboveGroundM,
        "Height of the camera above the finest ground that is loaded below it, under the sea."};
    NamedHeight sea{"above sea level", heights.aboveSeaLevelM,
                    "Height of the camera above the Sea level of the Surface panel."};
    if (heights.aboveGroundM > heights.aboveDrawnM + sameM)
        return {{"above the sea surface", heights.aboveDrawnM,
                 "Height of the camera above the sea drawn below it."},
                bed};
    if (heights.aboveGroundM > heights.aboveSeaLevelM + sameM) {
        sea.explanation =
            "Height of the camera above the Sea level of the Surface panel. The sea surface is not drawn; "
            "the sea bed is.";
        return {bed, sea};
    }
    return {{"above ground", heights.aboveGroundM,
             "Height of the camera above the finest ground that is loaded below it."},
            sea};
}

}  // namespace worldy::ui
