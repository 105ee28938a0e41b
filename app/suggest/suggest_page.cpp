#include "app/suggest/suggest_page.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "app/base/picture.h"
#include "app/base/plot_scale.h"
#include "app/base/utf8.h"
#include "planet/base/result.h"

namespace worldy {

namespace {

namespace draw = OIIO::ImageBufAlgo;
using OIIO::ImageBuf;
using PageColour = std::array<float, 4>;

constexpr const char* pageFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
// A4 upright at 150 dots per inch.
constexpr int pageWidth = 1240, pageHeight = 1754, margin = 70;
constexpr int bodyPx = 19, smallPx = 15, titlePx = 34, lineStepPx = 27;
constexpr PageColour pageInk = {0.10f, 0.11f, 0.13f, 1};
constexpr PageColour pageFaint = {0.84f, 0.85f, 0.87f, 1};
constexpr PageColour pageGrey = {0.55f, 0.57f, 0.60f, 1};
constexpr PageColour pageBlue = {0.00f, 0.45f, 0.70f, 1};
constexpr PageColour pageRed = {0.84f, 0.37f, 0.00f, 1};
constexpr PageColour pageGreen = {0.00f, 0.55f, 0.40f, 1};

struct PageCanvas {
    ImageBuf image{OIIO::ImageSpec(pageWidth, pageHeight, 3, OIIO::TypeDesc::FLOAT)};
    bool hasFont = true;
    int y = margin;

