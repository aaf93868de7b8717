// What else than the wheels says that the base moves: the receiver's speed, the gyro, the way
// between the receiver's positions, and the heading of a receiver with two antennas.
#pragma once

#include <array>
#include <optional>

#include "drover/measurement.h"
#include "drover/path.h"
#include "drover/time.h"
#include "engine/config.h"

namespace drover::engine {

/// What the witnesses say together.
struct Testimony {
  int heard = 0;    ///< witnesses that said something lately
  int moving = 0;   ///< of these: that the base moves
  Reason in_words;  ///< of those who say that it moves; empty when nobody does
};

/// Each witness has noise of its own, so one alone proves little. A receiver's speed without an RTK
/// fix is mostly noise: how much is learned while the base rests. A heading may jump with the
/// position of the same receiver: it only bears out what the gyro says.
class MotionWitness final {
 public:
  explicit MotionWitness(const EngineConfig& config) : config_(config) {}

  void on_speed(const GnssVelocity& velocity, Time at);
  void on_position(const GnssPosition& position, Time at);
  /// `turn_radps` about the vertical, without the bias.
  void on_turn(double turn_radps, Time at);
  void on_heading(const GnssHeading& heading, Time at);

  /// From `at` on the base should rest: the way counts from the next position, the turn from the
  /// next heading. `turn` is the sign of the turn that was commanded, 0 for none.
  void expect_rest(Time at, double turn);
  /// Another receiver speaks from now on: its places and headings are no way from the other's.
  void forget_receiver();
  /// While the base rests, what the receiver's speed says is noise.
  void set_at_rest(bool rests) { rests_ = rests; }

  Testimony hear(Time now) const;
  /// The receiver's speed when it is fresh and no noise, else 0, m/s.
  double speed_mps(Time now) const;
  Time speed_at() const { return speed_at_; }  ///< when it was measured
  /// The least of the receiver's last two speeds and of what lies between its last two positions:
  /// two witnesses in a tenth of a second, but only of what is fast. 0 when noise could be it.
  /// Where the heading is known (`yaw_rad`) only what goes along it counts: no drive takes a base
  /// aside.
  double proven_speed_mps(Time now, double yaw_rad) const;
  /// From where rest was expected, m; x east, y north. Zero without a position.
  PathPoint way(Time now) const;
  /// Gyro and heading say that it goes on turning as it was commanded, and nothing that it goes
  /// anywhere: who rolls away does.
  bool spins_on(Time now) const;
  /// A receiver with an RTK fix showed a moment ago that it stood for a second: neither speed nor
  /// way; and the gyro shows no turn. What goes slower than 6 cm/s does not show.
  bool stands(Time now) const;
  /// The same over three seconds, and now: what is slower than 2 cm/s does not show.
  bool stood(Time now) const;
  /// A receiver with an RTK fix says that it is slower than this, m/s.
  bool is_slower(double speed_mps, Time now) const;
  /// The gyro shows a turn.
  bool turns(Time now) const;
  /// Its way in the last second, m; x east, y north. Nothing unless a receiver with an RTK fix has
  /// said one motion for a second by its speeds and by its places: one that has lost its way
  /// contradicts itself.
  std::optional<PathPoint> proven_way(Time now) const;

 private:
  struct Place {
    GnssPosition position;
    Time at = kNever;
  };
  void keep_place(const GnssPosition& position, Time at);
  const Place* place_before(Time at, Duration age) const;
  bool went(Time now) const;
  bool turns_on(Time now) const;
  double speed_noise_mps() const;
  bool fresh(Time at, Time now) const;

  EngineConfig config_;
  double speed_mps_ = kAbsent;
  Time speed_at_ = kNever;
  double speed_before_mps_ = kAbsent;
  Time speed_before_at_ = kNever;
  bool rests_ = false;
  double learned_noise_mps2_ = 0;  ///< squared, of this kind of fix
  GnssPosition from_;              ///< where rest began
  Time from_at_ = kNever;
  Time wanted_from_ = kNever;
  GnssPosition position_;
  Time position_at_ = kNever;
  GnssPosition position_before_;
  Time position_before_at_ = kNever;
  std::array<Place, 48> places_;  ///< a ring, a tenth of a second apart at least
  std::size_t next_place_ = 0;
  Time stands_at_ = kNever;
  Time stood_at_ = kNever;
  PathPoint last_second_;     ///< in the last second
  Time one_motion_ = kNever;  ///< since when speeds and places say one
  double turn_radps_ = 0;     ///< smoothed
  Time turn_at_ = kNever;
  double commanded_turn_ = 0;  ///< its sign, before rest was expected
  double heading_deg_ = kAbsent;
  Time heading_at_ = kNever;
  double turned_rad_ = 0;  ///< left positive, by headings, since rest was expected
  Time turned_from_ = kNever;
};

}  // namespace drover::engine
