#include "app/report/session_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/trigonometric.hpp>
#include <utility>

#include "app/base/new_file.h"
#include "app/base/output_file.h"
#include "app/base/picture_file.h"
#include "app/base/text.h"
#include "app/scene/frame_stats.h"
#include "app/scene/governing.h"
#include "app/settings/settings_text.h"
#include "planet/format/chunk_file_types.h"
#include "planet/sphere/cube_sphere.h"
#include "ui/model/figures.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using ui::EditorView;
using ui::Figures;

constexpr const char* planetPicture = "planet.png";
constexpr const char* windowPicture = "window.png";
constexpr const char* notMeasured = "Not measured.\n";

// Returns text that Markdown shows as it is, on one line.
std::string shown(std::string_view text) {
    std::string escaped;
    for (const char letter : text) {
        constexpr std::string_view special = "\\`*_{}[]<>#|~";
        if (letter == '\n' || letter == '\r' || letter == '\t') {
            escaped += ' ';
            continue;
        }
        if (special.find(letter) != std::string_view::npos) escaped += '\\';
        escaped += letter;
    }
    return escaped;
}

std::string row(std::initializer_list<std::string_view> cells) {
    std::string text = "|";
    for (const std::string_view cell : cells) text += fmt::format(" {} |", shown(cell));
    return text + "\n";
}

std::string header(std::initializer_list<std::string_view> names) {
    std::string text = row(names) + "|";
    for (std::size_t i = 0; i < names.size(); ++i) text += "---|";
    return text + "\n";
}

std::string figureTable(const Figures& figures) {
    std::string text = header({"figure", "value", "meaning"});
    for (const ui::Figure& figure : figures) text += row({figure.name, figure.value, figure.explanation});
    return text;
}

std::string fileSection(const EditorView& view, const ReportFacts& facts) {
    std::string text = "\n## File\n\n" + header({"fact", "value"});
    text += row({"data set", view.data.name});
    text += row({"source", view.data.source.string()});
    text += row({"chunk file", view.data.chunkFile.string()});
    if (view.data.isFirstLook) text += row({"coarse first look", "yes: the whole bake was not done yet"});
    const planet::PlanetShape& shape = view.planet->tree().shape;
    text += row({"chunk size", fmt::format("{} vertices along a side", planet::chunkSize(shape))});
    text += row({"face size", fmt::format("{} samples along a side", planet::faceCells(shape) + 1)});
    text += row({"levels", fmt::format("0 to {}", planet::deepestLevelOf(shape))});
    text += row({"radius", fmt::format("{:.3f} km", shape.radiusM / 1000)});
    if (!facts.file) return text;
    const planet::ChunkFileInfo& info = facts.file->info();
    text += row({"quantum", fmt::format("{:g} m", info.shape.quantumM)});
    text += row({"chunks", fmt::format("{}", info.chunks)});
    text += row({"file size", bytesText(static_cast<double>(facts.file->sizeBytes()))});
    text += row({"baked from", info.source});
    text += row({"colours", info.colour ? info.colour->source : "none in the file"});
    text += row({"samples without data", fmt::format("{}", info.missingSamples)});
    return text;
}

std::string settingsSection(const Settings& settings) {
    std::string text = "\n## Settings that differ from the defaults\n\n";
    const std::vector<SettingDifference> different = differences(Settings(), settings);
    if (different.empty()) return text + "All settings have their defaults.\n";
    text += header({"setting", "name", "default", "here"});
    for (const SettingDifference& one : different) text += row({one.setting, one.label, one.here, one.there});
    return text;
}

std::string poseText(const planet::CameraPose& pose) {
    return fmt::format("{}, altitude {}, heading {:.1f}°, pitch {:.1f}°",
                       placeText(pose.latitudeDeg, pose.longitudeDeg), distanceText(pose.altitudeM),
                       pose.headingDeg, pose.pitchDeg);
}

