// The publish thread and the scene's: messages, requests, and starts whose track is looked at
// first.
#include <cmath>

#include "publish/not_while.h"
#include "runtime/clock.h"
#include "runtime/publish_loop.h"
#include "scene/world/map_change.h"

namespace drover::runtime {

namespace {
/// Until the snapshot tells of a task, or a search for the heading, that was delivered.
constexpr Duration kStartShows = std::chrono::milliseconds(500);
}  // namespace

void PublishLoop::give(publish::SceneJob job, publish::Actions& actions) {
  if (scene_ && scene_->exchange.jobs.push(std::move(job))) return;
  // NOLINTNEXTLINE(bugprone-use-after-move): a full ring leaves it
  scene_outlet_->on_unasked(job, actions);
}

void PublishLoop::give(publish::SceneTextJob job, publish::Actions& actions) {
  const auto number = job.number;
  if (!scene_ || !scene_->parser.give(std::move(job))) scene_outlet_->on_unparsed(number, actions);
}

void PublishLoop::take_scene(Time now) {
  publish::SceneReply reply;
  while (scene_->exchange.replies.pop(reply)) {
    if (const auto* found = std::get_if<publish::TrackChecked>(&reply.what)) {
      checked(reply.number, *found);
    } else {
      scene_outlet_->on_reply(std::move(reply), now, actions_);
    }
    carry_out(actions_);
  }
}

void PublishLoop::take_scene_texts(Time now) {
  publish::SceneTextReply reply;
  while (scene_->parser.take(reply)) {
    scene_outlet_->on_text(std::move(reply), now, actions_);
    carry_out(actions_);
  }
}

publish::RobotNow PublishLoop::robot_now(Time now) {
  const Snapshot& snapshot = control_.snapshot.latest();
  publish::RobotNow robot;
  robot.place.origin = service_.origin();
  if (snapshot.origin_set && std::isfinite(snapshot.pose.position_sigma_m))
    robot.place.in_map = {snapshot.pose.x_m, snapshot.pose.y_m};
  robot.busy = publish::not_while(snapshot.nav.owner, snapshot.nav.status == NavStatus::run);
  const bool begins = starts_.any() || (last_start_ != kNever && now - last_start_ < kStartShows);
  if (robot.busy.empty() && begins) robot.busy = publish::kNotWhileItBegins;
  robot.wall_s = to_s(now.time_since_epoch() + wall_minus_monotonic_);
  return robot;
}

/// Goes on when the scene has answered. The path is the service's until the engine has it: the
/// scene gets a copy.
void PublishLoop::check_start(const Command& command, const StopCounts& before, Time now,
                              publish::Actions& actions) {
  const auto& start = std::get<StartTask>(command.body);
  publish::CheckTrack check{std::make_shared<const Path>(*start.path), start.target};
  const auto number =
      starts_.add({command, before, service_.origin().value_or(GeodeticPoint{}), now});
  if (scene_->exchange.jobs.push(publish::SceneJob{number, std::move(check)})) return;
  (void)starts_.take(number);
  service_.on_undelivered(command, actions, "the scene is behind with earlier messages, try again");
}

void PublishLoop::checked(std::uint64_t number, const publish::TrackChecked& found) {
  const auto start = starts_.take(number);
  if (!start) return;
  if (found.offence)
    return service_.on_undelivered(
        start->command, actions_,
        offence_text(*found.offence, config_.protocol.first_target_id == 0 ? 0 : 1));
  // Its path would lie elsewhere on earth by now.
  if (service_.origin_pending() || !service_.origin() ||
      !scene::same_origin(*service_.origin(), start->origin))
    return service_.on_undelivered(start->command, actions_, "the origin is being set, try again");
  push(start->command, start->before, actions_);
}

void PublishLoop::refuse_late_starts(Time now) {
  while (const auto start = starts_.take_late(now))
    service_.on_undelivered(start->command, actions_,
                            "its track could not be looked along within 10 s, try again");
}

}  // namespace drover::runtime
