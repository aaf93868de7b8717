#include "publish/scene_outlet.h"

#include <utility>

namespace drover::publish {

SceneOutlet::SceneOutlet(bool configured, const store::StoredScene& stored,
                         std::function<RobotNow(Time)> robot, const SceneTopicLimits& limits)
    : saver_(stored),
      topics_(configured, numbers_, saver_, limits),
      requests_(configured, numbers_, saver_, std::move(robot)) {}

std::vector<WantedTopic> SceneOutlet::wants() const {
  return {{std::string(kTopicCollisionObject), 1}, {std::string(kTopicPlanningConstraints), 1}};
}

std::vector<OutMessage> SceneOutlet::on_snapshot(const Snapshot&, const Moment& moment,
                                                 Actions& out) {
  topics_.on_time(moment.now, out);
  requests_.on_time(out);
  save(moment.now, out);
  return {};
}

bool SceneOutlet::on_message(std::string_view topic, std::string_view payload,
                             const Arrival& arrival, Time now, Actions& out) {
  return topics_.on_message(topic, payload, arrival, now, out);
}

bool SceneOutlet::on_line(ClientId client, std::string_view line, Time now, Actions& out) {
  return requests_.on_line(client, line, now, out);
}

void SceneOutlet::on_reply(SceneReply reply, Time now, Actions& out) {
  if (const auto* applied = std::get_if<MessagesApplied>(&reply.what)) {
    topics_.on_applied(reply.number, *applied, now, out);
  } else if (auto* at_start = std::get_if<SceneRestored>(&reply.what)) {
    restored(std::move(*at_start), out);
  } else {
    (void)requests_.on_reply(reply, now, out);
  }
  save(now, out);
  tell_trouble();
}

void SceneOutlet::restored(SceneRestored restored, Actions& out) {
  saver_.set_lost(restored.lost);
  requests_.on_restored(std::move(restored));
  if (const auto problem = requests_.problem(); !problem.empty())
    out.emplace_back(LogLine{Notice::Level::error, problem + ": the robot does not move"});
}

void SceneOutlet::on_text(SceneTextReply reply, Time now, Actions& out) {
  if (!requests_.on_text(reply, now, out)) topics_.on_parsed(reply, now, out);
}

void SceneOutlet::on_unparsed(std::uint64_t number, Actions& out) {
  if (!requests_.on_unparsed(number, out)) topics_.on_unparsed(number, out);
}

void SceneOutlet::on_unasked(const SceneJob& job, Actions& out) {
  if (!requests_.on_unasked(job, out)) topics_.on_unapplied(job.number, out);
}

/// When something has changed and no save runs.
void SceneOutlet::save(Time now, Actions& out) {
  auto job = saver_.next(now);
  if (!job) return;
  save_number_ = numbers_.next();
  out.emplace_back(store::StorageJob{{RequestId::Source::internal, save_number_}, std::move(*job)});
}

void SceneOutlet::on_stored(const store::StorageReply& reply, Time now, Actions& out) {
  if (reply.id.number == save_number_) {
    const std::string failure = reply.ok ? "" : reply.reason;
    if (saver_.failure() != failure)
      out.emplace_back(LogLine{
          failure.empty() ? Notice::Level::info : Notice::Level::error,
          failure.empty() ? "the scene is stored again" : "the scene is not stored: " + failure});
    const auto save = saver_.on_saved(failure, now);
    topics_.on_saved(save, failure, out);
    requests_.on_saved(save, failure, out);
  } else {
    (void)requests_.on_stored(reply, out);
  }
  this->save(now, out);
  tell_trouble();
}

void SceneOutlet::tell_trouble() {
  trouble_ = requests_.problem();
  if (trouble_.empty() && !saver_.failure().empty())
    trouble_ = "the scene is not stored: " + saver_.failure();
}

std::string_view SceneOutlet::trouble(Time) const {
  return trouble_;
}

void SceneOutlet::count(DaemonStatus& status) const {
  status.scene_messages_unanswered = topics_.unanswered();
  const SceneCounts& of_ros2 = topics_.of_ros2();
  status.ros2.scene_done = of_ros2.done;
  status.ros2.scene_refused = of_ros2.refused;
  status.ros2.scene_unanswered = of_ros2.unanswered;
  status.ros2.scene_refusal = of_ros2.refusal;
}

}  // namespace drover::publish