std::string viewSection(const EditorView& view, const Settings& settings, const ReportFacts& facts) {
    std::string text = "\n## View\n\n" + header({"what", "value"});
    text += row({"camera", poseText(view.camera.pose)});
    text += row({"picture", fmt::format("{} x {} px, field of view {:g}°", view.camera.renderView.widthPx,
                                        view.camera.renderView.heightPx, settings.view.camera.fovDeg)});
    text += row({"LOD", view.camera.lodFrozen ? "frozen: the chunks were selected for an earlier view"
                                              : "selected for this view"});
    const FrameStats& stats = view.frames.stats;
    text += row({"drawn chunks", fmt::format("{}", stats.selection.drawn)});
    text += row({"triangles", countText(static_cast<double>(stats.selection.triangles()))});
    text += row({"frame time", millisecondsText(stats.frameMs)});
    text += fmt::format("\nThis command draws the view again:\n\n```sh\n{}\n```\n", facts.commandLine);
    text += "\n### Bookmarks\n\n";
    std::string bookmarks;
    for (const ui::Bookmark& bookmark : view.camera.bookmarks) {
        const auto& used = facts.usedBookmarks;
        const bool wasUsed = std::find(used.begin(), used.end(), bookmark.name) != used.end();
        if (!wasUsed && bookmark.shipped) continue;
        bookmarks += row({bookmark.name, poseText(bookmark.pose), wasUsed ? "yes" : "no"});
    }
    if (bookmarks.empty())
        return text + "None was used in this session, and there are no bookmarks of your own.\n";
    return text + header({"bookmark", "view", "used in this session"}) + bookmarks;
}

std::string trueErrorSection(const EditorView& view) {
    std::string text =
        "\n### True error\n\nHow far the drawn surface is from the finest data, measured at every finest "
        "sample under "
        "every drawn chunk.\n\n";
    const ui::ErrorsView& errors = view.instruments.errors;
    if (!errors.last) return text + notMeasured;
    if (!errors.current) text += "Out of date: the view or the settings have changed since.\n\n";
    text += fmt::format("Measured at τ {}, {} metric.\n\n", pixelsText(errors.last->tauPx),
                        errors.last->metric == planet::ErrorMetric::Tight ? "tight" : "additive");
    return text + figureTable(ui::errorFigures(*errors.last));
}

std::string crackSection(const EditorView& view) {
    std::string text =
        "\n### Cracks\n\nGaps between chunks of different levels, which skirts, strips that hang from the "
        "edges of "
        "chunks, hide.\n\n";
    const ui::CracksView& cracks = view.instruments.cracks;
    if (!cracks.measured) return text + notMeasured;
    if (!cracks.current) text += "Out of date: the camera or the drawn chunks have changed since.\n\n";
    Figures figures = ui::crackFigures(*cracks.measured);
    for (ui::Figure& figure : ui::skirtFigures(*cracks.measured, cracks.smallest))
        figures.push_back(std::move(figure));
    const double worstGapM = cracks.measured->gaps.empty() ? 0 : cracks.measured->gaps.front().gapM;
    text += figureTable(figures);
    const std::string note = roundingNote(cracks.measured->map.pixels.size(), worstGapM);
    return note.empty() ? text : text + "\n" + note + "\n";
}

std::string popSection(const EditorView& view) {
    std::string text =
        "\n### Pops\n\nHow far the surface jumps on screen in the frame in which a chunk is replaced by one "
        "of another "
        "level, since the list was cleared.\n\n";
    const planet::PopMeter* const meter = view.instruments.pops.meter;
    if (!meter || meter->totals().switches == 0) return text + notMeasured;
    return text + fmt::format("{} level changes.\n\n", meter->totals().switches) +
           figureTable(ui::popFigures(*meter, meter->percentilePx(0.5)));
}

std::string precisionSection(const EditorView& view) {
    std::string text =
        "\n### Precision\n\nHow exact the position of the vertex last under the pointer is on the GPU, and "
        "how near two "
        "surfaces may lie there.\n\n";
    const std::optional<ProbedVertex>& vertex = view.instruments.probe.vertex;
    if (!vertex) return text + notMeasured;
    Figures figures = ui::precisionFigures(vertex->precision);
    for (ui::Figure& figure : ui::depthFigures(vertex->depth)) figures.push_back(std::move(figure));
    return text + fmt::format("In chunk {}.\n\n", shown(planet::toString(vertex->precision.chunk))) +
           figureTable(figures);
}

