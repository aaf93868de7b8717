// The planning scene as an outlet: its topics, its requests by the daemon's socket, and what of it
// goes to the disk. README.md of publish/scene tells both forms.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "publish/outlet.h"
#include "publish/scene_requests.h"
#include "publish/scene_saver.h"
#include "publish/scene_topics.h"

namespace drover::publish {

class SceneOutlet final : public Outlet {
 public:
  /// `configured`: the robot has a scene; else everything is refused in words. `stored`: its texts
  /// on the disk.
  SceneOutlet(bool configured, const store::StoredScene& stored,
              std::function<RobotNow(Time)> robot, const SceneTopicLimits& limits = {});

  Duration period() const override { return std::chrono::milliseconds(100); }
  bool needs_broker() const override { return false; }
  std::vector<WantedTopic> wants() const override;
  std::vector<OutMessage> on_snapshot(const Snapshot& seen, const Moment& moment,
                                      Actions& out) override;
  bool on_message(std::string_view topic, std::string_view payload, const Arrival& arrival,
                  Time now, Actions& out) override;
  bool on_line(ClientId client, std::string_view line, Time now, Actions& out) override;
  std::string_view trouble(Time now) const override;
  void count(DaemonStatus& status) const override;

  /// Of drover-ros2, as SceneTopics.
  SceneTopics& topics() { return topics_; }

  // What the others answer.
  void on_reply(SceneReply reply, Time now, Actions& out);
  void on_text(SceneTextReply reply, Time now, Actions& out);
  /// Of a StorageJob for the scene.
  void on_stored(const store::StorageReply& reply, Time now, Actions& out);
  /// No room for a job at the scene's parser, or at the scene.
  void on_unparsed(std::uint64_t number, Actions& out);
  void on_unasked(const SceneJob& job, Actions& out);

 private:
  void save(Time now, Actions& out);
  void restored(SceneRestored restored, Actions& out);
  void tell_trouble();

  JobNumbers numbers_;
  SceneSaver saver_;
  SceneTopics topics_;
  SceneRequests requests_;
  std::uint64_t save_number_ = 0;  ///< of the job that runs
  std::string trouble_;
};

}  // namespace drover::publish
