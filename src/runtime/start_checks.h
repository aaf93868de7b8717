// Starts whose track is being looked at. Each keeps the stops that were asked for before it, so
// that one that comes meanwhile overtakes it. Pure; the publish thread's.
#pragma once

#include <cstdint>
#include <cstdio>
#include <map>
#include <optional>
#include <string>

#include "drover/command.h"
#include "drover/path.h"
#include "drover/time.h"
#include "runtime/stop_requests.h"
#include "scene/keeper/keeper.h"

namespace drover::runtime {

struct WaitingStart {
  Command command;
  StopCounts before;
  GeodeticPoint origin;  ///< of the map that its path is in
  Time since = kNever;
};

class StartChecks final {
 public:
  static constexpr Duration kLongest = std::chrono::seconds(10);

  /// Returns the number of the check.
  std::uint64_t add(WaitingStart start) {
    waiting_.emplace(++last_, std::move(start));
    return last_;
  }
  /// Nothing when it was given up meanwhile.
  std::optional<WaitingStart> take(std::uint64_t number) {
    auto found = waiting_.extract(number);
    return found ? std::optional(std::move(found.mapped())) : std::nullopt;
  }
  /// One that has waited too long, and is given up.
  std::optional<WaitingStart> take_late(Time now) {
    if (waiting_.empty() || now - waiting_.begin()->second.since <= kLongest) return std::nullopt;
    return take(waiting_.begin()->first);
  }
  bool any() const { return !waiting_.empty(); }

 private:
  std::map<std::uint64_t, WaitingStart> waiting_;  ///< the oldest first
  std::uint64_t last_ = 0;
};

/// Why a track is not started; `first_id`: what the operator calls its first point.
inline std::string offence_text(const scene::TrackOffence& offence, int first_id) {
  if (offence.way_m == 0) return offence.what;  // where the robot is
  char place[80];
  std::snprintf(place, sizeof place, ", %.2f m ahead on the track, after point %zu", offence.way_m,
                offence.point + static_cast<std::size_t>(first_id));
  return offence.what + place;
}

}  // namespace drover::runtime