// The heights at places at equal steps, because a profile has more points than a reader wants.
std::string profileTable(const planet::GroundProfile& profile) {
    constexpr std::size_t steps = 32;
    std::string text = header({"distance from A", "place", "finest data", "drawn surface"});
    const std::size_t last = profile.points.size() - 1;
    for (std::size_t step = 0; step <= std::min(steps, last); ++step) {
        const planet::ProfilePoint& point = profile.points[step * last / std::min(steps, last)];
        const planet::Geographic place = planet::geographicFromDirection(point.direction);
        text += row({distanceText(point.alongM),
                     placeText(glm::degrees(place.latitudeRad), glm::degrees(place.longitudeRad), 6),
                     ui::heightText(point.finestM), point.drawnM ? ui::heightText(*point.drawnM) : "-"});
    }
    return text;
}

std::string rulerSection(const EditorView& view) {
    std::string text =
        "\n### Ruler\n\nThe ground between two places, A and B. Heights are above the planet's radius and "
        "have the vertical exaggeration of the picture.\n\n";
    const ui::RulerView& ruler = view.instruments.ruler;
    if (ruler.ends.size() < 2) return text + notMeasured;
    if (!ruler.problem.empty()) return text + fmt::format("Not measured: {}\n", shown(ruler.problem));
    if (ruler.measured && !ruler.current)
        text += "Out of date: the drawn chunks have changed since the ground was measured.\n\n";
    text += figureTable(ui::rulerFigures(ruler));
    if (!ruler.measured) return text + "\nThe ground between them is not measured yet.\n";
    if (ruler.measured->profile.points.size() < 2) return text;
    return text + "\nThe heights on the way:\n\n" + profileTable(ruler.measured->profile);
}

std::string costSection(const EditorView& view) {
    const std::string text =
        "\n### Costs of features\n\nHow much longer a frame takes with each feature of light and "
        "surface.\n\n";
    const std::vector<PartCost>& costs = view.instruments.light.costs;
    return text + (costs.empty() ? notMeasured : figureTable(ui::costFigures(costs)));
}

std::string sweepSection(const EditorView& view) {
    std::string text =
        "\n### Sweep\n\nOne flight with many tolerances: what each costs, and its largest true error. On the "
        "front: no other "
        "setting is both cheaper and more accurate.\n\n";
    if (!view.sweep.table || view.sweep.table->points.empty()) return text + notMeasured;
    std::vector<SweepPoint> points = view.sweep.table->points;
    markFront(points, SweepCost::Triangles);
    text += fmt::format("Over {}{}.\n\n", shown(view.sweep.table->flight),
                        view.sweep.table->whole ? "" : ", not complete");
    text += header({"metric", "chunk size", "τ", "triangles, mean", "max true error", "P99 true error",
                    "memory, most", "frame time, median", "violations", "on the front"});
    for (const SweepPoint& point : points) {
        const FlightFigures& f = point.figures;
        text += row({metricName(point.metric), fmt::format("{}", point.chunkSize),
                     fmt::format("{:.3g} px", point.tauPx), countText(f.meanTriangles),
                     ui::finePx(f.worstMeasuredPx), ui::finePx(f.p99MeasuredPx),
                     fmt::format("{:.3g} MiB", f.mostResidentMiB), fmt::format("{:.3g} ms", f.medianFrameMs),
                     fmt::format("{}", f.violations), point.onFront ? "yes" : "no"});
    }
    return text;
}

std::string comparedTable(const std::array<ComparedFigures, 2>& sides, bool live) {
    std::string text = header({"figure", "A", "B", "B / A", "meaning"});
    for (const CompareRow& figure : compareRows()) {
        if (!(live ? figure.live : figure.flight)) continue;
        const auto& a = sides[0].*figure.value;
        const auto& b = sides[1].*figure.value;
        text += row({figure.name, figureText(figure, a), figureText(figure, b), changeText(figure, a, b),
                     figure.explanation});
    }
    return text;
}

