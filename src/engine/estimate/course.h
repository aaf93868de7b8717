// Finds the heading of a base with one antenna from the direction in which it drives: the way by
// RTK positions beside the same way by wheels and gyro.
#pragma once

#include <optional>

#include "drover/time.h"
#include "engine/config.h"

namespace drover::engine::estimate {

/// The way since one RTK position, in the axes that base_link had there.
struct Course {
  Time since = kNever;  ///< kNever: not begun
  double x_m = 0;       ///< of the antenna then, in `map`
  double y_m = 0;
  double sigma_m = 0;
  double ahead_m = 0;  ///< of base_link, dead reckoned
  double left_m = 0;
  double yaw_rad = 0;
  double way_m = 0;  ///< rolled, either direction
  double turn_rad = 0;

  void begin(double antenna_x_m, double antenna_y_m, double sigma, Time now);
  void advance(double way, double turn);
};

/// The antenna over base_link, in horizontal axes of the base.
struct LeverArm {
  double ahead_m = 0;
  double left_m = 0;
};

struct CourseHeading {
  double yaw_rad = 0;
  double sigma_rad = 0;
};

/// A new RTK position of the antenna. The heading once a metre has been driven without much of a
/// turn, forwards or in reverse; also begins the way anew where it says nothing.
std::optional<CourseHeading> heading_of_course(Course& course, double antenna_x_m,
                                               double antenna_y_m, double sigma_m,
                                               const LeverArm& arm, Time now,
                                               const EstimateConfig& config);

}  // namespace drover::engine::estimate
