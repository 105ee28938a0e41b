#include "app/measure/sweep_plot.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "app/base/plot_scale.h"
#include "app/base/utf8.h"
#include "app/measure/sweep_points.h"

namespace worldy {

namespace {

using OIIO::ImageBuf;
namespace draw = OIIO::ImageBufAlgo;
using Colour = std::array<float, 4>;

constexpr const char* font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
// The plot is drawn at twice the size and averaged down, because lines are not antialiased.
constexpr int finer = 2;
constexpr int width = 1100 * finer;
constexpr int height = 720 * finer;
constexpr int plotLeft = 110 * finer;
constexpr int plotRight = width - 220 * finer;
constexpr int plotTop = 60 * finer;
constexpr int plotBottom = height - 80 * finer;
constexpr int textSize = 14 * finer;
constexpr Colour ink = {0.10f, 0.11f, 0.13f, 1};
constexpr Colour faint = {0.86f, 0.87f, 0.89f, 1};
// Colours after Okabe and Ito, which people with colour blindness can tell apart.
constexpr std::array<Colour, 6> seriesColours = {{{0.00f, 0.45f, 0.70f, 1},
                                                  {0.84f, 0.37f, 0.00f, 1},
                                                  {0.00f, 0.62f, 0.45f, 1},
                                                  {0.80f, 0.47f, 0.65f, 1},
                                                  {0.34f, 0.71f, 0.91f, 1},
                                                  {0.90f, 0.62f, 0.00f, 1}}};

std::string tickText(double value) {
    if (value >= 1e6) return fmt::format("{:g} M", value / 1e6);
    if (value >= 1e4) return fmt::format("{:g} k", value / 1e3);
    return fmt::format("{:g}", value);
}

struct Plot {
    ImageBuf image{OIIO::ImageSpec(width, height, 4, OIIO::TypeDesc::FLOAT)};
    LogAxis errors;
    LogAxis costs;

    int x(double error) const {
        return plotLeft + static_cast<int>(errors.position(error) * (plotRight - plotLeft));
    }
    int y(double cost) const {
        return plotBottom - static_cast<int>(costs.position(cost) * (plotBottom - plotTop));
    }

