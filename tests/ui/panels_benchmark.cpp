// What each panel costs on the CPU a frame, at 1600 x 1000: laying it out and making its draw lists, without
// drawing them. The planet has 5,000 or 50,000 resident chunks, about a fifth of them drawn.
#include <benchmark/benchmark.h>
#include <imgui.h>

#include <cmath>
#include <map>

#include "tests/support/editor_fixture.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace {

using namespace planet;

// Any chunk of a planet of chunks of 17, made when it is asked for: waves, and an error that halves twice a
// level.
ChunkData chunkOf(const PlanetShape& shape, const ChunkId& id) {
    ChunkData chunk;
    chunk.id = id;
    const bool leaf = id.level == deepestLevelOf(shape);
    chunk.deltaCM = leaf ? 0.0f : static_cast<float>(60000 * std::pow(0.4, id.level));
    chunk.deltaTightM = 0.6f * chunk.deltaCM;
    chunk.minStep = -500;
    chunk.maxStep = 500;
    if (!leaf) chunk.children = {keyOf(id) + 1, 100};
    const FaceSquare square = faceSquareOf(id);
    const int size = chunkSize(shape);
    std::vector<std::int16_t> steps;
    steps.reserve(static_cast<std::size_t>(chunkVertexCount(shape)));
    for (int row = 0; row < size; ++row) {
        for (int column = 0; column < size; ++column) {
            const double u = square.u + square.side * column / (size - 1);
            const double v = square.v + square.side * row / (size - 1);
            steps.push_back(static_cast<std::int16_t>(400 * std::sin(9 * u) * std::cos(7 * v)));
        }
    }
    chunk.heights = steps;
    return chunk;
}

PlanetSource wavyPlanet() {
    PlanetSource source;
    source.shape.chunkCellsLog2 = 4;
    source.shape.faceCellsLog2 = 18;
    source.minStep = -500;
    source.maxStep = 500;
    for (const Face face : allFaces) {
        source.roots[static_cast<std::size_t>(face)] = chunkOf(source.shape, {face, 0, 0, 0});
    }
    source.loadChildren = [shape = source.shape](const ChunkId& parent, BlockLocation,
                                                 planet::StepsView) -> Result<SiblingBlock> {
        SiblingBlock block;
        for (int q = 0; q < quadrantCount; ++q)
            block[static_cast<std::size_t>(q)] = chunkOf(shape, childOf(parent, q));
        return block;
    };
    return source;
}

// The finest tolerance that keeps a number of chunks, by halving the interval.
std::unique_ptr<worldy::test::EditorFixture> fixtureWith(std::size_t residentChunks) {
    double low = 0.0005, high = 64;
    std::unique_ptr<worldy::test::EditorFixture> best;
    for (int i = 0; i < 11; ++i) {
        worldy::ViewSettings settings;
        settings.lod.tauPx = std::sqrt(low * high);
        auto planet =
            Planet::open(wavyPlanet(), {.budgetBytes = std::size_t{1} << 30, .uploadLimitMs = 1000});
        auto fixture = std::make_unique<worldy::test::EditorFixture>(std::move(*planet));
        fixture->fly(settings, 40);
        const bool tooMany = fixture->view().planet->tree().residentChunks > residentChunks;
        (tooMany ? low : high) = settings.lod.tauPx;
        if (!tooMany || !best) best = std::move(fixture);
    }
    return best;
}

const worldy::ui::EditorView viewWith(std::size_t residentChunks) {
    static std::map<std::size_t, std::unique_ptr<worldy::test::EditorFixture>> fixtures;
    auto& fixture = fixtures[residentChunks];
    if (!fixture) {
        fixture = fixtureWith(residentChunks);
        for (int i = 0; i < 2000; ++i)
            fixture->log_.push_back({worldy::LogLevel::Info, "14:03:22", "Open: earth.chk, 5.1 MiB on disk"});
    }
    return fixture->view();
}

void startImGui() {
    if (ImGui::GetCurrentContext()) return;
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().DisplaySize = {1600, 1000};
    worldy::ui::applyTheme(worldy::Theme::Dark, 1);
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
}

// Where docks put it in a window of 1600 x 1000.
worldy::ui::Rect placeOf(const worldy::PanelInfo& info) {
    const worldy::ui::Layout layout = worldy::ui::layoutOf(1600, 1000, {}, 22, 24, worldy::ui::unitPx());
    return layout.docks[static_cast<std::size_t>(info.dock)];
}

void drawPanels(benchmark::State& state, std::size_t residentChunks,
                const std::vector<worldy::PanelInfo>& panels) {
    startImGui();
    const worldy::ui::EditorView view = viewWith(residentChunks);
    worldy::ui::PanelStates states;
    worldy::ViewSettings settings;
    worldy::ui::Commands commands;
    for (auto _ : state) {
        ImGui::GetIO().DeltaTime = 1.0f / 60;
        ImGui::NewFrame();
        for (const worldy::PanelInfo& info : panels) {
            worldy::ui::beginFixedWindow(info.title, placeOf(info));
            worldy::ui::drawPanel(info.id, view, states, settings, commands);
            ImGui::End();
        }
        ImGui::Render();
        commands.clear();
    }
    state.counters["resident"] = static_cast<double>(view.planet->tree().residentChunks);
    state.counters["drawn"] = static_cast<double>(view.planet->selection().draw.size());
}

}  // namespace

int main(int argumentCount, char** arguments) {
    benchmark::Initialize(&argumentCount, arguments);
    const std::vector<worldy::PanelInfo> all(worldy::panelInfos.begin(), worldy::panelInfos.end());
    for (const std::size_t chunks : {std::size_t{5000}, std::size_t{50000}}) {
        const auto add = [&](const std::string& name, const std::vector<worldy::PanelInfo>& panels) {
            benchmark::RegisterBenchmark((name + "/" + std::to_string(chunks)).c_str(),
                                         [=](benchmark::State& state) { drawPanels(state, chunks, panels); })
                ->Unit(benchmark::kMillisecond);
        };
        add("all panels", all);
        for (const worldy::PanelInfo& info : all) add(info.title, {info});
    }
    benchmark::RunSpecifiedBenchmarks();
}
