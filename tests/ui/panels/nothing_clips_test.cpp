// Every panel in the docks of a usual and of a small window: no control, title or cell is cut off, and the layouts that
// are made for wide tables show them without scrolling sideways.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/data/layout_library.h"
#include "tests/support/clipping.h"
#include "tests/support/editor_fixture.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/planet_fixture.h"
#include "tests/support/temporary_folder.h"
#include "ui/model/docking.h"

namespace worldy::ui {
namespace {

using testing::IsEmpty;

// An editor with a planet, a trace and results in all instruments.
class EveryPanel : public testing::Test {
protected:
    EveryPanel() : editor_(planet::openFake()) {
        editor_.fly({}, 30);
        editor_.trace(folder_ / "made engine.lodtrace");
        measureErrors();
        measurePops();
        sweep();
        compare();
    }

    void measureErrors() {
        planet::TrueErrorReport report;
        for (const planet::DrawItem& item : editor_.view().planet->selection().draw) {
            report.chunks.push_back({.id = item.id,
                                     .epsPx = 1.2345,
                                     .drawnBoundPx = 12.345,
                                     .facingPx = 0.0012345,
                                     .screenPx = 0.0012345,
                                     .errorM = 1234.5,
                                     .meanPx = 0.00012345});
        }
        errors_ = measurementOf(std::move(report));
    }

    void measurePops() {
        const auto planet = planet::openFake();
        planet::LodSettings settings = planet::fineSettings();
        double timeS = 0;
        for (const double altitudeM : {150e3, 8e3, 150e3, 20e3}) {
            const planet::View view = planet::viewAt(30, 20, altitudeM);
            planet->settle(view, settings, planet::noUpload, planet::timeoutS);
            pops_.add(planet->tree(), planet->selection(), view, settings, timeS += 40);
        }
    }

    void sweep() {
        for (const int size : {33, 129}) {
            for (const double tauPx : {0.5, 1.0, 2.0, 64.0}) {
                SweepPoint point{size, planet::ErrorMetric::Additive, tauPx};
                point.figures.meanTriangles = 123'456 / tauPx;
                point.figures.worstMeasuredPx = 0.0123 * tauPx;
                point.figures.p99MeasuredPx = 0.00123 * tauPx;
                point.figures.worstEpsPx = 1.234 * tauPx;
                point.figures.worstDrawnBoundPx = 1e6;
                point.figures.mostResidentMiB = 123.4 / tauPx;
                point.figures.medianFrameMs = 12.34;
                sweep_.points.push_back(point);
            }
        }
    }

    void compare() {
        compared_[0].triangles = compared_[0].groundTriangles = 1.2345e6;
        compared_[1].triangles = compared_[1].groundTriangles = 0.98765e6;
        for (ComparedFigures& figures : compared_) {
            figures.residentBytes = figures.bytesRead = 99.9 * 1024 * 1024;
            figures.frameMs = figures.drawMs = figures.selectMs = 12.345;
            figures.worstEpsPx = figures.worstDrawnBoundPx = figures.worstErrorPx = 12.345;
            figures.worstPopPx = figures.p99PopPx = 0.012345;
            figures.crackPx = figures.leakingPx = 12345;
        }
    }

    EditorView view() {
        EditorView view = editor_.view();
        view.instruments.errors.last = &errors_;
        view.instruments.pops.meter = &pops_;
        view.sweep.table = &sweep_;
        view.compare.on = true;
        view.compare.origin = "snapshot";
        view.compare.fileA = "/home/me/earth.chk";
        view.compare.fileB = "/home/me/earth of another bake.chk";
        view.compare.names = {"earth.chk", "earth of another bake.chk"};
        view.compare.different = differences_;
        view.compare.now = compared_;
        view.compare.flight.last = &compared_;
        return view;
    }

    // Draws a panel as it is in a dock of this size until its sizes are settled. Text as large as scale says.
    void draw(PanelId panel, const Rect& rect) {
        const EditorView shown = view();
        PanelWindow::resize({rect.width, rect.height});
        Commands commands;
        for (int frame = 0; frame < 6; ++frame) {
            window_.frame([&] {
                ImGui::BeginChild("panel");
                drawPanel(panel, shown, states_, settings_, commands);
                scrollMaxYPx_ = ImGui::GetScrollMaxY();
                ImGui::EndChild();
            });
        }
    }

    static void scaleText(float scale) {
        applyTheme(Theme::Dark, scale);
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
        // The size of the font is that of the frame before.
        ImGui::NewFrame();
        ImGui::Render();
    }

    static Rect dockOf(const Workspace& workspace, Dock dock, ImVec2 window) {
        return layoutOf(window.x, window.y, workspace, 22, 24, unitPx())
            .docks[static_cast<std::size_t>(dock)];
    }

    const tests::TemporaryFolder folder_;
    test::EditorFixture editor_;
    ErrorMeasurement errors_;
    planet::PopMeter pops_;
    SweepTable sweep_;
    std::array<ComparedFigures, 2> compared_;
    std::vector<SettingDifference> differences_{
        {"overlay.skirt_paint", "as_ground", "loud_alone", "Skirts"},
        {"surface.vertical_exaggeration", "1", "12.5", "Vertical exaggeration"}};
    PanelWindow window_{{1600, 1000}};
    PanelStates states_;
    ViewSettings settings_;
    float scrollMaxYPx_ = 0;
};

TEST_F(EveryPanel, clipsNothingInAUsualWindow) {
    scaleText(1);
    for (const PanelInfo& info : panelInfos) {
        draw(info.id, dockOf({}, info.dock, {1600, 1000}));
        EXPECT_THAT(clippedParts(), IsEmpty()) << info.title;
    }
}

TEST_F(EveryPanel, clipsNothingInASmallWindowWithTheLargestText) {
    scaleText(static_cast<float>(fittingScale(3, 1024, 640, baseFontPx)));
    for (const PanelInfo& info : panelInfos) {
        draw(info.id, dockOf({}, info.dock, {1024, 640}));
        EXPECT_THAT(clippedParts(), IsEmpty()) << info.title;
    }
}

TEST_F(EveryPanel, theWideTablesFitIntoTheLayoutsMadeForThem) {
    scaleText(1);
    const LayoutLibrary library(
        {std::filesystem::path(WORLDY_SOURCE_DIR) / "data" / "layouts", "/nonexistent"});
    const std::array<std::pair<PanelId, const char*>, 4> wide = {{{PanelId::Errors, "Measuring"},
                                                                  {PanelId::Pops, "Measuring"},
                                                                  {PanelId::Sweep, "Measuring"},
                                                                  {PanelId::Paging, "Paging"}}};
    for (const auto& [panel, layout] : wide) {
        draw(panel, dockOf(*library.load(layout), Dock::Bottom, {1600, 1000}));
        EXPECT_FALSE(aTableScrolls()) << static_cast<int>(panel);
        // The columns are side by side, so the table is in sight.
        EXPECT_EQ(scrollMaxYPx_, 0) << static_cast<int>(panel);
    }
    draw(PanelId::Pops, {0, 0, 400, 1500});
    EXPECT_TRUE(aTableScrolls()) << "this test would not see a table that scrolls";
}

}  // namespace
}  // namespace worldy::ui
