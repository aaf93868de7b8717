// The first way of a boot or a configuration is driven slowly, with a little turn: wheels, gyro and
// receiver have to agree on it. Wrong gear ratios, swapped sides and reversed wheels are found
// before they hurt.
#pragma once

#include "drover/measurement.h"
#include "drover/path.h"
#include "drover/snapshot.h"
#include "drover/twist.h"
#include "engine/config.h"
#include "engine/health/first_way_words.h"
#include "engine/health/mark_ring.h"
#include "engine/health/place_turn.h"
#include "engine/health/swing.h"

namespace drover::engine {

struct MechanicsInput {
  Time now = kNever;
  Duration dt{};
  Twist body;                    ///< as the base tells it
  double fastest_mps = 0;        ///< of its wheels on the ground, by that motion
  bool commanded = false;        ///< somebody moves the base
  double asked_radps = 0;        ///< how fast it is told to turn
  double yaw_slip_factor = 1;    ///< as learned: what it is told is so much more
  double yaw_rad = kAbsent;      ///< of the base, absent while unknown
  bool gyro_zero_known = false;  ///< its bias was learned
};

/// For whom a speed is asked.
enum class FirstWay : std::uint8_t { task, joints, hand };

/// Ways and turns count from the place where motion began; the receiver's are compared with the
/// wheels' at the receiver's own instant. What cannot be compared (no RTK fix, no gyro) is not: the
/// slow way stays, and proves nothing. After it a task, or a search for the heading, goes on as
/// asked, and the next one begins with another; joint commands, which need no receiver, are asked
/// for one in the life of the program; a person who drives with a key stays slow.
class MechanicsCheck final {
 public:
  explicit MechanicsCheck(const EngineConfig& config);

  void on_position(const GnssPosition& position, Time at);
  void on_heading(const GnssHeading& heading, Time at);
  /// `turn_radps` about the vertical, without the bias.
  void on_turn(double turn_radps, Time at);

  /// Another receiver speaks from now on, from there. Of this motion it compares nothing any more.
  void forget_receiver(const AntennaConfig& antenna);
  /// Somebody takes the base for a way of his own: what another went slowly does not count for it.
  void begin_anew();
  void step(const MechanicsInput& input);
  /// The program before this one proved them, in the same boot with the same configuration.
  void recall_proved() { proved_ = true; }
  bool proved() const { return proved_; }
  /// What disagrees; empty when nothing does. Stays until the base rests.
  const Reason& fault() const { return fault_; }
  /// How fast that one may drive now, m/s; infinite once proved.
  double speed_cap_mps(FirstWay who) const;
  /// Why that one drives slowly, in words for an operator: as long as it moves and is held back by
  /// speed_cap_mps(). Empty: it is not.
  Reason slowly(FirstWay who) const;
  /// What is driven instead of `wanted`: the same way, with a little turn to each side.
  Twist guide(const Twist& wanted);

 private:
  /// Nothing more is compared in this motion: it went on for the first way, and has swung, where
  /// it is this that steers.
  bool past_first_way() const {
    return moving_ && rolled_m_ >= config_.navigate.first_way_m && (!guided_ || swing_.is_over()) &&
           !awaits_turn();
  }
  /// It could be shown by places, and was not yet: nobody knows which way it turns.
  bool awaits_turn() const {
    return guided_ && shown_by_places() && place_turn_.verdict() == PlaceTurn::Verdict::open;
  }

  /// Since the motion began.
  struct Mark {
    Time at = kNever;
    double way_m = 0;     ///< by the wheels, ahead positive
    double rolled_m = 0;  ///< likewise, in either direction
    double gyro_rad = 0;
    WheelsWay wheels;
  };
  /// The mean of what the receiver said at rest.
  struct Rest {
    GnssPosition place;
    double north_deg = 0;  ///< mean of the latitudes
    double east_deg = 0;
    double heading_sin = 0;
    double heading_cos = 0;
    int places = 0;
    int headings = 0;
  };

  void begin();
  Rest* rest_at(Time at);
  bool hears_gyro(const MechanicsInput& input) const;
  TurnAccounts turns() const { return {last_.wheels.turn_rad, last_.gyro_rad, heading_turn_rad_}; }
  /// By the gyro, or else the receiver, since the motion began; absent: nobody knows.
  double turned_rad(const MechanicsInput& input) const;
  void compare_turn(const MechanicsInput& input);
  void watch_swing(const MechanicsInput& input);
  void say_no_swing(bool by_gyro);
  bool shown_by_places() const;
  void compare_place(const Mark& wheels);
  bool compare_way(const PathPoint& went, const Mark& wheels, double sigma_m);
  void compare_aside(const PathPoint& went, const Mark& wheels, double sigma_m);
  bool jumps(const PathPoint& way, const Mark& wheels, double sigma_m);

  EngineConfig config_;
  const BaseWords* words_;
  bool proved_ = false;
  bool moving_ = false;
  Time still_since_ = kNever;
  Time began_ = kNever;
  Time now_ = kNever;
  double yaw_rad_ = kAbsent;
  double rolled_m_ = 0;      ///< in either direction
  double compared_m_ = 0;    ///< of that, until the receiver's last position that was compared
  bool went_first_ = false;  ///< a first way was gone to its end, compared or not
  Swing swing_;
  PlaceTurn place_turn_;
  bool has_sides_;  ///< wheels of its own, on two sides, with which it turns
  double began_yaw_rad_ = kAbsent;
  bool guided_ = false;      ///< the swing is asked for
  bool turn_known_ = false;  ///< somebody could tell of a swing
  double asked_rad_ = 0;     ///< turn commanded, as its wheels would tell it
  double yaw_slip_factor_ = 1;
  Mark last_;
  MarkRing<Mark> marks_;
  Rest rest_;
  Rest settled_;  ///< while it moves by name only: it stands, for less than kStill_s
  GnssPosition position_;
  bool fresh_position_ = false;
  Time position_at_ = kNever;
  double heading_turn_rad_ = kAbsent;  ///< by the receiver, since the motion began
  Time heading_at_ = kNever;
  Time gyro_at_ = kNever;
  AntennaConfig antenna_;
  int odd_places_ = 0;  ///< in succession
  PathPoint last_way_;  ///< of the antenna less its swing, by the last position
  double last_rolled_m_ = 0;
  PathPoint jumped_;  ///< so much of it came by jumps
  Reason fault_;
};

}  // namespace drover::engine
