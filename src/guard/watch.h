// When the guard takes the bus: pure, so that it can be tested without processes.
#pragma once

#include <cstdint>

#include "drover/time.h"

namespace drover::guard {

class Watch final {
 public:
  /// A new set is in force; beats are expected from now on. Does not end a hold.
  void begin(std::uint64_t beats, Duration limit, Time now) {
    watching_ = true;
    limit_ = limit;
    beats_ = beats;
    last_change_ = now;
  }
  /// The daemon's socket closed: it died, however politely.
  void lost() { holds_ = watching_; }
  /// The daemon asked for the bus. Refused while its heartbeat is late.
  void hand_back(Time now) {
    if (!late(now)) holds_ = false;
  }
  /// Once a cycle: true while stop frames are due.
  bool step(std::uint64_t beats, Time now) {
    if (!watching_) return false;
    if (beats != beats_) {
      beats_ = beats;
      last_change_ = now;
    } else if (late(now)) {
      holds_ = true;
    }
    return holds_;
  }
  bool late(Time now) const { return watching_ && now - last_change_ > limit_; }
  Duration age(Time now) const { return now - last_change_; }

 private:
  bool watching_ = false;
  bool holds_ = false;
  Duration limit_{};
  std::uint64_t beats_ = 0;
  Time last_change_ = kNever;
};

}  // namespace drover::guard
