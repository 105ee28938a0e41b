#include "ui/model/paging_text.h"

#include <fmt/format.h>

#include "app/base/plot_scale.h"
#include "app/base/text.h"

namespace worldy::ui {

std::string pageInReason(double epsPx, double tauPx, double hysteresis, const char* epsSymbol,
                         const char* tauSymbol) {
    const std::string eps = fmt::format("{} {:.2f}", epsSymbol, epsPx);
    if (epsPx > tauPx) return fmt::format("{} > {} {:.2f}", eps, tauSymbol, tauPx);
    const double mergesAtPx = tauPx * (1 - hysteresis);
    if (epsPx > mergesAtPx)
        return fmt::format("{} > {:.2f}: was split ({} {:.2f})", eps, mergesAtPx, tauSymbol, tauPx);
    return fmt::format("{}: no longer > {} {:.2f}", eps, tauSymbol, tauPx);
}

std::string colourReason(double timesTooFew) {
    return fmt::format("{:.0f} % of texels", 100 / timesTooFew);
}

std::string pageOutReason(double ageS) {
    return fmt::format("unused for {}", latencyText(ageS));
}

const char* kindText(planet::BlockKind kind) {
    if (kind == planet::BlockKind::Normals) return "normals";
    return kind == planet::BlockKind::Colours ? "colours" : "heights";
}

KindTotals totalsOf(const char* kind, const planet::BlockCounters& p) {
    return {kind,       p.loaded,     p.evicted, p.failed, p.bytesRead, p.loaded - p.evicted,
            p.resident, p.budgetWaits};
}

bool isBad(const planet::BadDiskSettings& disk) {
    return disk.latencyMs > 0 || disk.bandwidthMBs > 0 || disk.failureRate > 0 || disk.shuffledOrder;
}

std::string badDiskText(const planet::BadDiskSettings& disk) {
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (disk.latencyMs > 0) add(fmt::format("+{} ms per read", axisText(disk.latencyMs)));
    if (disk.bandwidthMBs > 0) add(fmt::format("{} MB/s", axisText(disk.bandwidthMBs)));
    if (disk.failureRate > 0) add(fmt::format("{} % of reads fail", axisText(100 * disk.failureRate)));
    if (disk.shuffledOrder) add("shuffled order");
    return text;
}

std::string latencyText(double seconds) {
    if (seconds > 0 && seconds < 1e-4) return fmt::format("{} µs", axisText(1e6 * seconds));
    if (seconds < 0.995) return fmt::format("{} ms", axisText(1000 * seconds));
    return seconds < 100.5 ? fmt::format("{} s", axisText(seconds)) : durationText(seconds);
}

}  // namespace worldy::ui