    // OpenImageIO 2.4 draws letters beyond ASCII as others: it keeps only the last six bits of each.
    bool text(int atX, int atY, const std::string& words, draw::TextAlignX align = draw::TextAlignX::Left,
              const Colour& colour = ink, int size = textSize) {
        return draw::render_text(image, atX, atY, asciiOf(words), size, font, colour, align,
                                 draw::TextAlignY::Center);
    }
    void line(int x1, int y1, int x2, int y2, const Colour& colour, int thickness = finer) {
        for (int away = -thickness / 2; away <= thickness / 2; ++away) {
            draw::render_line(image, x1 + away, y1, x2 + away, y2, colour);
            draw::render_line(image, x1, y1 + away, x2, y2 + away, colour);
        }
    }
    void disc(int atX, int atY, int radius, const Colour& colour) {
        for (int row = -radius; row <= radius; ++row) {
            const auto half = static_cast<int>(std::sqrt(static_cast<double>(radius * radius - row * row)));
            draw::render_line(image, atX - half, atY + row, atX + half, atY + row, colour);
        }
    }
};

bool drawAxes(Plot& plot, SweepCost cost, const std::string& title) {
    for (const double tick : plot.errors.ticks) {
        plot.line(plot.x(tick), plotTop, plot.x(tick), plotBottom, faint);
        plot.text(plot.x(tick), plotBottom + 18 * finer, tickText(tick), draw::TextAlignX::Center);
    }
    for (const double tick : plot.costs.ticks) {
        plot.line(plotLeft, plot.y(tick), plotRight, plot.y(tick), faint);
        plot.text(plotLeft - 10 * finer, plot.y(tick), tickText(tick), draw::TextAlignX::Right);
    }
    plot.line(plotLeft, plotBottom, plotRight, plotBottom, ink);
    plot.line(plotLeft, plotTop, plotLeft, plotBottom, ink);
    plot.text((plotLeft + plotRight) / 2, plotBottom + 48 * finer, "max measured error, px",
              draw::TextAlignX::Center);
    plot.text(plotLeft, plotTop - 16 * finer, costName(cost));
    return plot.text((plotLeft + plotRight) / 2, 22 * finer, title, draw::TextAlignX::Center, ink,
                     textSize * 5 / 4);
}

void drawSeries(Plot& plot, std::span<const SweepPoint> points, SweepCost cost) {
    std::size_t index = 0;
    const auto xOf = [&](std::size_t i) { return plot.x(plottedErrorPx(points[i].figures)); };
    const auto yOf = [&](std::size_t i) { return plot.y(plottedCost(points[i].figures, cost)); };
    for (const SweepSeries& series : seriesOf(points)) {
        const Colour& colour = seriesColours[index % seriesColours.size()];
        for (std::size_t i = 0; i + 1 < series.points.size(); ++i) {
            const std::size_t a = series.points[i], b = series.points[i + 1];
            plot.line(xOf(a), yOf(a), xOf(b), yOf(b), colour);
        }
        for (const std::size_t i : series.points) {
            const SweepPoint& point = points[i];
            const int x = xOf(i), y = yOf(i);
            if (point.onFront) {
                plot.disc(x, y, 9 * finer, ink);
                plot.disc(x, y, 8 * finer, {1, 1, 1, 1});
            }
            plot.disc(x, y, 5 * finer, colour);
            plot.text(x + 12 * finer, y - 12 * finer, fmt::format("{:g}", point.tauPx),
                      draw::TextAlignX::Left, colour);
        }
        const int legendY = plotTop + static_cast<int>(index) * 26 * finer;
        plot.disc(plotRight + 30 * finer, legendY, 5 * finer, colour);
        plot.text(plotRight + 44 * finer, legendY,
                  fmt::format("{} per side, {}", series.chunkSize, metricName(series.metric)));
        ++index;
    }
    const int legendY = plotTop + static_cast<int>(index) * 26 * finer;
    plot.disc(plotRight + 30 * finer, legendY, 9 * finer, ink);
    plot.disc(plotRight + 30 * finer, legendY, 8 * finer, {1, 1, 1, 1});
    plot.text(plotRight + 44 * finer, legendY, "Pareto front");
    plot.text(plotRight + 20 * finer, legendY + 26 * finer, "labels: τ, px");
}

Picture smaller(const ImageBuf& image) {
    const ImageBuf small = draw::resize(image, "box", 0, OIIO::ROI(0, width / finer, 0, height / finer));
    Picture picture{width / finer, height / finer, {}};
    picture.rgb.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) *
                       3);
    small.get_pixels(OIIO::ROI(0, picture.width, 0, picture.height, 0, 1, 0, 3), OIIO::TypeDesc::UINT8,
                     picture.rgb.data());
    return picture;
}

}  // namespace

planet::Result<Picture> plotSweep(std::span<const SweepPoint> points, SweepCost cost,
                                  const std::string& title) {
    std::vector<double> errors;
    std::vector<double> costs;
    for (const SweepPoint& point : points) {
        errors.push_back(plottedErrorPx(point.figures));
        costs.push_back(plottedCost(point.figures, cost));
    }
    Plot plot;
    plot.errors = logAxisOver(errors);
    plot.costs = logAxisOver(costs);
    draw::fill(plot.image, Colour{1, 1, 1, 1});
    if (!drawAxes(plot, cost, title))
        return planet::ioError(
            fmt::format("{}: cannot be used as a font; expected DejaVu Sans, which labels the plot", font));
    drawSeries(plot, points, cost);
    return smaller(plot.image);
}

}  // namespace worldy
