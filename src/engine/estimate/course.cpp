#include "engine/estimate/course.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"

namespace drover::engine::estimate {
namespace {

constexpr double kShortest_m = 1.0;
constexpr double kMostTurn_rad = 0.3;
constexpr Duration kLongest = std::chrono::seconds(30);
// Wheels and receiver must agree about the length, or the direction means nothing.
constexpr double kLengthShare = 0.15;

}  // namespace

void Course::begin(double antenna_x_m, double antenna_y_m, double sigma, Time now) {
  *this = Course{};
  since = now;
  x_m = antenna_x_m;
  y_m = antenna_y_m;
  sigma_m = sigma;
}

void Course::advance(double way, double turn) {
  const double middle_rad = yaw_rad + turn / 2;
  ahead_m += way * std::cos(middle_rad);
  left_m += way * std::sin(middle_rad);
  yaw_rad += turn;
  way_m += std::abs(way);
  turn_rad += std::abs(turn);
}

std::optional<CourseHeading> heading_of_course(Course& course, double antenna_x_m,
                                               double antenna_y_m, double sigma_m,
                                               const LeverArm& arm, Time now,
                                               const EstimateConfig& config) {
  const bool useless =
      course.since == kNever || course.turn_rad > kMostTurn_rad || now - course.since > kLongest;
  if (useless) {
    course.begin(antenna_x_m, antenna_y_m, sigma_m, now);
    return std::nullopt;
  }
  // The antenna's own way in the axes of the beginning: a turn swings it about base_link.
  const double c = std::cos(course.yaw_rad);
  const double s = std::sin(course.yaw_rad);
  const double ahead_m = course.ahead_m + arm.ahead_m * c - arm.left_m * s - arm.ahead_m;
  const double left_m = course.left_m + arm.ahead_m * s + arm.left_m * c - arm.left_m;
  const double rolled_m = std::hypot(ahead_m, left_m);
  if (rolled_m < kShortest_m) return std::nullopt;
  const double dx = antenna_x_m - course.x_m;
  const double dy = antenna_y_m - course.y_m;
  const double moved_m = std::hypot(dx, dy);
  const double noise_m = std::hypot(course.sigma_m, sigma_m);
  if (std::abs(moved_m - rolled_m) > kLengthShare * rolled_m + 3 * noise_m) {
    course.begin(antenna_x_m, antenna_y_m, sigma_m, now);
    return std::nullopt;
  }
  CourseHeading heading;
  heading.yaw_rad = wrap_rad(std::atan2(dy, dx) - std::atan2(left_m, ahead_m) + course.yaw_rad);
  const double bend_rad = config.odometry_yaw_rad * std::sqrt(course.way_m) +
                          config.turning_yaw_rad * std::sqrt(course.turn_rad);
  const double aside_rad = config.odometry_across_m / std::sqrt(course.way_m);
  heading.sigma_rad = std::hypot(noise_m / moved_m, bend_rad, aside_rad);
  return heading;
}

}  // namespace drover::engine::estimate