std::string compareSection(const EditorView& view) {
    std::string text =
        "\n### Comparison\n\nThe shown planet, A, beside a second one, B, with other settings or another "
        "bake.\n\n";
    const ui::CompareView& compare = view.compare;
    if (!compare.on && !compare.flight.last) return text + notMeasured;
    if (compare.on) {
        text += fmt::format("B: {}.\n\n", shown(compare.origin));
        if (compare.stale)
            text += "Out of date: the view or the settings have changed since the last measurement.\n\n";
        if (!compare.different.empty()) {
            text += header({"setting", "A", "B"});
            for (const SettingDifference& one : compare.different)
                text += row({one.setting, one.here, one.there});
            text += "\n";
        }
        text += comparedTable(compare.now, true);
    }
    if (compare.flight.last)
        text += fmt::format("\nOver a flight: {}\n\n", shown(compare.flight.lastName)) +
                comparedTable(*compare.flight.last, false);
    return text;
}

std::string noteSection(const EditorView& view) {
    std::string text = "\n## Notes\n\n";
    if (view.notes.notes.empty()) return text + "There are no notes on this planet.\n";
    text += header({"note", "about", "place", "chunk", "figures then", "written"});
    for (const Note& note : view.notes.notes)
        text += row({note.text, note.about, placeText(note.latitudeDeg, note.longitudeDeg), note.chunk,
                     note.measurement, note.created});
    return text;
}

constexpr const char* terms = R"(
## Terms

- **chunk**: the mesh of one square of the planet's surface. All chunks have the same number of vertices; the finer the
  level, the smaller the square.
- **level**: 0 for a chunk that covers one of the six faces of the cube that is projected onto the sphere. Each further
  level halves the side of a chunk.
- **δc**: the error bound of a chunk, in metres: how far its surface can be from the finest data under it.
- **ε**: δc seen on the screen from the camera, in pixels; also called screen-space error.
- **τ, tolerance**: the error in pixels up to which a chunk is drawn; beyond it, its four finer chunks are drawn.
- **drawn bound**: the bound of the error of what is drawn, in pixels, while chunks slide from one level into another too.
- **violation**: a chunk whose measured error exceeds its drawn bound, which is a fault of the program or the file.
- **skirt**: a strip that hangs from the edge of a chunk towards the planet's centre and hides cracks.
- **facing pixels**: pixels as if the camera looked straight at the place, without the stretching towards the corners.
- **P99**: 99 % of the values are no larger.
)";

}  // namespace

std::string sessionReport(const EditorView& view, const Settings& settings, const ReportFacts& facts) {
    const BudgetUse& budget = view.frames.stats.budget;
    std::string text = fmt::format("# Worldy: session report on {}\n\n", shown(view.data.name));
    text += fmt::format(
        "Written on {} by Worldy {}, with {}. Worldy shows a planet by chunked level of detail: near ground "
        "is drawn with "
        "fine chunks, far ground with coarse ones, so that the error on the screen stays below a tolerance "
        "τ, here {}{}. The "
        "last section explains the terms.\n\n",
        facts.writtenAt, facts.version, shown(facts.openGl), pixelsText(settings.view.lod.tauPx),
        budget.isOn ? fmt::format(", chosen by a budget ({})", bindsText(budget, "τ")) : "");
    text +=
        fmt::format("![The view]({})\n\n![The window with its panels]({})\n", planetPicture, windowPicture);
    text += fileSection(view, facts) + settingsSection(settings) + viewSection(view, settings, facts);
    text += "\n## Measurements\n";
    text += trueErrorSection(view) + crackSection(view) + popSection(view) + precisionSection(view);
    text += rulerSection(view) + costSection(view) + sweepSection(view) + compareSection(view);
    return text + noteSection(view) + terms;
}

planet::Result<fs::path> writeSessionReport(const fs::path& folder, const std::string& report,
                                            const Picture& planet, const Picture& window) {
    planet::Result<fs::path> into = newTimedFolder(folder, localTimeNow(), "report");
    if (!into) return into;
    planet::Result<void> written = writePicture(window, *into / windowPicture);
    if (written) written = writePicture(planet.rgb.empty() ? window : planet, *into / planetPicture);
    if (written) written = writeTextFile(*into / "report.md", report);
    if (written) return into;
    std::error_code status;
    fs::remove_all(*into, status);  // the folder is new, so it holds nothing else
    return tl::unexpected(written.error());
}

}  // namespace worldy
