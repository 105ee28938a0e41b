// Draws the report of a suggestion as a picture of one page.
#pragma once

#include <string>
#include <vector>

#include "app/base/picture.h"
#include "planet/base/result.h"

namespace worldy {

// The content of a page, as plain data.
struct SuggestPage {
    std::string title;
    bool isMet = false;
    std::vector<std::string> paragraphs;  // below the title
    // Tables: the first row of each is its head; every row has as many cells.
    std::vector<std::vector<std::vector<std::string>>> tables;

    // The candidates: the largest share of a budget of costs over the drawn error, pixels; both > 0.
    struct Point {
        double errorPx = 0;
        double costShare = 0;
        bool isWhole = false;
        bool isBest = false;
        bool isBefore = false;
    };
    std::vector<Point> points;
    double errorLimitPx = 0;  // 0: none
    bool limitsCosts = false;

    struct Place {
        std::string caption;
        Picture picture;  // may be empty
    };
    std::vector<Place> places;  // at most four are drawn
    std::string notes;          // at the foot
};

// A missing font is an Error.
planet::Result<Picture> drawSuggestPage(const SuggestPage& page);

}  // namespace worldy
