#include "ui/model/camera_heights.h"

#include <glm/geometric.hpp>

namespace ui {

CameraHeights cameraHeights(const EditorView& view, const ViewSettings& settings) {
    const double altitudeM = view.camera.pose.altitudeM;
    const glm::dvec3& eyeM = view.renderView.eyeM;
    CameraHeights heights{view.camera.heightAboveGroundM, view.camera.heightAboveGroundM,
                          altitudeM - settings.surface.seaLevelM * settings.surface.exaggeration};
    if (view.planet && glm::dot(eyeM, eyeM) > 0)
        heights.aboveGroundM = altitudeM - planet::residentHeightM(view.planet->tree(), eyeM);
    return heights;
}

std::vector<NamedHeight> namedHeights(const CameraHeights& heights) {
    constexpr double sameM = 0.5;
    const NamedHeight bed{
        "above the sea bed", heights.aboveGroundM,
        "Height of the camera above the finest ground that is loaded below it, under the sea."};
    if (heights.aboveGroundM > heights.aboveDrawnM + sameM)
        return {{"above the sea surface", heights.aboveDrawnM,
                 "Height of the camera above the sea drawn below it."},
                bed};
    if (heights.aboveGroundM > heights.aboveSeaLevelM + sameM)
        return {bed,
                {"above sea level", heights.aboveSeaLevelM,
                 "Height of the camera above the Sea level of the Surface panel. The sea's surface is not "
                 "drawn here: "
                 "what is drawn is its bed."}};
    return {{"above ground", heights.aboveDrawnM,
             "Height of the camera above the finest ground that is loaded below it."}};
}

}  // namespace ui
