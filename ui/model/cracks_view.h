// The state of the Cracks panel and of the crack marks in the viewport.
#pragma once

#include "app/measure/crack_measurement.h"

namespace worldy::ui {

struct CracksView {
    const CrackMeasurement* measured = nullptr;  // null: not measured yet
    bool current = false;                        // the view and the drawn chunks are still those measured
    const SmallestSkirts* smallest = nullptr;    // for the measured view; null: not requested
};

}  // namespace worldy::ui
