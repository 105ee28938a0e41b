#include "app/flight/announce_flight.h"

#include <gtest/gtest.h>

#include <cmath>

namespace worldy {
namespace {

constexpr double flightRadiusM = 1e5;

FlightPath eastwards() {
    return {"east", {{2, {10, 0, 3000, 90, -20}}, {12, {10, 40, 3000, 90, -20}}}};
}

planet::View picture() {
    planet::View view;
    view.horizontalFovRad = 1.2;
    view.widthPx = 640;
    view.heightPx = 400;
    return view;
}

TEST(AnnounceFlight, TheViewsAreThoseOfTheFlight) {
    const AnnouncedFlight announced = announceFlight(eastwards(), 4.1, 1, 4, picture(), flightRadiusM);
    ASSERT_FALSE(announced.views.empty());
    for (const planet::AnnouncedView& one : announced.views) {
        EXPECT_GT(one.inS, 0);
        EXPECT_EQ(one.view,
                  planet::viewFromPose(poseAt(eastwards(), 4.1 + one.inS), flightRadiusM, 1.2, 640, 400));
    }
}

TEST(AnnounceFlight, TheHorizonIsCoveredUntilTheNextAnnouncement) {
    const AnnouncedFlight announced = announceFlight(eastwards(), 4.1, 1, 4, picture(), flightRadiusM);
    const FlightAnnouncement& holds = announced.announcement;
    EXPECT_TRUE(holds.holds(4.1, 4, 1));
    EXPECT_TRUE(holds.holds(holds.untilS - 1e-6, 4, 1));
    EXPECT_FALSE(holds.holds(holds.untilS, 4, 1));
    EXPECT_FALSE(holds.holds(4.0, 4, 1));  // the flight was moved back
    EXPECT_FALSE(holds.holds(4.1, 5, 1));
    EXPECT_FALSE(holds.holds(4.1, 4, 2));
    EXPECT_LE(holds.untilS - 4.1, 0.5);
    EXPECT_GE(4.1 + announced.views.back().inS, holds.untilS + 4 - 1e-9);
    EXPECT_LE(announced.views.front().inS, 0.5);
}

// Points on a grid: consecutive announcements agree where they overlap.
TEST(AnnounceFlight, TheNextAnnouncementGoesOnWithTheSamePoints) {
    const AnnouncedFlight first = announceFlight(eastwards(), 4.1, 1, 4, picture(), flightRadiusM);
    const double laterS = first.announcement.untilS + 0.01;
    const AnnouncedFlight second = announceFlight(eastwards(), laterS, 1, 4, picture(), flightRadiusM);
    for (std::size_t i = 0; i + 1 < first.views.size(); ++i) {
        EXPECT_EQ(second.views[i].view, first.views[i + 1].view);
        EXPECT_NEAR(laterS + second.views[i].inS, 4.1 + first.views[i + 1].inS, 1e-9);
    }
}

TEST(AnnounceFlight, AFasterFlightIsThereSooner) {
    const AnnouncedFlight announced = announceFlight(eastwards(), 4.1, 2, 4, picture(), flightRadiusM);
    for (const planet::AnnouncedView& one : announced.views)
        EXPECT_EQ(one.view,
                  planet::viewFromPose(poseAt(eastwards(), 4.1 + 2 * one.inS), flightRadiusM, 1.2, 640, 400));
}

TEST(AnnounceFlight, TheEndOfTheFlightStays) {
    const AnnouncedFlight announced = announceFlight(eastwards(), 11.9, 1, 4, picture(), flightRadiusM);
    const planet::View last = planet::viewFromPose(poseAt(eastwards(), 12), flightRadiusM, 1.2, 640, 400);
    EXPECT_EQ(announced.views.back().view, last);
}

}  // namespace
}  // namespace worldy
