// The poses along a line as the tracker drives it: smooth where it bends, on the spot where it has
// a corner.
#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/plane/steps.h"
#include "scene/plane/track_line.h"

namespace drover::scene {
namespace {

constexpr double kAbout_m = 1.0;
constexpr double kAtCorner_m = 0.1;
constexpr double kTurned_rad = 0.1;
constexpr double kMostStrides = 1e5;
constexpr double kLongestOfApproach_m = 0.25;

/// How the robot lies on the smooth line.
struct Offset {
  double left_m = 0;
  double turn_rad = 0;

  bool is_gone() const { return std::abs(left_m) < 1e-3 && std::abs(turn_rad) < 1e-3; }
};

/// The tracker's law of steering, on a line that is straight for as long: what bends it turns with.
class Approach {
 public:
  Approach(double lookahead_m, double stride_m)
      : damping_(2.4 / lookahead_m),
        stiffness_(2.0 / (lookahead_m * lookahead_m)),
        stride_m_(stride_m) {}

  /// Drives on for a stride or three degrees; returns the way along the line.
  double drive(Offset& offset) const {
    double along_m = 0;
    double driven_m = 0;
    double turned_rad = 0;
    while (driven_m < stride_m_ && turned_rad < kStepTurn_rad) {
      const double off_rad = wrap_rad(offset.turn_rad - back_rad(offset.left_m));
      // Badly turned it rather turns than goes.
      const double goes = std::clamp(1 - (std::abs(off_rad) - 0.5) / 0.7, 0.0, 1.0);
      const double turns_radpm = -damping_ * off_rad * std::max(goes, 0.5);
      const double fine = std::min(1.0, 0.2 * kStepTurn_rad / (kFine_m * std::abs(turns_radpm)));
      const double step_m = kFine_m * fine;
      const double turn_rad = offset.turn_rad + 0.5 * step_m * turns_radpm;
      offset.left_m += goes * step_m * std::sin(turn_rad);
      offset.turn_rad = wrap_rad(offset.turn_rad + step_m * turns_radpm);
      along_m += goes * step_m * std::cos(turn_rad);
      driven_m += step_m;
      turned_rad += std::abs(step_m * turns_radpm);
    }
    return along_m;
  }

 private:
  static constexpr double kFine_m = 0.01;
  static constexpr double kSteepest_rad = 1.0;

  double back_rad(double left_m) const {
    return -kSteepest_rad * std::tanh(stiffness_ / damping_ * left_m / kSteepest_rad);
  }

  double damping_;
  double stiffness_;
  double stride_m_;
};

/// Steps that grow.
class Steps {
 public:
  explicit Steps(const Pose2& from) : steps_{{from, 0, 0}} {}

  const Pose2& pose() const { return steps_.back().pose; }
  /// What turns by more than a step may is made of several.
  void go(const Pose2& to, double driven_m) {
    const Step from = steps_.back();
    const double turn_rad = wrap_rad(to.yaw_rad - from.pose.yaw_rad);
    const int count = std::max(1, static_cast<int>(std::ceil(std::abs(turn_rad) / kStepTurn_rad)));
    const double way_m = std::max(driven_m - from.driven_m, 0.0);
    for (int i = 1; i <= count; ++i) {
      const double part = static_cast<double>(i) / count;
      steps_.push_back({between(from.pose, to, part), from.driven_m + part * way_m,
                        from.turned_rad + part * std::abs(turn_rad)});
    }
  }
  void pivot(double yaw_rad) {
    Pose2 turned = pose();
    turned.yaw_rad = yaw_rad;
    if (wrap_rad(yaw_rad - pose().yaw_rad) != 0) go(turned, steps_.back().driven_m);
  }
  std::vector<Step> take() { return std::move(steps_); }

 private:
  std::vector<Step> steps_;
};

/// Drives a line, leg by leg.
class Driver {
 public:
  Driver(const TrackLine& line, const Steering& steering, double stride_m, double from_m)
      : line_(line),
        steering_(steering),
        approach_(std::max(steering.lookahead_m, 0.05), std::min(stride_m, kLongestOfApproach_m)),
        stride_m_(stride_m),
        from_m_(from_m) {}

  bool has_begun() const { return begun_; }
  void drive(const TrackLine::Leg& leg, double until_m, Steps& steps) {
    looks_rad_ = line_.is_backwards(leg) ? kPi : 0;
    const double end_m = std::min(leg.last_m, until_m);
    double s_m = begun_ ? s_m_ : from_m_;
    Offset offset = offset_at(leg, s_m, steps.pose());
    const bool at_corner = leg.first != 0 && s_m - leg.first_m < kAtCorner_m &&
                           std::abs(offset.turn_rad) > kTurned_rad;
    if (begun_ || at_corner || std::abs(offset.turn_rad) >= steering_.pivot_rad) {
      steps.pivot(wrap_rad(line_.place(leg, s_m).yaw_rad + looks_rad_));
      offset.turn_rad = 0;
    }
    // An approach is a few metres; a track that folds up is not one for ever.
    int patience = kMostOfApproach;
    while (s_m < end_m) {
      if (offset.is_gone() || patience-- == 0) offset = {};
      const bool on_line = offset.left_m == 0 && offset.turn_rad == 0;
      s_m += on_line ? std::min(stride_m_, end_m - s_m) : approach_.drive(offset);
      if (s_m > end_m - 1e-9) s_m = end_m;
      steps.go(pose_at(leg, s_m, offset), s_m - from_m_);
    }
    s_m_ = s_m;
    begun_ = true;
  }

