// Where the robot is, and what is free about it.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "scene/constraint/evaluate.h"
#include "scene/keeper/keeper_impl.h"
#include "scene/keeper/track_check_impl.h"
#include "scene/keeper/way_line.h"
#include "scene/look/with_edges.h"
#include "scene/look/with_points.h"
#include "scene/look/with_sensor.h"
#include "scene/plane/track_line.h"
#include "scene/world/map_change.h"
#include "scene/world/planar_pose.h"
#include "text/utf8.h"

namespace drover::scene {
namespace {

constexpr double kAtCorner_m = 0.05;

/// What it does; at rest what it is asked to do.
Twist looked_along(const Viewpoint& from) {
  const bool goes = drives(from.commanded) || goes_sideways(from.commanded) ||
                    !std::isfinite(from.commanded.vx_mps);
  return goes ? from.commanded : from.asked;
}

/// Ahead, as it is or is told to be.
double fastest_mps(const Viewpoint& from) {
  double fastest_mps = 0;
  for (const double vx_mps : {from.pose.vx_mps, from.commanded.vx_mps})
    if (std::isfinite(vx_mps)) fastest_mps = std::max(fastest_mps, vx_mps);
  return fastest_mps;
}

/// Ahead since then: a field was seen a moment before the pose.
double driven_m(const Viewpoint& from, const sensor::OwnWay& way, Time since) {
  if (since == kNever || !(since < from.t)) return 0;
  return way.pose() ? way.ahead_m(since) : fastest_mps(from) * to_s(from.t - since);
}

std::vector<Step> in_base_link(std::vector<Step> steps) {
  if (steps.empty()) return steps;
  const Pose2 to_base = back(steps.front().pose);
  for (Step& step : steps) step.pose = product(to_base, step.pose);
  return steps;
}

/// The track goes on the way that the robot looks. Of one that turns on the spot it does so only
/// when it has turned: what its field sweeps over meanwhile is not on its track.
bool is_ahead(const WayLine& line, double yaw_rad, double pivot_rad, bool turns) {
  const TrackLine track(line.points, pivot_rad, line.backwards);
  if (track.empty()) return true;
  const TrackLine::Leg* leg = &track.legs().front();
  const double at_corner_m = turns ? kTurnsAt_m : kAtCorner_m;
  for (const TrackLine::Leg& next : track.legs())
    if (track.first_m(next) <= line.from_m + at_corner_m) leg = &next;
  if (track.is_backwards(*leg)) return false;
  const double on_m = std::max(line.from_m, track.first_m(*leg));
  const double off_rad = wrap_rad(track.place(*leg, on_m).yaw_rad - yaw_rad);
  return !(std::abs(off_rad) >= (turns ? kTurnsOver_rad : pivot_rad));
}

/// What is measured and what is allowed stand at its end: where not all has room the name is cut.
Reason in_words_of(const Verdict& broken, std::size_t room) {
  constexpr std::size_t kLeastShown = 24;
  constexpr std::size_t kMostShown = 72;
  const std::string_view between =
      broken.can_be_judged() ? " does not hold: " : " cannot be judged: ";
  std::string words = "constraint ";
  const std::size_t others = words.size() + between.size() + broken.why.size();
  const std::size_t left = room > others ? room - others : 0;
  words += text::beginning(broken.which, std::clamp(left, kLeastShown, kMostShown));
  words += between;
  words += broken.why;
  return Reason(text::beginning(words, room));
}

}  // namespace

sensor::NearSettings Keeper::Impl::near_settings(const KeeperSettings& settings) {
  // What it drives up to was seen before it is in the turning circle.
  return {settings.look.footprint, turning_circle_m(settings.look) + 2 * kNearby_m,
          settings.seen_kept};
}

Pose2 Keeper::Impl::pose() const {
  if (!viewpoint) return {kAbsent, kAbsent, kAbsent};
  const drover::Pose& pose = viewpoint->pose;
  return {pose.x_m, pose.y_m,
          is_heading(pose.yaw_rad, pose.yaw_sigma_rad) ? pose.yaw_rad : kAbsent};
}

double Keeper::Impl::position_sigma_m() const {
  return viewpoint ? viewpoint->pose.position_sigma_m : kAbsent;
}

double Keeper::Impl::yaw_sigma_rad() const {
  return viewpoint ? viewpoint->pose.yaw_sigma_rad : kAbsent;
}

Steering Keeper::Impl::steering() const {
  const double vx_mps = viewpoint ? std::abs(viewpoint->commanded.vx_mps) : 0;
  const double lookahead_m = settings.lookahead_s * (std::isfinite(vx_mps) ? vx_mps : 0);
  return {settings.pivot_rad, std::max(lookahead_m, settings.min_lookahead_m)};
}

Terms Keeper::Impl::terms() const {
  Terms terms;
  terms.extent.margin_m = settings.look.sigmas * position_sigma_m();
  terms.extent.turn_rad = settings.look.sigmas * yaw_sigma_rad();
  return terms;
}

std::optional<Verdict> Keeper::Impl::broken() const {
  if (world.constraints().empty()) return std::nullopt;
  RobotState state;
  state.base = pose();
  if (viewpoint && std::isfinite(viewpoint->roll_rad) && std::isfinite(viewpoint->pitch_rad))
    state.tilt = Tilt{viewpoint->roll_rad, viewpoint->pitch_rad};
  for (std::size_t i = 0; viewpoint && i < settings.joints.size(); ++i) {
    const bool told = i < viewpoint->joint_rad.size();
    state.joints.push_back({.name = settings.joints[i],
                            .position = told ? viewpoint->joint_rad[i] : kAbsent,
                            .velocity = kAbsent});
  }
  return heaviest_broken(world, settings.robot, state, terms());
}

Reason with_way_out(const Verdict& broken) {
  constexpr std::string_view kWayOut = "; take it away or push it";
  const Reason what = in_words_of(broken, Reason::capacity() - kWayOut.size());
  // Who is pushed comes back to where it holds, but learns nothing that is missing.
  const std::size_t told = broken.can_be_judged() ? kWayOut.size() : kWayOut.find(" or push it");
  Reason words;
  words.format("%.*s%.*s", static_cast<int>(what.view().size()), what.view().data(),
               static_cast<int>(told), kWayOut.data());
  return words;
}

Reason in_words(const Verdict& broken) {
  return in_words_of(broken, Reason::capacity());
}

void Keeper::Impl::move_map(const Viewpoint& from) {
  if (!from.origin_set) return;
  const bool was_bad = origin_is_bad;
  origin_is_bad = !is_origin(from.origin);
  if (origin_is_bad) {
    if (!was_bad) change();
    return;
  }
  if (world.origin() && same_origin(*world.origin(), from.origin)) {
    if (was_bad) change();
    return;
  }
  world.move_origin(from.origin);
  poses.clear();
  place_all();
}

void Keeper::see(const Viewpoint& from) {
  Impl& impl = *impl_;
  // Poses of another place are no help to place what was seen from there.
  if (!impl.viewpoint || impl.viewpoint->place != from.place) impl.poses.clear();
  impl.move_map(from);
  impl.viewpoint = from;
  impl.own_way.note(from.t, {from.pose.vx_mps, from.pose.wz_radps, from.pose.vy_mps},
                    fastest_mps(from));
  const double sigma_m = impl.position_sigma_m();
  const Pose2 pose = impl.pose();
  if (position_problem(pose, sigma_m).empty())
    impl.poses.add(from.t, pose, sigma_m,
                   std::isfinite(pose.yaw_rad) ? impl.yaw_sigma_rad() : kAbsent);
}

void Keeper::set_sensors(const std::optional<sensor::FieldView>& view) {
  impl_->sensors = view;
}

void Keeper::see_turn(std::uint8_t scanner, const sensor::SeenTurn& turn) {
  Impl& impl = *impl_;
  if (impl.scanners.size() <= scanner) impl.scanners.resize(scanner + std::size_t{1});
  impl.scanners[scanner] = turn.device;
  impl.near_things.see(scanner, turn, impl.own_way);
}

Clearance Keeper::look(const Path* path) const {
  const Impl& impl = *impl_;
  Clearance found;
  if (!impl.viewpoint) {
    found.scene = impl.around.number;
    found.unknown = "the robot was not heard yet";
    return found;
  }
  const Viewpoint& seen = *impl.viewpoint;
  Standpoint from;
  from.t = seen.t;
  from.pose = impl.pose();
  from.position_sigma_m = impl.position_sigma_m();
  from.yaw_sigma_rad = impl.yaw_sigma_rad();
  from.twist = looked_along(seen);
  std::optional<WayLine> line;
  if (seen.way.path != 0 && path != nullptr && path->number == seen.way.path) {
    from.path = path->number;
    line = line_about(*path, seen.way, impl.settings.look.along_m);
  }
  if (line) {
    from.line = line->points;
    from.line_backwards = line->backwards;
    from.line_from_m = line->from_m;
    from.line_ends = line->ends;
  }
  LookSettings look_settings = impl.settings.look;
  look_settings.steering = impl.steering();
  auto track = track_way(look_settings, from);
  found = scene::look(impl.around, look_settings, from, track);
  if (found.unknown.empty() && impl.around.constrained) {
    const Terms terms = impl.terms();
    const Terms by_margin_alone;
    const Edges edges(impl.world, impl.settings.robot, terms, from.pose);
    const Edges bare(impl.world, impl.settings.robot, by_margin_alone, from.pose);
    found = with_edges(found, {edges, bare}, look_settings, from, track);
    if (const auto broken = impl.broken()) found.broken = with_way_out(*broken);
  }
  if (!impl.sensors) return found;
  const auto points = impl.near_things.all(impl.own_way);
  found = with_points(found, points, impl.scanners, impl.settings.look, from.t,
                      in_base_link(std::move(track)));
  SensorTerms terms{impl.settings.look.margin_m, true,
                    driven_m(seen, impl.own_way, impl.sensors->since)};
  if (line)
    terms.track_ahead =
        is_ahead(*line, from.pose.yaw_rad, impl.settings.pivot_rad, is_turn(from.twist));
  return with_sensor(found, *impl.sensors, terms);
}

std::unique_ptr<TrackCheck> Keeper::check(const Path& path, std::uint32_t target) const {
  return std::make_unique<TrackCheck>(std::make_unique<TrackCheck::Impl>(*impl_, path, target));
}

std::optional<Point2> Keeper::nearest_of(std::string_view object) const {
  const Area* area = impl_->around.field.find(object);
  const bool is_placed = std::isfinite(impl_->position_sigma_m());
  if (area == nullptr || area->empty() || !is_placed) return std::nullopt;
  const Pose2 pose = impl_->pose();
  return nearest(*area, {pose.x_m, pose.y_m});
}

}  // namespace drover::scene
