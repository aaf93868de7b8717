// What the answers about the way ahead permit: speeds each way, and whether something is in it.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "drover/clearance.h"
#include "engine/clearance/stop_chain.h"
#include "engine/clearance/way_since.h"
#include "engine/config.h"

namespace drover::engine {

struct ClearanceInput {
  Time now = kNever;
  BodyMotion body;         ///< as the base moves
  std::uint64_t path = 0;  ///< of the task; 0: none
  Twist commanded;         ///< in the last cycle
  Twist asked;             ///< likewise, by whoever drives, before anything bounded it
  /// Not 0: single wheels are commanded so far from the middle, and the outermost one brakes with
  /// the whole deceleration, the middle with less.
  double half_track_m = 0;
};

/// The most that is permitted now, m/s and rad/s, never negative.
struct ClearanceCaps {
  double along_mps = 0;  ///< of a task, on its path
  double ahead_mps = 0;
  double back_mps = 0;
  double left_radps = 0;
  double right_radps = 0;
  double aside_left_mps = 0;
  double aside_right_mps = 0;
};

/// Fails closed: what is old, or about another path, permits nothing; on another curve than was
/// looked along nothing is permitted but as far as both are the same. A way that something is in is
/// closed until that was away for `again_s`; the others stay open, so that who stands before a wall
/// may leave it. Only a task stands still altogether: what is in its way has to leave.
class ClearanceWatch final {
 public:
  /// Not `required`: nobody looks around, and everything is permitted.
  /// One that does not `pivot` has no way to leave but ahead and back; one that goes `sideways`,
  /// and somebody looks there, has two more.
  ClearanceWatch(const ClearanceConfig& config, const LimitsConfig& limits, bool required,
                 bool pivots = true, bool sideways = false);

  /// The newest one; an older one than it changes nothing.
  void on_clearance(const Clearance& found);
  /// Once a cycle.
  void update(const ClearanceInput& input);

  const ClearanceCaps& caps() const { return caps_; }
  /// Something is in the way of who drives, or was until a second ago: what. Empty: nothing is.
  const Reason& blocked() const { return blocked_; }
  /// Nobody knows what is around the robot: why. Empty: somebody does.
  const Reason& unknown() const { return unknown_; }
  /// It is not answered yet for this track, so that nothing is permitted on it: which. Empty: it
  /// is.
  const Reason& unasked() const { return unasked_; }
  /// A constraint does not hold where the robot is, or did not until a second ago: which. Then
  /// nothing is permitted. Empty: all hold.
  const Reason& broken() const { return broken_; }
  /// No ramp ends before what came into the way of who drives: he stops without one.
  bool too_near() const { return too_near_; }
  /// The last answer, as it came.
  const Clearance& found() const { return found_; }
  /// The same curve, no faster than is permitted along it. To the side alone, or not to the side:
  /// nobody looked where both together lead to, and one has to end before the other begins.
  Twist limit(const Twist& asked) const;
  /// For whoever moves single wheels, which make `asked` of the base: the most of a rim,
  /// `half_track_m` beside the middle.
  double rim_cap_mps(const Twist& asked, double half_track_m) const;

 private:
  enum Way : std::uint8_t {
    kAlong,
    kAhead,
    kBack,
    kLeft,
    kRight,
    kAsideLeft,
    kAsideRight,
    kWays,
    kNone = kWays
  };
  /// Whether something is in a way, or was until a while ago.
  struct Gate {
    bool closed = false;
    Time free_since = kNever;
    double least = 0;     ///< that was left since it closed
    Time moved = kNever;  ///< into it, last
  };
  /// m and m/s, or rad and rad/s of a turn on the spot.
  struct Stretch {
    double left = 0;
    double bare = 0;     ///< that was left by the margin alone, where it is more
    double moves = 0;    ///< into it
    StopChain brakes;    ///< as it is come to
    double slowest = 0;  ///< what a base cannot hold is no speed
    double again = 0;
  };
  static Way way_of(const Twist& twist);
  static StopChain in_curve(StopChain chain, const ClearanceInput& input);
  Reason find_unknown(Time now, const WaySince& since) const;
  void watch_lateness(Time now);
  void watch_constraints(Time now);
  double agreed_m(const ClearanceInput& input, const WaySince& since) const;
  void judge(Gate& gate, const Stretch& way, const StopChain& full, Time now);
  double along_cap(const ClearanceInput& input, const WaySince& since);
  double straight_cap(Way way, const ClearanceInput& input, const WaySince& since, double agreed_m);
  double turn_cap(Way way, const ClearanceInput& input, const WaySince& since);
  double aside_cap(Way way, const ClearanceInput& input, const WaySince& since);
  bool leads_aslant(const Twist& asked, bool aside) const;
  bool is_blocked(const ClearanceInput& input) const;
  Reason blocked_by(const ClearanceInput& input) const;
  void forget_freedom();

  ClearanceConfig config_;
  LimitsConfig limits_;
  bool required_;
  bool pivots_;
  bool sideways_;
  Twist commanded_;  ///< in the last cycle
  // What is seen from afar is come to gently, on a curve that the gates' limited jerk can follow;
  // what appears nearer is braked for with all that a ramp to zero has.
  StopChain straight_;
  StopChain straight_firm_;  ///< between the two
  StopChain straight_full_;
  StopChain turning_;
  StopChain turning_full_;
  Clearance found_;
  WayMemory ways_;
  ClearanceCaps caps_;
  std::array<Gate, kWays> gates_{};
  bool too_near_ = false;
  Time held_since_ = kNever;  ///< all constraints, again
  // Answers that come too late to move by, one after the other.
  Time late_since_ = kNever;
  Time in_time_since_ = kNever;  ///< but for a moment: the next one may be late again
  Duration latest_{0};           ///< the oldest of them
  Reason blocked_;
  Reason unknown_;
  Reason unasked_;
  Reason broken_;
};

}  // namespace drover::engine
