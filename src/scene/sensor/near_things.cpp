#include "scene/sensor/near_things.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/plane/steps.h"
#include "scene/sensor/field.h"

namespace drover::scene::sensor {
namespace {

constexpr double kCell_m = 0.025;
constexpr double kForget_m = 1.0;      // beyond what is taken
constexpr double kDriven_m = 0.1;      // so deep under the robot nothing is
constexpr double kRangeError_m = 0.1;  // along a beam
constexpr double kSide_m = 0.06;       // to each side of a place: what a robot's own way drifts
constexpr double kLeastSide_rad = to_rad(2.0);

Point2 into(const Pose2& frame, Point2 p) {
  const Point2 ahead = direction(frame.yaw_rad);
  const Point2 d = p - place_of(frame);
  return {dot(ahead, d), cross(ahead, d)};
}

Point2 out_of(const Pose2& frame, Point2 p) {
  const Point2 ahead = direction(frame.yaw_rad);
  return place_of(frame) +
         Point2{ahead.x_m * p.x_m - ahead.y_m * p.y_m, ahead.y_m * p.x_m + ahead.x_m * p.y_m};
}

std::int32_t cell_of(double m) {
  return static_cast<std::int32_t>(std::floor(m / kCell_m));
}

/// Of a beam that came back what it met.
struct Met {
  Point2 in_base;  ///< when it was measured
  Point2 at;       ///< in the frame of the robot's own way
};

/// Of a turn that began before the way is known the robot stood still.
std::vector<Met> what_is_met(const SeenTurn& turn, const Pose2& begin, const Pose2& end) {
  std::vector<Met> all;
  all.reserve(turn.scan.points.size());
  const auto count = static_cast<double>(turn.scan.points.size());
  double i = 0;
  for (const ScanPoint& point : turn.scan.points) {
    const double part = i++ / count;
    if (!(point.range_m > 0)) continue;
    const Point2 in_base = to_base(turn.mount, point);
    if (is_finite(in_base)) all.push_back({in_base, out_of(between(begin, end, part), in_base)});
  }
  return all;
}

/// All that came back, by the direction from where the scanner is at the end of its turn.
class Beams {
 public:
  Beams(const std::vector<Met>& all, const Pose2& here, Point2 eye) : eye_(eye) {
    beams_.reserve(all.size());
    for (const Met& met : all) {
      const Point2 ray = into(here, met.at) - eye;
      beams_.emplace_back(std::atan2(ray.y_m, ray.x_m), length_m(ray));
    }
    std::sort(beams_.begin(), beams_.end());
  }

  /// This place (in base_link) is seen now, whatever is there: before it, and some way to both
  /// sides, no beam ends.
  bool see(Point2 at) const {
    const Point2 ray = at - eye_;
    const double range_m = std::max(length_m(ray), 0.01);
    const double direction_rad = std::atan2(ray.y_m, ray.x_m);
    const double side_rad = std::max(std::asin(std::min(kSide_m / range_m, 1.0)), kLeastSide_rad);
    std::array<bool, 3> seen{};
    auto beam = std::lower_bound(beams_.begin(), beams_.end(),
                                 std::pair(wrap_rad(direction_rad - side_rad), 0.0));
    for (std::size_t i = 0; i < beams_.size(); ++i, ++beam) {
      if (beam == beams_.end()) beam = beams_.begin();
      const double off_rad = wrap_rad(beam->first - direction_rad);
      if (std::abs(off_rad) > side_rad) break;
      if (beam->second < range_m - kRangeError_m) return false;
      seen[off_rad < -side_rad / 3 ? 0 : off_rad > side_rad / 3 ? 2 : 1] = true;
    }
    return seen[0] && seen[1] && seen[2];
  }

 private:
  Point2 eye_;
  std::vector<std::pair<double, double>> beams_;  ///< direction and range
};

}  // namespace

double depth_m(const Piece& outline, Point2 point) {
  const std::size_t count = outline.corners.size();
  if (count < 3) return -std::numeric_limits<double>::infinity();
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const Point2 side = outline.corners[(i + 1) % count] - outline.corners[i];
    least_m = std::min(least_m, cross(side, point - outline.corners[i]) / length_m(side));
  }
  return least_m;
}

NearThings::NearThings(NearSettings settings)
    : settings_(std::move(settings)), body_(piece_of(settings_.footprint)) {}

Time NearThings::newest(std::uint8_t scanner) const {
  const auto turn = turns_.find(scanner);
  return turn == turns_.end() ? kNever : turn->second;
}

void NearThings::see(std::uint8_t scanner, const SeenTurn& turn, const OwnWay& way) {
  if (turn.scan.begin == kNever || turn.scan.begin == newest(scanner)) return;
  if (way.frame() != frame_) kept_.clear();
  frame_ = way.frame();
  const auto here = way.pose(turn.scan.end);
  if (!here) return;
  turns_[scanner] = turn.scan.begin;
  const auto met = what_is_met(turn, way.pose(turn.scan.begin).value_or(*here), *here);
  const Beams beams(met, *here, {turn.mount.x_m, turn.mount.y_m});
  std::erase_if(kept_, [&](const auto& one) {
    const Point2 at = into(*here, one.second.at);
    return turn.scan.end - one.second.seen > settings_.kept || is_beyond(at) ||
           (std::get<0>(one.first) == scanner && beams.see(at));
  });
  for (const auto& [in_base, at] : met) {
    if (length_m(in_base) > settings_.within_m || depth_m(body_, in_base) >= 0) continue;
    kept_[{scanner, cell_of(at.x_m), cell_of(at.y_m)}] = {at, turn.scan.end};
  }
}

/// Far away, or so deep inside the robot that it drove over the place.
bool NearThings::is_beyond(Point2 at) const {
  return length_m(at) > settings_.within_m + kForget_m || depth_m(body_, at) > kDriven_m;
}

std::vector<SeenPoint> NearThings::all(const OwnWay& way) const {
  std::vector<SeenPoint> points;
  const auto here = way.pose();
  if (!here || way.frame() != frame_) return points;
  points.reserve(kept_.size());
  for (const auto& [cell, kept] : kept_)
    points.push_back({into(*here, kept.at), kept.seen, std::get<0>(cell)});
  return points;
}

}  // namespace drover::scene::sensor
