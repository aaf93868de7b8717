#include <algorithm>
#include <utility>

#include "scene/keeper/track_check_impl.h"
#include "scene/keeper/track_start.h"
#include "scene/world/words.h"
#include "track/flaw.h"

namespace drover::scene {
namespace {

constexpr double kPart_m = 20;  // some hundred poses
constexpr double kNoWay_m = 1e-6;

std::string way_end_words(const Sweeper& sweeper, const WayEnd& end) {
  return sweeper.name(end) + (end.way.at_start && end.way.free_m == 0
                                  ? " is where the robot is, or within its margin"
                                  : " is in the way");
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
  if (Reason problem = track::check_path(path, target); !problem.empty()) return problem;
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

bool TrackCheck::Impl::advance(const TimeLeft& time_left) {
  if (done) return true;
  if (keeper.around.number != number) {
    end(0, 0, "the scene changed while the track was looked at");
    return true;
  }
  if (!begun) look_here();
  begun = true;
  while (!done) {
    if (!part) begin_part();
    if (done) break;
    if (!part->judge.advance(time_left)) break;
    end_part();
    if (!time_left()) break;
  }
  return done;
}

void TrackCheck::Impl::look_here() {
  if (const auto broken = keeper.broken()) end(way.segment, 0, with_way_out(*broken).view());
}

Sweeper TrackCheck::Impl::sweeper() const {
  return {keeper.around,
          body_of(keeper.settings.look, keeper.position_sigma_m(), keeper.yaw_sigma_rad())};
}

void TrackCheck::Impl::begin_part() {
  auto line = line_about(path, way, kPart_m);
  if (!line) return end(way.segment, way_m, "the track cannot be followed from here");
  const Sweeper sweeper = this->sweeper();
  const TrackPart ahead{line->points, line->from_m, kPart_m, line->backwards};
  auto steps = track_steps(pose, ahead, keeper.steering(), sweeper.stride_m());
  const WayEnd found = sweeper.sweep(steps);
  std::vector<Pose2> poses;
  for (const Step& step : steps)
    if (step.driven_m <= found.way.free_m) poses.push_back(step.pose);
  TrackJudge judge(keeper.world, keeper.settings.robot, std::move(poses), keeper.terms());
  part.emplace(Part{std::move(*line), std::move(steps), found, std::move(judge)});
}

void TrackCheck::Impl::end_part() {
  const Part over = std::move(*part);
  part.reset();
  const WayLine& line = over.line;
  const FreeWay& free = over.found.way;
  if (const auto& broken = over.judge.offence()) {
    const double at_m = over.steps[broken->index].driven_m;
    return end(line.farther(at_m).segment, way_m + at_m, in_words(broken->verdict).view());
  }
  if (free.blocked)
    return end(line.farther(free.free_m).segment, way_m + free.free_m,
               way_end_words(sweeper(), over.found));
  const double driven_m = over.steps.back().driven_m;
  done = line.ends && driven_m < kPart_m - kNoWay_m;
  if (!done && driven_m < kNoWay_m)
    return end(way.segment, way_m, "the track leads nowhere from here");
  way = line.farther(driven_m);
  pose = over.steps.back().pose;
  way_m += driven_m;
}

TrackCheck::TrackCheck(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TrackCheck::~TrackCheck() = default;

bool TrackCheck::advance(const TimeLeft& time_left) {
  return impl_->advance(time_left);
}

const std::optional<TrackOffence>& TrackCheck::offence() const {
  return impl_->offence;
}

std::uint64_t TrackCheck::number() const {
  return impl_->number;
}

}  // namespace drover::scene
