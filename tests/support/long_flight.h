// Long flights over random places, and what is kept an eye on meanwhile: what paging does over time, and what
// the process holds.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "app/base/process_memory.h"
#include "planet/planet.h"
#include "planet/planet_tools.h"
#include "tests/support/sanitized.h"

#ifdef __GLIBC__  // known once a header of its is there
#include <malloc.h>
#endif

namespace planet::test {

inline constexpr double frameS = 1.0 / 60;

// How long to fly, simulated seconds: WORLDY_FLIGHT_SECONDS, or as many as are given. A tenth under a
// sanitizer.
inline double flightSeconds(double usualS) {
    const char* asked = std::getenv("WORLDY_FLIGHT_SECONDS");
    const double seconds = asked ? std::atof(asked) : usualS;
    return tests::sanitized && !asked ? seconds / 10 : seconds;
}

// From place to place, each leg some seconds long, low over the ground or far away; it hovers at each leg's
// end, and now and then it is at once somewhere else.
class RandomFlight {
public:
    static constexpr double hoverS = 3;

    RandomFlight(std::uint32_t seed, double radiusM) : random_(seed), radiusM_(radiusM) {
        to_ = randomPlace();
        nextLeg();
    }

    void step() {
        timeS_ += frameS;
        if (timeS_ >= flyS_ + hoverS) nextLeg();
    }
    // The last moment of hovering.
    bool endsLeg() const { return timeS_ + frameS >= flyS_ + hoverS; }

    CameraPose pose() const {
        const double share = std::min(timeS_ / flyS_, 1.0);
        const double smooth = share * share * (3 - 2 * share);
        CameraPose pose;
        pose.latitudeDeg = std::lerp(from_.latitudeDeg, to_.latitudeDeg, smooth);
        pose.longitudeDeg = std::lerp(from_.longitudeDeg, to_.longitudeDeg, smooth);
        pose.altitudeM = std::exp(std::lerp(std::log(from_.altitudeM), std::log(to_.altitudeM), smooth));
        pose.headingDeg = std::lerp(from_.headingDeg, to_.headingDeg, smooth);
        pose.pitchDeg = std::lerp(from_.pitchDeg, to_.pitchDeg, smooth);
        return pose;
    }
    View view(int widthPx, int heightPx) const {
        return viewFromPose(pose(), radiusM_, 1.05, widthPx, heightPx);
    }

private:
    double within(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    CameraPose randomPlace() {
        CameraPose pose;
        pose.latitudeDeg = std::asin(within(-1, 1)) * 180 / std::numbers::pi;
        pose.longitudeDeg = within(-180, 180);
        pose.altitudeM = radiusM_ * std::exp(within(std::log(0.0007), std::log(2.0)));
        pose.headingDeg = within(-180, 180);
        pose.pitchDeg = within(-90, -10);
        return pose;
    }
    void nextLeg() {
        const bool jumps = random_() % 4 == 0;
        from_ = jumps ? randomPlace() : to_;
        to_ = randomPlace();
        timeS_ = 0;
        flyS_ = within(3, 15);
    }

    std::mt19937 random_;
    double radiusM_;
    CameraPose from_, to_;
    double timeS_ = 0;
    double flyS_ = 1;
};

// Follows how requests end, step by step. A step must not end more than the planet remembers.
class PagingWatch {
public:
    static constexpr double soonS = 2;

    void look(const Planet& planet) {
        const double nowS = planet.lastStep().nowS;
        const std::deque<PagingEvent>& history = planet.inspect().pagingHistory();
        longestHistory_ = std::max(longestHistory_, history.size());
        for (auto event = history.rbegin(); event != history.rend() && event->atS == nowS; ++event)
            note(*event);
        if (++looks_ % 30 != 0) return;
        for (const PagingRequest& request : planet.inspect().pendingRequests(PagingType::PageIn))
            waited(request.priority, nowS - request.askedAtS);
    }

    std::uint64_t loaded() const { return loaded_; }
    std::uint64_t dropped() const { return dropped_; }
    // Loads of what had been dropped less than soonS before.
    std::uint64_t loadedSoonAgain() const { return soonAgain_; }
    double shareSoonAgain() const {
        return loaded_ == 0 ? 0 : static_cast<double>(soonAgain_) / static_cast<double>(loaded_);
    }
    std::size_t longestHistory() const { return longestHistory_; }
    double longestWaitS() const { return *std::max_element(waitS_.begin(), waitS_.end()); }
    // Of what is wanted most, and of all that is wanted less.
    double urgentWaitS() const { return waitS_.back(); }
    double otherWaitS() const { return *std::max_element(waitS_.begin(), waitS_.end() - 1); }
    // Of requests that ended or are pending, by how urgent they were last.
    std::string waitsText() const {
        constexpr std::array names = {"under 1", "1 to 2", "2 to 4", "4 to 8", "8 to 16", "over 16"};
        std::string text;
        for (std::size_t i = 0; i < names.size(); ++i) {
            char one[80];
            std::snprintf(one, sizeof one, "%s%s: %.2f s", i > 0 ? ", " : "", names[i], waitS_[i]);
            text += one;
        }
        return text;
    }

private:
    void note(const PagingEvent& event) {
        const BlockId block{event.parent, event.kind};
        if (event.outcome == PagingOutcome::Evicted) {
            ++dropped_;
            droppedAtS_[block] = event.atS;
            return;
        }
        if (event.type != PagingType::PageIn) return;
        waited(event.priority, event.waitedS);
        if (event.outcome != PagingOutcome::Loaded) return;
        ++loaded_;
        const auto before = droppedAtS_.find(block);
        if (before != droppedAtS_.end() && event.atS - before->second < soonS) ++soonAgain_;
    }
    void waited(double priority, double seconds) {
        const double doubled = priority < 1 ? 0 : std::floor(std::log2(priority)) + 1;
        double& most = waitS_[static_cast<std::size_t>(std::min(doubled, 5.0))];
        most = std::max(most, seconds);
    }

    std::uint64_t looks_ = 0;
    std::uint64_t loaded_ = 0;
    std::uint64_t dropped_ = 0;
    std::uint64_t soonAgain_ = 0;
    std::size_t longestHistory_ = 0;
    std::map<BlockId, double> droppedAtS_;  // as many as there are blocks at most
    std::array<double, 6> waitS_{};
};

// To the system, what the allocator keeps for later.
inline void giveBackFreed() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

// What the process held at one moment.
struct Holding {
    std::size_t residentBytes = worldy::residentProcessBytes();
    std::size_t heapBytes = worldy::heapBytesInUse();
    std::size_t files = worldy::openFileHandles();
    std::size_t threads = worldy::runningThreads();
};

// The most of some moments.
inline void raise(Holding& most, const Holding& now) {
    most.residentBytes = std::max(most.residentBytes, now.residentBytes);
    most.heapBytes = std::max(most.heapBytes, now.heapBytes);
    most.files = std::max(most.files, now.files);
    most.threads = std::max(most.threads, now.threads);
}

}  // namespace planet::test
