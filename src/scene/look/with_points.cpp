#include "scene/look/with_points.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "scene/look/sweeper.h"
#include "scene/plane/sweep.h"
#include "scene/sensor/seen.h"

namespace drover::scene {
namespace {

/// Points by who saw them, and whether he does: an object each.
Field field_of(std::span<const sensor::SeenPoint> points, std::span<const Name> scanners,
               double within_m, Time now) {
  Field field;
  for (std::size_t i = 0; i < scanners.size(); ++i) {
    for (const bool sees : {true, false}) {
      std::vector<Piece> pieces;
      for (const sensor::SeenPoint& point : points) {
        const bool is_new = now - point.seen <= sensor::kOldestTurn;
        if (point.scanner == i && is_new == sees && length_m(point.at) <= within_m)
          pieces.push_back(disc(point.at, 0));
      }
      if (pieces.empty()) continue;
      const std::string name(scanners[i].view());
      field.put((name.empty() ? "a scanner" : name) + (sees ? " sees" : " saw"),
                area_of(std::move(pieces)));
    }
  }
  return field;
}

class NearPoints final {
 public:
  NearPoints(const Field& field, const LookSettings& settings, std::span<const Step> track)
      : field_(field),
        track_(track),
        body_(piece_of(settings.footprint, settings.margin_m)),
        slim_(piece_of(settings.footprint, slim_margin_m(settings))) {}

  /// Its curve is that of the moment: it says nothing of what the track bends into.
  void bound_track(Clearance& found) const {
    const FreeWay way = first_contact(field_, slim_, track_);
    if (!way.blocked || !shorten(found.along_m, found.bare.along_m, way.free_m)) return;
    if (const double turn = in_first_turn(found.twist, track_, way.free_m); turn != 0)
      tell_turn(way, turn > 0, found);
    else
      found.first.format("%s something, %.2f m along the track", field_.name(way.object).c_str(),
                         way.free_m);
  }
  void bound_turn(bool left, Clearance& found) const {
    const double around_rad = looked_around_rad(left, track_);
    const FreeWay way = first_contact(field_, body_, pivot_steps({}, around_rad));
    if (!way.blocked) return;
    double& way_rad = left ? found.left_rad : found.right_rad;
    double& bare_rad = left ? found.bare.left_rad : found.bare.right_rad;
    const bool nearest = shorten(way_rad, bare_rad, way.free_rad);
    if (!nearest || !is_turn(found.twist) || left != (found.twist.wz_radps > 0)) return;
    tell_turn(way, left, found);
  }
  void bound_curve(bool back, double length_m, Clearance& found) const {
    const Piece& body = back ? body_ : slim_;
    const auto steps = curve_steps({}, found.twist, back, length_m, stride_m(body));
    const FreeWay way = first_contact(field_, body, steps);
    if (!way.blocked) return;
    double& way_m = back ? found.back_m : found.ahead_m;
    double& bare_m = back ? found.bare.back_m : found.bare.ahead_m;
    const bool nearest = shorten(way_m, bare_m, way.free_m);
    const bool asked = !is_turn(found.twist) && back == (found.twist.vx_mps < 0);
    if (nearest && asked && (found.path == 0 || way.free_m < found.along_m))
      found.first.format("%s something, %.2f m %s", field_.name(way.object).c_str(), way.free_m,
                         back ? "back" : "ahead");
  }

 private:
  void tell_turn(const FreeWay& way, bool left, Clearance& found) const {
    if (way.at_start)
      found.turn.format("%s something beside the robot, which has no room to turn",
                        field_.name(way.object).c_str());
    else
      found.turn = in_the_turn(field_.name(way.object), "something", way.free_rad, left);
    // What is beyond the corner's end is met, if ever, after what stands on the track.
    const double corner_rad = std::abs(first_turn_rad(track_));
    const bool is_beyond = found.path != 0 && way.free_rad > corner_rad;
    if (!is_beyond || found.first.empty()) found.first = found.turn;
  }

  const Field& field_;
  std::span<const Step> track_;
  Piece body_;
  Piece slim_;
};

bool bends(const Twist& twist) {
  return drives(twist) && std::abs(twist.wz_radps) > kBends_radpm * std::abs(twist.vx_mps);
}

}  // namespace

double slim_margin_m(const LookSettings& settings) {
  return settings.margin_m / 2;
}

double turning_circle_m(const LookSettings& settings) {
  return reach_m(settings.footprint) + settings.margin_m;
}

Clearance with_points(Clearance found, std::span<const sensor::SeenPoint> points,
                      std::span<const Name> scanners, const LookSettings& settings, Time now,
                      std::span<const Step> track) {
  if (!std::isfinite(found.twist.vx_mps + found.twist.wz_radps)) return found;
  const double within_m = turning_circle_m(settings) + kNearby_m;
  const Field field = field_of(points, scanners, within_m, now);
  if (field.size() == 0) return found;
  const NearPoints seen(field, settings, track);
  if (found.path != 0 && !track.empty()) seen.bound_track(found);
  seen.bound_turn(true, found);
  seen.bound_turn(false, found);
  seen.bound_curve(true, settings.ahead_m, found);
  if (bends(found.twist)) seen.bound_curve(false, settings.ahead_m, found);
  return found;
}

}  // namespace drover::scene
