#include "app/base/text.h"

#include <gtest/gtest.h>

namespace worldy {
namespace {

TEST(Text, BytesKeepThreeDigits) {
    EXPECT_EQ(bytesText(0), "0 B");
    EXPECT_EQ(bytesText(999), "999 B");
    EXPECT_EQ(bytesText(1536), "1.50 KiB");
    EXPECT_EQ(bytesText(12.34 * 1024 * 1024), "12.3 MiB");
    EXPECT_EQ(bytesText(256.0 * 1024 * 1024), "256 MiB");
    EXPECT_EQ(bytesText(3e12), "2.73 TiB");
}

TEST(Text, CountsAreWholeUntilTheyAreLong) {
    EXPECT_EQ(countText(0), "0");
    EXPECT_EQ(countText(9999), "9999");
    EXPECT_EQ(countText(12'345), "12.3 k");
    EXPECT_EQ(countText(4'560'000), "4.56 M");
}

TEST(Text, DurationsReadAsPeopleSayThem) {
    EXPECT_EQ(durationText(0.42), "0.4 s");
    EXPECT_EQ(durationText(12.3), "12 s");
    EXPECT_EQ(durationText(200), "3 min 20 s");
    EXPECT_EQ(durationText(7500), "2 h 5 min");
}

TEST(Text, longMeasurementsAreInSeconds) {
    EXPECT_EQ(millisecondsText(0.42), "0.42 ms");
    EXPECT_EQ(millisecondsText(12), "12.0 ms");
    EXPECT_EQ(millisecondsText(420), "420 ms");
    EXPECT_EQ(millisecondsText(2570.13), "2.57 s");
    EXPECT_EQ(millisecondsText(64'000), "1 min 4 s");
    EXPECT_EQ(clockText(20.28), "20:17");
}

TEST(Text, DistancesChangeUnitWithSize) {
    EXPECT_EQ(distanceText(4.21), "4.2 m");
    EXPECT_EQ(distanceText(950), "950 m");
    EXPECT_EQ(distanceText(12'345), "12.3 km");
    EXPECT_EQ(distanceText(14'016'200), "14016 km");
    EXPECT_EQ(distanceText(-20), "-20 m");
}

TEST(Text, PlacesSayTheirHemisphere) {
    EXPECT_EQ(placeText(27.988, 86.925), "27.9880° N, 86.9250° E");
    EXPECT_EQ(placeText(-33.5, -70.25), "33.5000° S, 70.2500° W");
    EXPECT_EQ(placeText(0, 190), "0.0000° N, 170.0000° W");
    EXPECT_EQ(placeText(23.44, -114.02, 1), "23.4° N, 114.0° W");
}

TEST(Text, PixelsHaveNoMoreDigitsThanCanBeSeen) {
    EXPECT_EQ(pixelsText(0), "0 px");
    EXPECT_EQ(pixelsText(0.042), "0.04 px");
    EXPECT_EQ(pixelsText(1.26), "1.3 px");
    EXPECT_EQ(pixelsText(29.3), "29 px");
    EXPECT_EQ(pixelsText(1234), "1234 px");
    EXPECT_EQ(pixelsText(110'347), "110 k px");
    EXPECT_EQ(pixelsText(1.6e10), "> 1 M px");
}

TEST(Text, numbersAreRoundedToFourDigitsAndOtherTextsStay) {
    EXPECT_EQ(shortNumberText("19.630435466766357"), "19.63");
    EXPECT_EQ(shortNumberText("-0.30000001192092896"), "-0.3");
    EXPECT_EQ(shortNumberText("0.00012345678"), "0.0001235");
    EXPECT_EQ(shortNumberText("123456.789"), "123457");
    EXPECT_EQ(shortNumberText("12"), "12");
    EXPECT_EQ(shortNumberText("0"), "0");
    EXPECT_EQ(shortNumberText("tight"), "tight");
    EXPECT_EQ(shortNumberText("2.5 m"), "2.5 m");
}

TEST(Text, roundedNumbersThatDifferAreToldApart) {
    using Texts = std::array<std::string, 2>;
    EXPECT_EQ(shortNumberTexts("12", "19.630435466766357"), (Texts{"12", "19.63"}));
    EXPECT_EQ(shortNumberTexts("2.00001", "2.00002"), (Texts{"2.00001", "2.00002"}));
}

}  // namespace
}  // namespace worldy
