// What random histories of the engine break and mend, and what it means for motion.
#pragma once

#include <algorithm>
#include <random>

#include "engine_rig.h"

namespace drover::engine {

/// `random() % n == 0`: the same histories on every machine.
class OneIn {
 public:
  explicit OneIn(std::mt19937_64& random) : random_(random) {}
  bool operator()(unsigned n) const { return random_() % n == 0; }

 private:
  std::mt19937_64& random_;
};

inline constexpr unsigned kBreakdowns = 8;

/// Breaks one thing of any robot, or mends it; `which` is below kBreakdowns.
inline void break_or_mend(EngineRig& rig, unsigned which, std::mt19937_64& random) {
  const OneIn one_in(random);
  switch (which) {
    case 0: rig.lines[0] = one_in(2); break;
    case 1: rig.lines[1] = one_in(2); break;
    case 2: rig.line_lost[random() % kLineCount] = one_in(3); break;
    case 3: rig.guard_alive = !one_in(3); break;
    case 4: rig.guard_has_bus = one_in(3); break;
    case 5: rig.drives[random() % 4].silent = one_in(2); break;
    case 6: rig.drives[random() % 4].fault = one_in(2); break;
    default: rig.drives[random() % 4].state = AxisState::idle; break;
  }
}

/// All is well again; whether the receiver has a heading is no breakdown.
inline void mend_all(EngineRig& rig) {
  rig.lines = {};
  rig.line_lost = {};
  rig.guard_alive = true;
  rig.guard_has_bus = false;
  for (auto& drive : rig.drives) drive.silent = drive.fault = drive.refuses = false;
  rig.receiver_silent = false;
  rig.jump_m = 0;
  rig.quality = FixQuality::rtk_fixed;
  rig.gravity_mps2 = {0, 0, 9.81};
}

/// Nothing may be commanded to move. A line is lost after its limit, a drive at once by its
/// driver's word.
inline bool must_rest(const EngineRig& rig) {
  const auto silent = [](const auto& drive) { return drive.silent; };
  const auto lost = [](bool it) { return it; };
  return rig.guard_has_bus || !rig.guard_alive || rig.lines[0] || rig.lines[1] ||
         std::any_of(rig.drives.begin(), rig.drives.end(), silent) ||
         std::any_of(rig.line_lost.begin(), rig.line_lost.end(), lost);
}

}  // namespace drover::engine
