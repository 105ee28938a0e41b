#include "ui/model/commands.h"

#include <utility>

namespace worldy::ui {

Command::Command(Command&&) noexcept = default;
Command& Command::operator=(Command&&) noexcept = default;
Command::~Command() = default;

const FeatureCommand& Command::feature() const {
    return *feature_;
}

template <class Feature>
Command::Command(std::in_place_t, Feature feature)
    : feature_(std::make_unique<const FeatureCommand>(std::in_place_type<Feature>, std::move(feature))) {}

template Command::Command(std::in_place_t, ChunkCommand);
template Command::Command(std::in_place_t, CameraCommand);
template Command::Command(std::in_place_t, PagingCommand);
template Command::Command(std::in_place_t, FrameCommand);
template Command::Command(std::in_place_t, FileCommand);
template Command::Command(std::in_place_t, BakeCommand);
template Command::Command(std::in_place_t, SettingsCommand);
template Command::Command(std::in_place_t, WindowCommand);
template Command::Command(std::in_place_t, LayerCommand);
template Command::Command(std::in_place_t, InstrumentCommand);
template Command::Command(std::in_place_t, RecordingCommand);
template Command::Command(std::in_place_t, SweepCommand);
template Command::Command(std::in_place_t, CompareCommand);
template Command::Command(std::in_place_t, SourceCommand);
template Command::Command(std::in_place_t, TraceCommand);
template Command::Command(std::in_place_t, AtlasCommand);
template Command::Command(std::in_place_t, SuggestCommand);
template Command::Command(std::in_place_t, NoteCommand);

}  // namespace worldy::ui
