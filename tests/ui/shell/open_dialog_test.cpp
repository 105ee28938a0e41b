#include "ui/shell/open_dialog.h"

#include <gtest/gtest.h>

#include "app/flight/flight_record.h"
#include "ui/model/recording_view.h"

namespace worldy::ui {
namespace {

TEST(OpenDialog, listsRecordedFlights) {
    const std::filesystem::path flight = std::string("canyon") + recordedFlightEnding;
    EXPECT_TRUE(worldy::isFlightRecord(flight));
    EXPECT_TRUE(mayBeOpened(flight, FilePurpose::Open));
}

TEST(OpenDialog, listsOnlyTracesForATrace) {
    EXPECT_TRUE(mayBeOpened("engine.LODTRACE", FilePurpose::TraceB));
    EXPECT_FALSE(mayBeOpened("planet.chk", FilePurpose::TraceB));
    EXPECT_TRUE(mayBeOpened("planet.chk", FilePurpose::Open));
}

}  // namespace
}  // namespace worldy::ui
