// RTK positions that jumped while the base drove: another integer solution, a shove, a spoofer.
// Neither where they are nor where wheels and gyro are is believed until it is decided.
#pragma once

#include "drover/time.h"
#include "engine/config.h"

namespace drover::engine::estimate {

class Dispute final {
 public:
  /// How far an RTK position is from where dead reckoning has it, m; east and north.
  struct Offset {
    double east_m = 0;
    double north_m = 0;
    double m() const;
  };

  /// Positions are refused, or jumped, since then.
  void begin(const Offset& offset, Time since);
  bool holds() const { return since_ != kNever; }
  Time since() const { return since_; }
  /// Between both places, by the last position, m.
  double apart_m() const { return last_.m(); }
  /// A position of another quality, or none for a while: the next fix may be another one.
  void lose_fix();

  enum class Verdict { undecided, came_back, renewed };
  /// The next RTK position. It came back when it steps back by what it jumped, or is again where
  /// dead reckoning is while that is known well; a fix that was lost and found holds when it has
  /// stayed with wheels and gyro for a minute. `inside`: the gate would let it pass; `two_sigma_m`
  /// of dead reckoning, `noise_m` of one position.
  Verdict hear(const Offset& offset, bool inside, double two_sigma_m, double noise_m, Time now);

 private:
  bool came_back(const Offset& offset, double two_sigma_m, Time now) const;
  void follow(const Offset& offset, Time now);

  Time since_ = kNever;
  Time heard_ = kNever;
  Offset jump_;  ///< how it began: the mean of the first ones
  int first_ = 0;
  Offset late_;  ///< of late, smoothed; what jumps away from that hardly moves it
  Offset last_;
  bool lost_ = false;
  Time renewed_ = kNever;  ///< since when a new fix holds
  Offset renewed_at_;
};

}  // namespace drover::engine::estimate