 private:
  static constexpr int kMostOfApproach = 1000;

  Offset offset_at(const TrackLine::Leg& leg, double s_m, const Pose2& pose) const {
    const TrackLine::Place on = line_.place(leg, s_m);
    return {cross(direction(on.yaw_rad), place_of(pose) - on.point),
            wrap_rad(pose.yaw_rad + looks_rad_ - on.yaw_rad)};
  }
  Pose2 pose_at(const TrackLine::Leg& leg, double s_m, const Offset& offset) const {
    const TrackLine::Place on = line_.place(leg, s_m);
    Point2 at = on.point;
    // Where a leg ends the line is its last point, but for rounding.
    const Point2 end = line_.last_point(leg);
    if (s_m == leg.last_m && length_m(at - end) < 1e-6) at = end;
    const Point2 ahead = direction(on.yaw_rad);
    at = at + offset.left_m * Point2{-ahead.y_m, ahead.x_m};
    return {at.x_m, at.y_m, on.yaw_rad + offset.turn_rad + looks_rad_};
  }

  const TrackLine& line_;
  const Steering& steering_;
  Approach approach_;
  double stride_m_;
  double from_m_;
  double s_m_ = 0;
  bool begun_ = false;    ///< a leg before this one was driven
  double looks_rad_ = 0;  ///< how the robot looks on this leg, against its way
};

bool are_finite(const Pose2& from, std::span<const Point2> line) {
  return is_finite(from) &&
         std::all_of(line.begin(), line.end(), [](Point2 point) { return is_finite(point); });
}

/// The line, or with the way to it before it; `from_m`: where on it the robot is, before its
/// beginning too, which it begins straight. `backwards`: as the part's, of these points.
std::vector<Point2> line_of(const Pose2& from, const TrackPart& part, double& from_m,
                            std::vector<std::uint8_t>& backwards) {
  std::vector<Point2> points(part.line.begin(), part.line.end());
  backwards.assign(part.backwards.begin(), part.backwards.end());
  const TrackLine line(points, kPi);
  const Point2 at = place_of(from);
  if (!line.empty()) {
    from_m = line.foot_m(at, part.near_m - kAbout_m, part.near_m + kAbout_m);
    const TrackLine::Leg& leg = line.legs().front();
    if (from_m == 0) from_m = std::min(0.0, dot(from_track(leg.enter), at - points.front()));
    if (length_m(at - line.place(leg, from_m).point) <= kFarBeside_m) return points;
  }
  from_m = 0;
  points.insert(points.begin(), at);
  if (!backwards.empty()) backwards.insert(backwards.begin(), backwards.front());
  return points;
}

/// The robot is at the corner between two legs and on its turn there, nearer to the second one.
bool turns_already(const TrackLine& line, const TrackLine::Leg& leg, const TrackLine::Leg& next,
                   const Pose2& from, double from_m) {
  if (leg.last_m - from_m > kAtCorner_m) return false;
  const Point2 ahead = direction(from.yaw_rad);
  const double before = line.is_backwards(leg) ? -1 : 1;
  const double after = line.is_backwards(next) ? -1 : 1;
  return after * dot(ahead, from_track(next.enter)) > before * dot(ahead, from_track(leg.leave));
}

}  // namespace

std::vector<Step> track_steps(const Pose2& from, const TrackPart& part, const Steering& steering,
                              double stride_m) {
  if (part.line.empty()) return {{from, 0, 0}};
  if (!are_finite(from, part.line) || !std::isfinite(part.near_m) || std::isnan(part.most_m) ||
      !std::isfinite(stride_m) || !std::isfinite(steering.lookahead_m))
    return unknown_way(from);
  double from_m = 0;
  std::vector<std::uint8_t> backwards;
  const std::vector<Point2> points = line_of(from, part, from_m, backwards);
  const TrackLine line(points, steering.pivot_rad, backwards);
  Steps steps(from);
  if (line.empty()) return steps.take();
  // A line that is longer than any has longer steps.
  stride_m = std::max({stride_m, 1e-3, line.end_m() / kMostStrides});
  Driver driver(line, steering, stride_m, from_m);
  const double until_m = from_m + part.most_m;
  for (std::size_t i = 0; i < line.legs().size(); ++i) {
    const TrackLine::Leg& leg = line.legs()[i];
    if (driver.has_begun() && leg.first_m >= until_m) break;
    const bool is_last = i + 1 == line.legs().size();
    if (leg.last_m <= from_m && !is_last) continue;
    if (!driver.has_begun() && !is_last &&
        turns_already(line, leg, line.legs()[i + 1], from, from_m))
      continue;
    driver.drive(leg, until_m, steps);
  }
  return steps.take();
}

std::vector<Step> track_steps(const Pose2& from, std::span<const Point2> line, double stride_m,
                              double pivot_rad) {
  // The first 2 m are 1 m about the first one.
  return track_steps(from, {line, kAbout_m}, {pivot_rad}, stride_m);
}

}  // namespace drover::scene
