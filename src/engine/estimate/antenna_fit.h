// Where the antenna is and how late its positions are, as straights, turns and changes of speed
// tell it.
//
// Over a second and a half the antenna goes where wheels, gyro and heading say, but for four
// things: a lever arm that is wrong turns with the base, a delay that is wrong shows where the
// speed changes, wheels have their share of the way, and the course is beside the heading. Five
// numbers by recursive least squares, so that what cannot be told apart yet keeps its uncertainty.
#pragma once

#include <array>

#include "drover/time.h"
#include "engine/config.h"

namespace drover::engine::estimate {

/// What is compared from one RTK position to the next but some: of base_link and its antenna in
/// `map`.
struct AntennaPoint {
  Time time = kNever;
  double x_m = 0;  ///< the antenna by the position
  double y_m = 0;
  double arm_x_m = 0;  ///< from base_link to it as configured, turned into the map
  double arm_y_m = 0;
  double yaw_rad = 0;
  double vx_mps = 0;  ///< of the antenna, in the map
  double vy_mps = 0;
  double white_m = 0;  ///< one sigma of its uncorrelated error
  double slow_m = 0;   ///< and of the other one
};

class AntennaFit final {
 public:
  AntennaFit() = default;
  explicit AntennaFit(const EstimateConfig& config);

  /// A step of dead reckoning.
  void advance(double east_m, double north_m, double way_m, double turn_rad);
  /// An RTK position that was believed. Learns when the last one compared with is old enough.
  void hear(const AntennaPoint& point, const EstimateConfig& config);
  /// What happens now is none to learn from: begins anew with the next position.
  void pause() { from_.time = waits_.to.time = kNever; }

  /// What an earlier program had found.
  void recall_late(double late_s, double sigma_s);
  void recall_arm(double ahead_m, double left_m, double sigma_m);

  /// How much later the positions are than their stamps say, s, and one sigma of it.
  double late_s() const { return mean_[kLate]; }
  double late_sigma_s() const;
  /// Likewise, with room for that one change of speed may have been wheels that slipped, until
  /// several agree.
  double late_doubt_s() const;
  bool late_known() const;
  /// What of it is to be made up for: positions that seem to be early may be wheels that are told
  /// late.
  double late_used_s() const { return late_s() > 0 || late_known() ? late_s() : 0.0; }
  /// How much farther ahead and to the left the antenna is than configured, m; larger sigma.
  double ahead_m() const { return mean_[kAhead]; }
  double left_m() const { return mean_[kLeft]; }
  double arm_sigma_m() const;
  /// How far beside the configured place it may be, m, at so many sigmas: as it was told, or, once
  /// that is less, as turns tell it.
  double arm_doubt_m(double sigmas, const EstimateConfig& config) const;
  /// It is, by more than can be chance.
  bool arm_wrong() const;
  /// Within what would be told as wrong it is where it is configured.
  bool arm_right(const EstimateConfig& config) const;

 private:
  enum : std::size_t { kAhead, kLeft, kLate, kShare, kCrab, kNumbers };
  using Row = std::array<double, kNumbers>;

  /// From one point to another.
  struct Stretch {
    AntennaPoint from;
    AntennaPoint to;    ///< kNever: there is none
    double east_m = 0;  ///< dead reckoned
    double north_m = 0;
    double way_m = 0;
    double turn_rad = 0;
  };
  /// What one change of speed tells of the delay.
  struct Change {
    Time at = kNever;
    double late_s = 0;
  };

  void learn(const Stretch& stretch, const EstimateConfig& config);
  void note_change(const Stretch& stretch);
  void judge_changes();
  double variance_of(const Row& row) const;
  void correct(const Row& row, double measured_m, double variance_m2);
  /// The arm is another than before, perhaps: it was knocked, or learned wrong.
  void forget_arm();

  Row mean_{};
  std::array<Row, kNumbers> covariance_{};
  AntennaPoint from_;
  int turns_missed_ = 0;  ///< stretches in a row that tell of the arm and do not fit to it
  double east_m_ = 0;     ///< dead reckoned since then
  double north_m_ = 0;
  double way_m_ = 0;
  double turn_rad_ = 0;
  Stretch waits_;  ///< for the next one to be over without a suspicion, before it teaches anything
  std::array<Change, 5> changes_{};  ///< the last ones
  std::size_t next_change_ = 0;
  bool proved_ = false;       ///< several of them agree on the delay
  double least_doubt_s_ = 0;  ///< as long as they do not
};

}  // namespace drover::engine::estimate
