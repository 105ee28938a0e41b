// The table of what the program holds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <string_view>

#include "app/session/allocations.h"
#include "tests/app/session_fixture.h"
#include "tests/support/panel_fixture.h"
#include "ui/panels/frame/allocation_table.h"

namespace worldy {
namespace {

using testing::HasSubstr;

const ui::AllocationRow& rowNamed(std::string_view name) {
    const auto rows = ui::allocationRows();
    return *std::find_if(rows.begin(), rows.end(),
                         [&](const ui::AllocationRow& row) { return row.name == name; });
}

TEST(AllocationTable, TellsWhatHasChangedSinceTheMark) {
    ui::Allocations before, now;
    before.process.heapBytes = 5 << 20;
    now.process.heapBytes = 8 << 20;
    before.process.threads = 7;
    now.process.threads = 4;
    before.process.openFiles = now.process.openFiles = 9;
    EXPECT_EQ(ui::allocationChange(rowNamed("Heap in use"), before, now), "+3.00 MiB");
    EXPECT_EQ(ui::allocationChange(rowNamed("Threads"), before, now), "-3");
    EXPECT_EQ(ui::allocationChange(rowNamed("Open files"), before, now), "=");
    EXPECT_EQ(ui::allocationText(rowNamed("Threads"), now), "4");
    const ui::AllocationsView view{now, before};
    std::vector<std::size_t> rows(ui::allocationRows().size());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    const std::string text = ui::tsvOf(ui::allocationExport(view), rows, false);
    EXPECT_THAT(text, HasSubstr("group\tkind\tunit\tnow\tmark\tchange\n"));
    EXPECT_THAT(text, HasSubstr("Process\tThreads\tcount\t4\t7\t-3\n"));
    EXPECT_THAT(text, HasSubstr("Process\tHeap in use\tbytes\t8388608\t5242880\t3145728\n"));
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'),
              static_cast<std::ptrdiff_t>(ui::allocationRows().size()) + 1);
}

TEST(AllocationTable, SortsByUnroundedValuesAndSignedChanges) {
    ui::Allocations before, now;
    before.process.heapBytes = 5 << 20;
    now.process.heapBytes = (5 << 20) + 1;
    before.process.threads = 7;
    now.process.threads = 4;
    const ui::AllocationsView view{now, before};
    const auto key = [&](std::string_view name, ui::AllocationColumn column) {
        const auto row = static_cast<std::size_t>(&rowNamed(name) - ui::allocationRows().data());
        return ui::allocationSortKey(row, column, view);
    };
    using Column = ui::AllocationColumn;
    EXPECT_EQ(key("Heap in use", Column::Change), ui::SortKey(1.0));
    EXPECT_EQ(key("Threads", Column::Change), ui::SortKey(-3.0));
    EXPECT_EQ(key("Threads", Column::Now), ui::SortKey(4.0));
    EXPECT_EQ(key("Threads", Column::Mark), ui::SortKey(7.0));
    EXPECT_EQ(key("Textures##objects", Column::Kind), ui::SortKey(std::string("Textures")));
}

TEST(AllocationTable, EachRowHasANameOfItsOwnAndSaysWhatItIs) {
    std::set<std::string_view> names;
    for (const ui::AllocationRow& row : ui::allocationRows()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_GT(std::string_view(row.explanation).size(), 5u) << row.name;
    }
    EXPECT_NE(ui::allocationRows().front().group, nullptr);
}

TEST(AllocationTable, theMarkIsAskedFor) {
    for (const float width : {300.0f, 900.0f}) {
        ui::PanelWindow window({width, 900});
        ui::AllocationsView view;
        ui::Commands all;
        const auto frame = [&] { window.frame([&] { ui::allocationTable(view, 5, all); }); };
        frame();
        EXPECT_FALSE(window.isShown("Mark"));  // nothing is counted yet
        view.now.emplace();
        frame();
        frame();
        EXPECT_TRUE(all.empty());
        window.click("Mark", 0.5f, frame);
        ASSERT_EQ(all.size(), 1u);
        EXPECT_TRUE(all[0].as<ui::MarkAllocations>());
    }
}

class Counting : public test::SessionTest {};

TEST_F(Counting, WhatASessionHoldsIsCountedByKind) {
    Session session = sessionOf(bakeTo("a.chk", {.faceSize = 65, .chunkSize = 17}));
    ui::AllocationsView allocations;
    const auto watch = [&](double timeS, bool panelShown = true, bool mark = false) {
        watchAllocations({.session = session, .timeS = timeS}, panelShown, mark, allocations);
    };
    watch(0);
    EXPECT_FALSE(allocations.now);  // no planet yet
    ASSERT_TRUE(advanceUntil(session, [&] { return session.open.has_value(); }));
    watch(0);
    ASSERT_TRUE(allocations.now);
    const ui::Allocations first = *allocations.now;
    EXPECT_EQ(first.planets.count, 1u);
    EXPECT_EQ(first.planets.chunks, 6u);
    EXPECT_GT(first.process.openFiles, 3u);
    EXPECT_GE(first.process.threads, 2u);
    EXPECT_GT(first.process.residentBytes, 1u << 20);
    EXPECT_EQ(first.gpu.total(), session.open->scene.renderer.chunks().gpuMemory().total());
    EXPECT_GT(first.objects.programs, 0u);
    EXPECT_GT(first.objects.textures, 0u);
    EXPECT_EQ(first.process.jobs, 0u);
    // The same again is not counted before a second has passed; then another bake has come beside it.
    startBake(session, requestFor(writeSource(), 33), log_);
    ASSERT_TRUE(advanceUntilQuiet(session));
    ASSERT_TRUE(session.previous) << (session.bakeProblem ? session.bakeProblem->message : "");
    watch(0.5);
    EXPECT_EQ(allocations.now->planets.count, 1u);
    watch(1.5, false);
    EXPECT_EQ(allocations.now->planets.count, 1u);  // nobody looks
    watch(1.5);
    EXPECT_EQ(allocations.now->planets.count, 2u);
    EXPECT_EQ(allocations.now->process.openFiles, first.process.openFiles + 1);
    EXPECT_GT(allocations.now->objects.buffers, first.objects.buffers);
    EXPECT_EQ(allocations.mark.planets.count, 1u);
    watch(1.6, false, true);
    EXPECT_EQ(allocations.mark.planets.count, 2u);
}

}  // namespace
}  // namespace worldy
