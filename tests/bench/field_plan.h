// What is wrong in a field, and the robot and the track of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "drover/angle.h"
#include "engine/config.h"
#include "support/tracks.h"

namespace drover::bench {

/// When it happens: by the way driven since the start, or by the time since the start.
struct Span {
  double from = INFINITY;
  double to = INFINITY;
  bool holds(double at) const { return at >= from && at < to; }
};

/// One of many, beside the one of each kind that a plan names.
struct Trouble {
  enum class Kind { slip, slope, shove, outage, floats, step } kind = Kind::slip;
  Span span;               ///< s since the start; of a slope m of way
  double size = 0;         ///< share of the way, degrees, m to the left, m of a step
  double towards_rad = 0;  ///< of a step
  bool holds(Kind wanted, double at) const { return kind == wanted && span.holds(at); }
};

/// All of it nothing at first.
struct FieldPlan {
  double speed_mps = 0.5;
  // Ground.
  Span slip_s;            ///< the wheels roll more than the base moves
  double slip_share = 0;  ///< of the way
  Span slope_m;           ///< ground that falls to the south
  double slope_deg = 0;
  double crab_per_slope = 0.5;  ///< course beside the heading over the slope
  double shove_at_s = INFINITY;
  double shove_left_m = 0;  ///< within 0.4 s
  double tyres = 1;         ///< true radius over the configured one
  // Receiver.
  double receiver_Hz = 10;
  double sigma_m = 0.01;
  bool gst = false;  ///< it tells how well it knows
  Span outage_s;     ///< no positions and headings
  Span float_s;      ///< float solution
  Span drift_m;      ///< the place wanders to the north while this is driven
  double drift_mps = 0;
  Span step_s;  ///< it is elsewhere
  double step_m = 0;
  double step_rad = 0;
  double late_s = 0;           ///< later than the gateway believes
  double heading_epoch_s = 0;  ///< the heading is so much older than the position
  double heading_off_deg = 0;  ///< of the antenna line, not told to the gateway
  Span heading_wrong_s;
  double heading_wrong_deg = 0;
  Span no_heading_s;     ///< none is told: one antenna
  double lever_x_m = 0;  ///< true antenna beside the configured one
  double lever_y_m = 0;
  // Inertial sensor.
  bool imu = true;
  double imu_roll_deg = 0;  ///< mounted so, and not told
  std::vector<Trouble> more;

  /// Share of the way, the worst of what holds.
  double slip_at(double since_s) const {
    double share = slip_s.holds(since_s) ? slip_share : 0;
    for (const Trouble& t : more)
      if (t.holds(Trouble::Kind::slip, since_s)) share = std::max(share, t.size);
    return share;
  }
  double slope_deg_at(double moved_m) const {
    double deg = slope_m.holds(moved_m) ? slope_deg : 0;
    for (const Trouble& t : more)
      if (t.holds(Trouble::Kind::slope, moved_m)) deg = t.size;
    return deg;
  }
  bool is_out(double since_s) const {
    return outage_s.holds(since_s) || any(Trouble::Kind::outage, since_s);
  }
  bool floats(double since_s) const {
    return float_s.holds(since_s) || any(Trouble::Kind::floats, since_s);
  }

  /// Wheels slip, or slipped since the last fix that had settled: nobody could see it.
  bool slips_unseen(double since_s) const {
    constexpr double kSettled_s = 3.3;
    constexpr double kEach_s = 0.1;
    double fixed_s = 0;
    double at_s = since_s;
    for (; at_s > 0 && fixed_s < kSettled_s; at_s -= kEach_s)
      fixed_s = is_out(at_s) || floats(at_s) ? 0 : fixed_s + kEach_s;
    if (since_s - at_s < kSettled_s + 2 * kEach_s) return false;  // there was one all the time
    for (at_s += kSettled_s; at_s <= since_s; at_s += kEach_s)
      if (slip_at(at_s) > 0) return true;
    return false;
  }

 private:
  bool any(Trouble::Kind kind, double since_s) const {
    return std::any_of(more.begin(), more.end(),
                       [&](const Trouble& t) { return t.holds(kind, since_s); });
  }
};

inline engine::EngineConfig field_config() {
  engine::EngineConfig config;
  for (const char* name : {"front_left", "front_right", "rear_left", "rear_right"}) {
    (void)config.joints.push_back(name);
  }
  for (const AxisId id : {AxisId{0}, AxisId{2}}) (void)config.base.left.push_back(id);
  for (const AxisId id : {AxisId{1}, AxisId{3}}) (void)config.base.right.push_back(id);
  config.estimate.antenna_x_m = 0.1;
  config.estimate.antenna_z_m = 0.6;
  config.base.hold = engine::HoldBy::brake;
  config.base.max_tilt_deg = 20;
  config.base.yaw_slip_factor = 1.2;
  return config;
}

/// Rows of `leg_m` with U-turns of 1.5 m between them, a point each half metre.
inline Path field_rows(int rows, double leg_m) {
  test::Pen pen;
  for (int row = 0; row < rows; ++row) {
    if (row > 0) pen.arc(1.5, row % 2 == 1 ? kPi : -kPi);
    pen.line(leg_m);
  }
  Path path = test::record(pen.points());
  path.name = "rows";
  return path;
}

/// What estimates are judged on: rows of 20 m, 60 m straight on, or as much in a bend of 10 m.
enum class FieldWay { rows, straight, curve };

inline Path field_way(FieldWay way, int rows) {
  if (way == FieldWay::rows) return field_rows(rows, 20);
  if (way == FieldWay::straight) return field_rows(1, 60);
  test::Pen pen;
  pen.arc(10, 6);
  Path path = test::record(pen.points());
  path.name = "curve";
  return path;
}

}  // namespace drover::bench
