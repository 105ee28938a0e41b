// Builds the panels' view of the instruments. Its pointers are valid until the instrument changes.
#pragma once

#include <cstdint>

#include "app/data/source_preview.h"
#include "app/measure/cracks.h"
#include "app/measure/error_job.h"
#include "app/measure/pops.h"
#include "app/measure/ruler.h"
#include "ui/model/editor_view.h"

namespace worldy {

ui::CracksView cracksViewOf(const CrackInstrument& instrument, const Scene& scene, const planet::View& view,
                            const ViewSettings& settings);
ui::ErrorsView errorsViewOf(const ErrorMeter& meter, std::uint64_t frame);
ui::PopsView popsViewOf(const Pops& pops);
// view: of the main picture.
ui::RulerView rulerViewOf(const Ruler& ruler, const planet::View& view);
ui::SourcePreview previewViewOf(const SourcePreviewer& previewer);

}  // namespace worldy
