#include "ui/model/typed_place.h"

#include <gtest/gtest.h>

namespace worldy::ui {
namespace {

void expectPlace(const char* text, double latitudeDeg, double longitudeDeg) {
    const auto place = typedPlace(text);
    ASSERT_TRUE(place) << text;
    EXPECT_DOUBLE_EQ(place->latitudeDeg, latitudeDeg) << text;
    EXPECT_DOUBLE_EQ(place->longitudeDeg, longitudeDeg) << text;
    EXPECT_EQ(typedPlaceProblem(text), "") << text;
}

TEST(TypedPlace, latitudeComesFirst) {
    expectPlace("27.99, 86.93", 27.99, 86.93);
    expectPlace("  27.99   86.93 ", 27.99, 86.93);
    expectPlace("-32.95,-70.45", -32.95, -70.45);
    expectPlace("+5;6", 5, 6);
}

TEST(TypedPlace, lettersSayWhichIsWhich) {
    expectPlace("27.99N, 86.93E", 27.99, 86.93);
    expectPlace("32.95° S, 70.45° W", -32.95, -70.45);
    expectPlace("70.45 w 32.95 s", -32.95, -70.45);
    expectPlace("N27.99 E86.93", 27.99, 86.93);
    expectPlace("86.93E, 27.99", 27.99, 86.93);
}

TEST(TypedPlace, longitudesAreWrapped) {
    expectPlace("10, 350", 10, -10);
    expectPlace("10, -190", 10, 170);
}

TEST(TypedPlace, otherTextIsNoPlace) {
    for (const char* text : {"", "27.99", "27.99,", "a, b", "27.99, 86.93, 5", "y_pos/4/6/13", "1e400, 2",
                             "5N 6N", "-5S 6E", "nan, 1", "inf 2", "1 2 x", "N", "1..2, 3"}) {
        EXPECT_FALSE(typedPlace(text)) << text;
        EXPECT_EQ(typedPlaceProblem(text), "") << text;
    }
}

TEST(TypedPlace, anglesOutOfRangeAreNamed) {
    EXPECT_FALSE(typedPlace("98, 10"));
    EXPECT_EQ(typedPlaceProblem("98, 10"), "latitude 98 is out of range [-90, 90]°");
    EXPECT_EQ(typedPlaceProblem("8, 400"), "longitude 400 is out of range [-360, 360]°");
    EXPECT_FALSE(typedPlace("8, 400"));
}

}  // namespace
}  // namespace worldy::ui
