// Whether the place changes while the wheels stand: a receiver that jumps, or a robot that was
// carried. Nobody can tell which, so a person has to look before it drives on.
#pragma once

#include "drover/remembered.h"
#include "engine/estimate/estimator.h"

namespace drover::engine {

/// Of the base's wheels at least one is heard, at least one is not.
struct WheelsHeard {
  bool some = false;
  bool missed = false;
};

/// The estimate places itself anew when the receiver insists while the wheels stand. A task that
/// waits ends by that. Before the next start the new place has to have lasted for 10 s, and a
/// person has to have been told: by the end of his task, or by a start that was refused. While no
/// wheel is heard it may be pushed: then it jumps when it goes faster from one fix to the next than
/// anybody pushes, or is elsewhere when there are fixes again.
class PlaceWatch final {
 public:
  explicit PlaceWatch(const EstimateConfig& config) : config_(config) {}

  /// One wheel that stands is enough: a base does not go far without it. What the wheels tell
  /// though it stands, creeping down a slope, is no jump.
  void update(Time now, Duration dt, const Estimate& estimate, WheelsHeard wheels,
              const GeodeticPoint& origin);
  /// Where it stood when the program before this one ended. A wheel that turns before the place is
  /// known again, or another origin, makes that worthless.
  /// One that was doubted then stays so until a person accepts what the receiver says.
  void recall(const RestPlace& place);
  /// For the next program: where it stands, or stood before a jump that nobody has looked at yet.
  RestPlace rest_place(const GeodeticPoint& origin) const;
  /// Another origin: all places have other numbers.
  void forget() { known_ = false; }
  /// A start is asked for. Why not; empty when it may begin: then the new place is believed.
  Reason ask_start(Time now);
  /// A person was told by the end of his task.
  void told() { told_ = true; }
  /// Last; kNever: it did not.
  Time jumped_at() const { return jumped_at_; }
  /// With where it stood when the program before this one ended.
  bool compared() const { return !away_ && !recalled_.known; }
  /// What jumped, until a start was accepted; empty when nothing did.
  const Reason& jumped() const { return jumped_; }

 private:
  /// As the receiver sees it, or less what the wheels tell that it crept.
  struct Places {
    Pose stood;  ///< when a wheel turned last, or better known since
    Pose at;     ///< the same, or where it jumped to
    Pose began;  ///< the same, but as first known: what walks away slowly is not taken along
  };
  void begin_at(const Pose& pose);
  void begin_where_it_stood(const GeodeticPoint& origin);
  Pose without_creep(Pose pose) const;
  void compare(Time now, const Pose& pose);
  void follow(Time now, const Pose& pose, bool heard);
  void tell(const Pose& pose);

  EstimateConfig config_;
  RestPlace recalled_;
  bool away_ = false;  ///< it began with that place, and has not compared it yet
  bool known_ = false;
  Time renewed_ = kNever;  ///< of two places the new one was believed last
  bool stands_ = false;
  bool missed_ = false;     ///< a wheel is not heard
  bool stood_ = false;      ///< when its wheels were heard last
  Time heard_at_ = kNever;  ///< they were
  /// They were not since, and the place was not well known since they are again: who pushes it is
  /// seen by the receiver only.
  bool unheard_ = false;
  Pose followed_;  ///< where it was last, well known
  Time followed_at_ = kNever;
  double sigma_m_ = 0;  ///< of the last cycle in which it was
  Places seen_;
  Places rested_;         ///< without what it crept: the nearer of the two counts
  double crept_x_m_ = 0;  ///< since it stands, by its wheels
  double crept_y_m_ = 0;
  Reason jumped_;
  Time jumped_at_ = kNever;
  bool told_ = false;
  bool doubted_ = false;         ///< now, by the estimate
  std::uint16_t doubt_cm_ = 0;   ///< so far elsewhere it may be
  bool doubted_before_ = false;  ///< when the program before this one ended
};

}  // namespace drover::engine
