// The lines over the planet show the cameras of all views of a frame.
#include "app/trace/trace_lines.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace worldy {
namespace {

TracedView viewFrom(int number, const glm::dvec3& eye) {
    TracedView view{.view = number};
    view.info.emplace();
    view.info->eye = eye;
    view.info->projection[2][3] = -1;
    view.info->projection[3][3] = 0;
    view.info->width = view.info->height = 100;
    return view;
}

TEST(TraceLines, everyCameraOfAFrameIsDrawnAndTheShownOneIsTheBrightest) {
    TracedFrame frame;
    frame.description.emplace();
    frame.description->shape = planet::TraceShape::Sphere;
    frame.description->radius = 10;
    frame.views = {viewFrom(0, {20, 0, 0}), viewFrom(1, {0, 30, 0}), TracedView{.view = 2}};
    const auto opacityAt = [&](const TracedView& shown, const glm::dvec3& eyeM) {
        int opacity = 0;
        for (const planet::LineVertex& vertex : traceLines(frame, shown, 1000, {0, 0, 5000}, {}, {}))
            if (glm::dvec3(vertex.positionM) == eyeM) opacity = vertex.colour[3];
        return opacity;
    };
    for (const std::size_t shown : {0u, 1u}) {
        const int first = opacityAt(frame.views[shown], {2000, 0, 0});
        const int second = opacityAt(frame.views[shown], {0, 3000, 0});
        EXPECT_GT(std::min(first, second), 0);
        EXPECT_EQ(first > second, shown == 0);
    }
}

}  // namespace
}  // namespace worldy