    // OpenImageIO 2.4 draws letters beyond ASCII as others: it keeps only the last six bits of each.
    void text(int atX, int atY, const std::string& words, int size = bodyPx,
              const PageColour& colour = pageInk, draw::TextAlignX align = draw::TextAlignX::Left) {
        // OpenImageIO ends the program if it writes below the picture.
        if (atY < 0 || atY + 2 * size > pageHeight) return;
        hasFont &= draw::render_text(image, atX, atY + size * 4 / 5, asciiOf(words), size, pageFont, colour,
                                     align, draw::TextAlignY::Baseline);
    }
    int widthOf(const std::string& words, int size) {
        const OIIO::ROI box = draw::text_size(asciiOf(words), size, pageFont);
        hasFont &= box.defined();
        return box.defined() ? box.width() : 0;
    }
    // Returns words in lines as wide as fit.
    std::vector<std::string> linesOf(const std::string& words, int size) {
        std::istringstream stream(words);
        std::vector<std::string> lines;
        std::string word;
        while (stream >> word) {
            const std::string longer = lines.empty() ? word : fmt::format("{} {}", lines.back(), word);
            if (lines.empty() || widthOf(longer, size) > pageWidth - 2 * margin)
                lines.push_back(word);
            else
                lines.back() = longer;
        }
        return lines;
    }
    static int stepOf(int size) { return lineStepPx * size / bodyPx; }
    // Writes words in such lines, and moves below them.
    void paragraph(const std::string& words, int size = bodyPx, const PageColour& colour = pageInk) {
        for (const std::string& line : linesOf(words, size)) {
            text(margin, y, line, size, colour);
            y += stepOf(size);
        }
        y += stepOf(size) / 3;
    }
    void rule(int x1, int y1, int x2, int y2, const PageColour& colour, int thickness = 1) {
        for (int away = 0; away < thickness; ++away) {
            const bool isLevel = y1 == y2;
            draw::render_line(image, x1 + (isLevel ? 0 : away), y1 + (isLevel ? away : 0),
                              x2 + (isLevel ? 0 : away), y2 + (isLevel ? away : 0), colour);
        }
    }
    void disc(int atX, int atY, int radius, const PageColour& colour) {
        for (int row = -radius; row <= radius; ++row) {
            const auto half = static_cast<int>(std::sqrt(static_cast<double>(radius * radius - row * row)));
            draw::render_line(image, atX - half, atY + row, atX + half, atY + row, colour);
        }
    }
};

void drawTable(PageCanvas& canvas, const std::vector<std::vector<std::string>>& rows) {
    if (rows.empty()) return;
    const std::size_t columns = rows.front().size();
    std::vector<int> widths(columns, 0);
    for (const auto& row : rows) {
        for (std::size_t c = 0; c < columns; ++c)
            widths[c] = std::max(widths[c], canvas.widthOf(row[c], bodyPx));
    }
    int total = 0;
    for (const int columnWidth : widths) total += columnWidth;
    const int gap = std::min(
        48, std::max((pageWidth - 2 * margin - total) / std::max<int>(static_cast<int>(columns), 1), 12));
    for (std::size_t r = 0; r < rows.size(); ++r) {
        int x = margin;
        for (std::size_t c = 0; c < columns; ++c) {
            canvas.text(x, canvas.y, rows[r][c], bodyPx, r == 0 ? pageGrey : pageInk);
            x += widths[c] + gap;
        }
        canvas.y += lineStepPx;
        canvas.rule(margin, canvas.y - 5, pageWidth - margin, canvas.y - 5, pageFaint);
    }
    canvas.y += lineStepPx / 2;
}

void drawPoints(PageCanvas& canvas, const SuggestPage& page, int plotHeight) {
    const int left = margin + 70, right = pageWidth - margin, top = canvas.y + 24,
              bottom = canvas.y + plotHeight - 56;
    std::vector<double> errors, costs;
    for (const SuggestPage::Point& point : page.points) {
        errors.push_back(point.errorPx);
        costs.push_back(point.costShare);
    }
    if (page.errorLimitPx > 0) errors.push_back(page.errorLimitPx);
    costs.push_back(1);
    const LogAxis x = logAxisOver(errors), y = logAxisOver(costs);
    const auto px = [&](double value) { return left + static_cast<int>(x.position(value) * (right - left)); };
    const auto py = [&](double value) {
        return bottom - static_cast<int>(y.position(value) * (bottom - top));
    };
    for (const double tick : x.ticks) {
        canvas.rule(px(tick), top, px(tick), bottom, pageFaint);
        canvas.text(px(tick), bottom + 6, axisText(tick), smallPx, pageGrey, draw::TextAlignX::Center);
    }
    for (const double tick : y.ticks) {
        canvas.rule(left, py(tick), right, py(tick), pageFaint);
        canvas.text(left - 8, py(tick) - 8, axisText(tick), smallPx, pageGrey, draw::TextAlignX::Right);
    }
    if (page.limitsCosts) canvas.rule(left, py(1), right, py(1), pageRed, 2);
    if (page.errorLimitPx > 0)
        canvas.rule(px(page.errorLimitPx), top, px(page.errorLimitPx), bottom, pageRed, 2);
    for (const SuggestPage::Point& point : page.points) {
        if (!point.isBest && !point.isBefore)
            canvas.disc(px(point.errorPx), py(point.costShare), point.isWhole ? 5 : 3,
                        point.isWhole ? pageBlue : pageGrey);
    }
    for (const SuggestPage::Point& point : page.points) {
        if (!point.isBest && !point.isBefore) continue;
        canvas.disc(px(point.errorPx), py(point.costShare), 9, point.isBest ? pageGreen : pageInk);
        const std::string label = point.isBest ? "suggested" : "before";
        const bool isRoom = px(point.errorPx) + 14 + canvas.widthOf(label, smallPx) <= right;
        canvas.text(px(point.errorPx) + (isRoom ? 14 : -14), py(point.costShare) - 10, label, smallPx,
                    point.isBest ? pageGreen : pageInk,
                    isRoom ? draw::TextAlignX::Left : draw::TextAlignX::Right);
    }
    canvas.text(left, top - 24,
                "Largest share of a budget of costs (red: limits; blue: all frames; grey: samples)", smallPx,
                pageGrey);
    canvas.text((left + right) / 2, bottom + 28, "drawn error, px", smallPx, pageGrey,
                draw::TextAlignX::Center);
    canvas.y += plotHeight;
}

ImageBuf bufferOf(const Picture& picture) {
    ImageBuf buffer(OIIO::ImageSpec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8));
    buffer.set_pixels(OIIO::ROI::All(), OIIO::TypeDesc::UINT8, picture.rgb.data());
    return buffer;
}

void drawPlaces(PageCanvas& canvas, const SuggestPage& page, int bottom) {
    const std::size_t count = std::min<std::size_t>(page.places.size(), 4);
    const int gap = 24, columns = 2, rows = static_cast<int>((count + 1) / 2);
    if (count == 0 || page.places.front().picture.rgb.empty()) return;
    const int cellWidth = (pageWidth - 2 * margin - gap) / columns;
    const int cellHeight = (bottom - canvas.y) / std::max(rows, 1);
    for (std::size_t i = 0; i < count; ++i) {
        const SuggestPage::Place& place = page.places[i];
        if (place.picture.rgb.empty()) continue;
        const int x = margin + static_cast<int>(i % 2) * (cellWidth + gap);
        const int y = canvas.y + static_cast<int>(i / 2) * cellHeight;
        const double scale = std::min(static_cast<double>(cellWidth) / place.picture.width,
                                      static_cast<double>(cellHeight - 34) / place.picture.height);
        if (scale <= 0.02) continue;
        const int smallWidth = std::max(static_cast<int>(scale * place.picture.width), 1);
        const int smallHeight = std::max(static_cast<int>(scale * place.picture.height), 1);
        const ImageBuf small = draw::resize(bufferOf(place.picture), "box", 0,
                                            OIIO::ROI(0, smallWidth, 0, smallHeight, 0, 1, 0, 3));
        draw::paste(canvas.image, x, y, 0, 0, small);
        canvas.text(x, y + smallHeight + 6, place.caption, smallPx);
    }
    canvas.y = bottom;
}

Picture pictureOf(const ImageBuf& image) {
    Picture picture{pageWidth, pageHeight, {}};
    picture.rgb.resize(static_cast<std::size_t>(pageWidth) * pageHeight * 3);
    image.get_pixels(OIIO::ROI(0, pageWidth, 0, pageHeight, 0, 1, 0, 3), OIIO::TypeDesc::UINT8,
                     picture.rgb.data());
    return picture;
}

}  // namespace

