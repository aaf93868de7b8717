#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/constraint/at_start.h"
#include "scene/keeper/track_check_impl.h"
#include "scene/keeper/track_start.h"
#include "scene/look/sweeper.h"
#include "scene/world/words.h"

namespace drover::scene {
namespace {

// A part has some hundred poses; fewer when there are many constraints to judge at each.
constexpr double kPart_m = 20;
constexpr double kLeastPart_m = 0.5;
constexpr double kConstraintMetres = 1000;
constexpr double kNoWay_m = 1e-6;

std::string way_end_words(const Sweeper& sweeper, const WayEnd& end) {
  return sweeper.name(end) +
         (end.way.at_start && end.way.free_m == 0 ? " is where the robot is" : " is in the way");
}

}  // namespace

TrackCheck::Impl::Impl(const Keeper::Impl& given, const Path& track, std::uint32_t target)
    : keeper(given), path(track), number(given.around.number), pose(given.pose()) {
  const Reason problem = find_problem(target);
  if (!problem.empty()) {
    end(0, 0, problem.view());
  } else if (keeper.around.is_empty()) {
    done = true;
  } else {
    way = way_of_start(path, target, pose);
    const auto line = line_about(path, way, 0);
    const double away_m = line ? length_m(line->place() - place_of(pose)) : 0;
    if (!(away_m <= kFarBeside_m))
      end(way.segment, 0, "the robot is " + words::number(away_m, 0) + " m away from the track");
  }
}

Reason TrackCheck::Impl::find_problem(std::uint32_t target) const {
  const Surroundings& around = keeper.around;
  if (!around.problem.empty()) return around.problem;
  if (!is_track(path, target)) return "the track is none that can be driven";
  if (around.is_empty()) return {};
  if (Reason problem = position_problem(pose, keeper.position_sigma_m()); !problem.empty())
    return problem;
  if (!is_heading(pose.yaw_rad, keeper.yaw_sigma_rad()))
    return "which way the robot looks in its scene is not known";
  return {};
}

void TrackCheck::Impl::end(std::size_t point, double at_m, std::string_view what) {
  offence = TrackOffence{point, at_m, std::string(what)};
  done = true;
}

bool TrackCheck::Impl::advance() {
  if (done) return true;
  if (keeper.around.number != number) {
    end(0, 0, "the scene changed while the track was looked at");
    return true;
  }
  if (!begun) look_here();
  begun = true;
  if (!done) look_along_part();
  return done;
}

void TrackCheck::Impl::look_here() {
  if (const auto broken = keeper.broken()) end(way.segment, 0, in_words(*broken).view());
}

double TrackCheck::Impl::part_m() const {
  const auto constraints = static_cast<double>(keeper.world.amount().constraints);
  return std::clamp(kConstraintMetres / (constraints + 1), kLeastPart_m, kPart_m);
}

void TrackCheck::Impl::look_along_part() {
  const double ahead_m = part_m();
  const auto line = line_about(path, way, ahead_m);
  if (!line) return end(way.segment, way_m, "the track cannot be followed from here");
  const Sweeper sweeper(keeper.around, body_of(keeper.settings.look, keeper.position_sigma_m(),
                                               keeper.yaw_sigma_rad()));
  const TrackPart part{line->points, line->from_m, ahead_m};
  const auto steps = track_steps(pose, part, keeper.steering(), sweeper.stride_m());
  const WayEnd found = sweeper.sweep(steps);

  std::vector<Pose2> poses;
  for (const Step& step : steps)
    if (step.driven_m <= found.way.free_m) poses.push_back(step.pose);
  if (const auto broken =
          first_offence(keeper.world, keeper.settings.robot, poses, keeper.terms())) {
    const double at_m = steps[broken->index].driven_m;
    return end(line->farther(at_m).segment, way_m + at_m, in_words(broken->verdict).view());
  }
  if (found.way.blocked)
    return end(line->farther(found.way.free_m).segment, way_m + found.way.free_m,
               way_end_words(sweeper, found));
  const double driven_m = steps.back().driven_m;
  done = line->ends && driven_m < ahead_m - kNoWay_m;
  if (!done && driven_m < kNoWay_m)
    return end(way.segment, way_m, "the track leads nowhere from here");
  way = line->farther(driven_m);
  pose = steps.back().pose;
  way_m += driven_m;
}

TrackCheck::TrackCheck(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TrackCheck::~TrackCheck() = default;

bool TrackCheck::advance() {
  return impl_->advance();
}

const std::optional<TrackOffence>& TrackCheck::offence() const {
  return impl_->offence;
}

std::uint64_t TrackCheck::number() const {
  return impl_->number;
}

}  // namespace drover::scene
