#include "ui/model/commands.h"

#include <utility>

namespace worldy::ui {

Command::Command(ChunkCommand command) : feature_(command) {}
Command::Command(CameraCommand command) : feature_(std::move(command)) {}
Command::Command(PagingCommand command) : feature_(command) {}
Command::Command(FrameCommand command) : feature_(command) {}
Command::Command(FileCommand command) : feature_(std::move(command)) {}
Command::Command(BakeCommand command) : feature_(std::move(command)) {}
Command::Command(SettingsCommand command) : feature_(std::move(command)) {}
Command::Command(WindowCommand command) : feature_(std::move(command)) {}
Command::Command(LayerCommand command) : feature_(std::move(command)) {}
Command::Command(InstrumentCommand command) : feature_(command) {}
Command::Command(RecordingCommand command) : feature_(std::move(command)) {}
Command::Command(SweepCommand command) : feature_(std::move(command)) {}
Command::Command(CompareCommand command) : feature_(std::move(command)) {}
Command::Command(SourceCommand command) : feature_(std::move(command)) {}
Command::Command(TraceCommand command) : feature_(std::move(command)) {}
Command::Command(AtlasCommand command) : feature_(std::move(command)) {}
Command::Command(SuggestCommand command) : feature_(std::move(command)) {}
Command::Command(NoteCommand command) : feature_(std::move(command)) {}

Command::Command(Command&&) noexcept = default;
Command& Command::operator=(Command&&) noexcept = default;
Command::~Command() = default;

}  // namespace worldy::ui
