// Opens the sources of a job on all ranks together: each rank opens them itself, but reads only its part of the samples where
// opening reads them all (survey_share.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "planet/bake/job/team.h"
#include "planet/raster/survey_share.h"

namespace planet {

// One on each rank, for the time in which it opens its sources. One thread.
class SharedOpening {
public:
    // program: its version and build; ranks with different ones do not share. team: must outlive this.
    SharedOpening(Team& team, std::string_view program);

    // For HeightSourceSettings::share and openColourSource; used no longer than this.
    std::shared_ptr<const SurveyShare> share();

    // Ends the opening, whether it succeeded or not. All ranks call it; it returns when all have ended theirs. Returns how
    // many seconds each has read its part, by rank.
    std::vector<double> finish();

private:
    // Returns what each rank sends; nothing if one has ended its opening or has another program.
    std::optional<std::vector<std::vector<std::byte>>> exchange(std::span<const std::byte> own);

    Team& team_;
    std::uint64_t program_;
    double surveyS_ = 0;
};

}  // namespace planet
