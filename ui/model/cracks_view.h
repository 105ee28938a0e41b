// The state of the Cracks panel and of the crack marks in the viewport.
#pragma once

#include "app/measure/crack_measurement.h"

namespace worldy::ui {

struct CracksView {
    const CrackMeasurement* measured = nullptr;  // null: nothing yet
    bool current = false;  // the view and what is drawn are still those that were measured
    const SmallestSkirts* smallest = nullptr;  // of the view measured; null: not asked for
};

}  // namespace worldy::ui
