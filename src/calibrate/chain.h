// The model: where the base was ten times a second, what the receiver's slow errors were, and the
// numbers to be found, as residuals against all that was recorded.
#pragma once

#include <optional>
#include <vector>

#include "calibrate/calibrate.h"
#include "calibrate/course.h"
#include "calibrate/elimination.h"
#include "calibrate/signs.h"

namespace drover::calibrate {

/// Places in NodeValues.
enum Of : std::size_t { kX, kY, kYaw, kSlowX, kSlowY, kSlowYaw };
/// Places in SharedValues.
enum Number : std::size_t {
  kLeftScale,    ///< true way over that of the left wheels
  kRightScale,   ///< likewise
  kTurnGain,     ///< true turn over (right way - left way) / configured track x slip
  kGyroScale,    ///< true turn over the measured one
  kGyroBias,     ///< rad/s, to be taken off after the scale
  kArmX,         ///< m, antenna ahead of base_link
  kArmY,         ///< m, to its left
  kLine,         ///< rad, antenna line from ahead, counter-clockwise
  kPlaceLate,    ///< s
  kHeadingLate,  ///< s
};

/// One sigma of what is assumed before the drive has shown it.
struct Assumed {
  double along_m = 0.01;         ///< per square root of metre
  double across_m = 0.01;        ///< likewise
  double turn_rad = 0.03;        ///< of the wheels' turn, per square root of radian
  double turn_radpm = 0.01;      ///< likewise, per square root of metre
  double gyro_rad = 0.0005;      ///< per square root of second
  double place_white_m = 0.005;  ///< of each position
  double place_slow_m = 0.01;    ///< of the error that stays
  double place_slow_s = 30;      ///< for about so long
  double heading_white_rad = 0.005;
  double heading_slow_rad = 0.002;
  double heading_slow_s = 20;
};

class Chain final {
 public:
  Chain(const Drive& drive, const Configured& configured, const Signs& signs,
        const FirstGuess& guess);

  std::size_t size() const { return nodes_.size(); }
  double node_s(std::size_t node) const { return begin_s_ + step_s_ * static_cast<double>(node); }
  double step_s() const { return step_s_; }
  const Assumed& assumed() const { return assumed_; }
  const SharedValues& shared() const { return shared_; }
  const std::vector<NodeValues>& values() const { return values_; }
  const Track& track() const { return track_; }

  /// Residuals and slopes at the present values, in the order of the nodes.
  void rows(std::vector<Row>& into) const;
  Prior prior() const;
  void step(const SharedValues& shared, const std::vector<NodeValues>& nodes);

  /// By the present numbers: turn up to `time_s` by gyro or wheels, and speeds about it.
  double turned_rad(double time_s) const;
  double turn_radps(double time_s) const;
  double rolled_m(double from_s, double to_s) const;
  double speed_mps(double time_s) const;

 private:
  /// What was measured about a node, and what happened until the next.
  struct Node {
    std::optional<PlaceRow> place;
    std::optional<ValueRow> heading;
    double left_m = 0;
    double right_m = 0;
    double gyro_rad = 0;
    bool rolled = false;  ///< the wheels were heard all the time
    bool gyro = false;    ///< likewise
  };

  void attach(const Drive& drive);
  void guess_values(const Drive& drive);
  void guess_yaws(const Drive& drive);
  std::optional<double> seen_yaw(const Drive& drive, double time_s) const;
  void anchor_rows(std::vector<Row>& into) const;
  void slow_rows(std::size_t k, std::vector<Row>& into) const;
  void way_rows(std::size_t k, std::vector<Row>& into) const;
  void turn_rows(std::size_t k, std::vector<Row>& into) const;
  void place_rows(std::size_t k, std::vector<Row>& into) const;
  void heading_row(std::size_t k, std::vector<Row>& into) const;

  Assumed assumed_;
  SharedValues before_{};  ///< the prior's middle
  Track track_;
  double width_m_;
  bool has_headings_;
  double begin_s_ = 0;
  double step_s_ = 0.1;
  std::vector<Node> nodes_;
  SharedValues shared_{};
  std::vector<NodeValues> values_;
};

}  // namespace drover::calibrate
