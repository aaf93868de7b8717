// What ROS 2 users may tell the robot: readers of the topics that the configuration opens.
#pragma once

#include <dds/dds.h>

#include <atomic>
#include <vector>

#include "config/config.h"
#include "link/unique_fd.h"
#include "ros2/arrivals.h"
#include "ros2/cmd_vel.h"
#include "ros2/domain.h"
#include "ros2/joint_command_input.h"
#include "ros2/scene_input.h"
#include "ros2/stop_copies.h"
#include "ros2/topics.h"
#include "ros2/unmet.h"

namespace drover::ros2 {

class Heard final {
 public:
  /// Readers are the last that a domain gets: by then its sockets are closed. `scene_lost` is told
  /// of each message of the planning scene that is never looked at. Throws NoDomain.
  Heard(dds_entity_t participant, const config::DroverConfig& config, Reach reach,
        std::atomic<std::uint64_t>& scene_lost);
  ~Heard();
  Heard(const Heard&) = delete;
  Heard& operator=(const Heard&) = delete;

  /// Readable when something came.
  int fd() const { return came_.get(); }
  /// Takes all that came: whether one of it asks for an emergency stop. Throws NoDomain when DDS
  /// does not give it: nothing would tell of what comes then.
  bool stop_asked();
  /// Writers whose quality of service is another one.
  void add_unmet(Unmet& unmet);
  /// What is wanted of the base, if that is opened. `wall`: UTC now, since 1970. Throws NoDomain.
  TwistsHeard twists(Time now, Duration wall);
  /// Lines of joint commands for droverd, likewise.
  void joint_commands(Time now, Duration wall, const std::function<void(const std::string&)>& send);
  /// Lines of the planning scene, likewise.
  void scene_messages(Time now, Duration wall, const std::function<void(std::string)>& give);

 private:
  /// For a listener that keeps when something came.
  struct TimedWake {
    int fd = -1;
    Arrivals arrivals;
  };
  static void wake_timed(dds_entity_t reader, void* timed);
  bool take_stops(dds_entity_t reader, StopReader which, bool& asked);
  void close();
  /// Best effort matches both kinds of writers; of reliable ones nothing is lost.
  dds_entity_t open(dds_entity_t participant, const TopicKind& kind, std::int32_t depth,
                    dds_reliability_kind_t reliability = DDS_RELIABILITY_BEST_EFFORT,
                    TimedWake* timed = nullptr);
  /// Only reliable ones: an object that is lost is not seen, and nobody says it again.
  void open_scene(dds_entity_t participant, const TopicKind& kind, SceneInput& input);
  /// `came` is told when something came, in a thread of DDS' own.
  dds_entity_t add(dds_entity_t reader, const TopicKind& kind, dds_on_data_available_fn came,
                   void* of);

  struct Reader {
    dds_entity_t entity = 0;
    const TopicKind* kind = nullptr;
    std::uint32_t unmet = 0;  ///< writers that were not met, as told last
  };

  link::UniqueFd came_;
  int fd_ = -1;            ///< its number, for the listener
  dds_entity_t stop_ = 0;  ///< 0: not opened
  /// Once more: it asks a reliable writer again for what found no room while this program hung.
  dds_entity_t sure_stop_ = 0;
  StopCopies stop_copies_;
  TimedWake twist_wake_;
  TimedWake joint_wake_;
  std::vector<Reader> readers_;  ///< all of them
  std::optional<CmdVel> cmd_vel_;
  std::optional<JointCommandInput> joint_commands_;
  std::optional<SceneInput> scene_objects_;
  std::optional<SceneInput> scene_constraints_;
};

}  // namespace drover::ros2
