#include "app/flight/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "app/flight/selection_hash.h"
#include "planet/planet_tools.h"

namespace worldy {

namespace {

using Ids = std::vector<planet::ChunkId>;

Ids without(const Ids& from, const Ids& what) {
    Ids rest;
    std::set_difference(from.begin(), from.end(), what.begin(), what.end(), std::back_inserter(rest));
    return rest;
}

// Returns the settings with the paging settings that the planet actually has.
ViewSettings heldSettings(const planet::Planet& planet, ViewSettings settings) {
    const planet::PagingSettings held = planet.pagingSettings();
    settings.paging.budgetMB = static_cast<int>(held.budgetBytes >> 20);
    settings.paging.loaderThreads = held.loaderThreads;
    settings.paging.uploadLimitMs = held.uploadLimitMs;
    settings.paging.prefetch = held.prefetch;
    settings.paging.badDisk = held.badDisk;
    settings.paging.retries = held.retry.retries;
    settings.paging.retryDelayS = held.retry.delayS;
    // The meaning of Automatic depends on the machine.
    settings.surface.light.normals.use =
        held.normals ? planet::gl::FeatureUse::On : planet::gl::FeatureUse::Off;
    settings.paging.normalShare = held.normalShare;
    settings.paging.simulated = held.time == planet::PagingTime::Simulated;
    return settings;
}

}  // namespace

Ids drawnIds(const planet::Selection& selection) {
    Ids ids;
    ids.reserve(selection.draw.size());
    for (const planet::DrawItem& item : selection.draw) ids.push_back(item.id);
    std::sort(ids.begin(), ids.end());
    return ids;
}

Recorder::Recorder(planet::Planet& planet, std::string name)
    : name_(std::move(name)), data_(flightDataOf(planet.file())) {
    // A replay may have another working folder.
    std::error_code status;
    const std::filesystem::path whole = std::filesystem::absolute(data_.chunkFile, status);
    if (!status) data_.chunkFile = whole.string();
    planet.tools().reset();
    planet.tools().keepMoves(true);
}

void Recorder::called(planet::Planet& planet, FlightCall call, const planet::BlockId& block) {
    frame_.calls.push_back({.call = call, .block = block, .moves = planet.tools().takeMoves()});
}

void Recorder::announced(planet::Planet& planet, std::span<const planet::AnnouncedView> path) {
    CalledInFlight call{.call = FlightCall::Announce, .moves = planet.tools().takeMoves()};
    call.announced.assign(path.begin(), path.end());
    frame_.calls.push_back(std::move(call));
}

void Recorder::givenSettings(planet::Planet& planet, const ViewSettings& asked, bool pagingPaused) {
    const ViewSettings settings = heldSettings(planet, asked);
    if (settings_ == settings && pagingPaused == pagingPaused_) return;
    CalledInFlight call{.call = FlightCall::Settings, .pagingPaused = pagingPaused};
    call.settings = settings_ ? flightSettings(*settings_, settings) : flightSettings(settings);
    call.moves = planet.tools().takeMoves();
    settings_ = settings;
    pagingPaused_ = pagingPaused;
    frame_.calls.push_back(std::move(call));
}

void Recorder::stepped(planet::Planet& planet, std::span<const double> priorityFactors) {
    frame_.elapsedS = planet.lastStep().elapsedS;
    drawn_.resize(planet.views().size());
    for (std::size_t v = 0; v < planet.views().size(); ++v) {
        Ids now = drawnIds(planet.selection(v));
        FlownView& view = frame_.views.emplace_back();
        view.view = planet.views()[v].input.lodView;
        view.priorityFactor = priorityFactors[v];
        view.appeared = without(now, drawn_[v]);
        view.vanished = without(drawn_[v], now);
        drawn_[v] = std::move(now);
    }
    frame_.moves = planet.tools().takeMoves();
    frame_.selectionHash = selectionHashOf(planet);
    const bool drawnFit = std::all_of(drawn_.begin(), drawn_.end(),
                                      [](const Ids& ids) { return ids.size() <= maxFlightChunks; });
    if (drawnFit && encoder_.fits(frame_))
        encoder_.add(frame_);
    else
        encoder_.end();
    frame_ = {};
}

void Recorder::stop(planet::Planet& planet) const {
    planet.tools().keepMoves(false);
}

planet::Result<void> Recorder::write(const std::filesystem::path& file, IfThere ifThere) const {
    if (encoder_.frames() == 0)
        return planet::badInput(fmt::format("{}: 0 frames are recorded; expected at least 1", file.string()));
    return encoder_.write(file, name_, data_, ifThere);
}

}  // namespace worldy
