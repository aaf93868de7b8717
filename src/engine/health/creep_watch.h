// Whether a base creeps on from its last command, too slowly for anything else that watches.
#pragma once

#include <cmath>

#include "engine/health/rim_motion.h"

namespace drover::engine {

/// What goes `ahead` (a sign, 0: on the spot) goes the way that the ground falls, or may.
inline bool goes_down(double ahead, double falls_ahead) {
  return std::isfinite(ahead) && ahead != 0 && !(ahead * falls_ahead <= 0);
}

struct CreepInput {
  Time now = kNever;
  Duration dt{};
  bool power = true;      ///< there is some, and no person has released the drives
  bool may_roll = false;  ///< without power; what is faster is judged by more than its wheels
  double falls_ahead = kAbsent;  ///< as RestInput has it
  bool seen_to_stand = false;
};

/// From when it should rest, and only until it has stood: who pushes it later must not find it
/// latched.
class CreepWatch final {
 public:
  void begin(Time now);
  void end() { since_ = kNever; }
  bool under_way() const { return since_ != kNever; }
  /// True when it went 0.1 m by its wheels, never slower than 2 cm/s.
  bool update(const CreepInput& input, const RimMotion& rims);

 private:
  Time since_ = kNever;
  double way_m_ = 0;     ///< of the fastest rim
  double heard_s_ = 0;   ///< for so long
  double silent_s_ = 0;  ///< without a word
};

}  // namespace drover::engine