planet::Result<Picture> drawSuggestPage(const SuggestPage& page) {
    PageCanvas canvas;
    draw::fill(canvas.image, std::array<float, 3>{1, 1, 1});
    canvas.text(margin, canvas.y, page.title, titlePx);
    canvas.y += titlePx + 24;
    canvas.rule(margin, canvas.y - 8, pageWidth - margin, canvas.y - 8, page.isMet ? pageGreen : pageRed, 4);
    canvas.y += 12;
    for (const std::string& paragraph : page.paragraphs) canvas.paragraph(paragraph);
    for (const auto& table : page.tables) drawTable(canvas, table);
    constexpr int leastPlotHeight = 180, mostPlotHeight = 300;
    const int noteLines = static_cast<int>(canvas.linesOf(page.notes, smallPx).size());
    const int notesHeight = noteLines * PageCanvas::stepOf(smallPx) + 12;
    const int foot = pageHeight - margin - notesHeight;
    const int room = foot - canvas.y;
    if (!page.points.empty() && room > leastPlotHeight)
        drawPoints(canvas, page, std::clamp(room / 2, leastPlotHeight, mostPlotHeight));
    if (foot - canvas.y > 120) drawPlaces(canvas, page, foot);
    canvas.y = std::max(canvas.y, foot) + 12;
    canvas.paragraph(page.notes, smallPx, pageGrey);
    if (!canvas.hasFont) {
        return planet::ioError(fmt::format(
            "{}: cannot be used as a font; expected DejaVu Sans, which labels the page", pageFont));
    }
    return pictureOf(canvas.image);
}

}  // namespace worldy
