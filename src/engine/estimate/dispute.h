// RTK positions that jumped while the base drove: another integer solution, a shove, a spoofer.
// Neither where they are nor where wheels and gyro are is believed until it is decided.
#pragma once

#include "drover/time.h"
#include "engine/config.h"
#include "engine/estimate/unseen_way.h"

namespace drover::engine::estimate {

/// A fix so near to where the last one, or dead reckoning, had it is the same place: the nearest
/// that another integer solution was seen.
inline constexpr double kSameFix_m = 0.045;
/// Without one for so long the next may be another; some receivers tell one a second.
inline constexpr Duration kFixGone = std::chrono::seconds(2);

class Dispute final {
 public:
  /// How far an RTK position is from where dead reckoning has it, m; east and north.
  struct Offset {
    double east_m = 0;
    double north_m = 0;
    double m() const;
    /// Of who has this heading: ahead of him, and to his left.
    double ahead_m(double yaw_rad) const;
    double left_m(double yaw_rad) const;
  };

  /// Positions are refused, or jumped, since then, and heard until now. `found_again`: the fix was
  /// lost just before, and slip explains where it is: this is another one already.
  void begin(const Offset& offset, Time since, bool found_again, Time now);
  /// It stepped there from where the last position was, which was believed, not from where dead
  /// reckoning is.
  void came_from(const Offset& last);
  bool holds() const { return since_ != kNever; }
  Time since() const { return since_; }
  /// Between the places, by the last position, m: of those where positions were and are the one
  /// that is farther from dead reckoning.
  double apart_m() const;
  /// A position of another quality, or none for a while: the next fix may be another one.
  void lose_fix();

  enum class Verdict { undecided, came_back, renewed };
  /// The next RTK position. It came back when it steps back by what it jumped, or is again where
  /// dead reckoning is while that is known well; a fix that was lost and found holds when it has
  /// stayed with wheels and gyro for a minute, in which it may be lost and found at the same place
  /// again. `inside`: the gate would let it pass; `two_sigma_m`
  /// of dead reckoning, `noise_m` of one position. `settled`: the receiver's filters have.
  Verdict hear(const Offset& offset, bool inside, double two_sigma_m, double noise_m, bool settled,
               bool stands, Time now);

  /// Whichever place is right, positions that keep their distance to dead reckoning tell how that
  /// goes on: they do, and dead reckoning has gone astray by so much since.
  bool steady() const { return steady_; }
  Offset astray() const;
  /// As long as wheels that slip by `slip_share`, and what wheels and heading err by otherwise,
  /// explain what it was put right by in all. Positions that lead it farther wander themselves.
  bool may_lead(double yaw_rad, double slip_share) const;
  /// Dead reckoning was put right by so much.
  void put_right(const Offset& by);
  /// By so much in all, m; and how much of it is aside of who has this heading.
  double led_m() const { return put_right_.m(); }
  double led_aside_m(double yaw_rad) const;
  /// The base went so far, by its wheels.
  void advance(double east_m, double north_m);
  /// When it is decided at the latest if all stays as it is; kNever: not by waiting.
  Time decided_at() const;
  bool moved_at_rest() const { return moved_at_rest_; }

 private:
  bool came_back(const Offset& offset, double two_sigma_m, Time now) const;
  void follow(const Offset& offset, Time now);
  bool may_hold(const Offset& by_wheels, double allowed_m) const;
  void hold(const Offset& offset, double noise_m, bool settled, Time now);

  Time since_ = kNever;
  Time heard_ = kNever;
  Offset jump_;  ///< how it began: the mean of the first ones, from where the last one was
  Offset from_;
  int first_ = 0;
  Offset late_;  ///< of late, smoothed; what jumps away from that hardly moves it
  Offset last_;
  bool lost_ = false;         ///< since it began: it may step back by something else
  bool found_again_ = false;  ///< or just before
  bool renews_ = false;       ///< a new fix holds there, for so long:
  Offset renewed_at_;
  Duration held_for_{};
  Offset held_;  ///< how far from dead reckoning positions stay
  Time held_since_ = kNever;
  Time away_since_ = kNever;  ///< they are elsewhere
  int held_count_ = 0;
  bool steady_ = false;
  Offset put_right_;            ///< in all
  UnseenWay gone_;              ///< since it began
  double way_m_ = 0;            ///< since a new fix holds
  double unheard_m_ = 0;        ///< since the last position
  Offset by_wheels_;            ///< from where wheels and gyro alone have it, by the last position
  bool moved_at_rest_ = false;  ///< where it holds, while the base stood: it may have been carried
};

}  // namespace drover::engine::estimate
