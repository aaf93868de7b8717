#include "ros2/heard.h"

#include <sys/eventfd.h>

#include <string>

#include "ros2/domain.h"
#include "ros2/samples.h"
#include "ros2/topics.h"
#include "runtime/clock.h"

namespace drover::ros2 {
namespace {

/// What comes between two looks: a stop is not to be pushed out by what follows it.
constexpr std::int32_t kDepth = 100;
/// Of twists the newest counts; more show that two programs write.
constexpr std::int32_t kTwists = 20;
/// Of joint commands each counts: two programs may write 200 a second for groups of their own.
constexpr std::int32_t kJointCommands = 50;
/// Of the planning scene what comes before its listener is there: that one leaves nothing.
constexpr std::int32_t kSceneMessages = 50;

/// A thread of DDS' own: it only wakes the loop.
void wake(dds_entity_t, void* came) {
  const std::uint64_t one = 1;
  (void)!::write(*static_cast<const int*>(came), &one, sizeof one);
}

/// Of what comes on /e_stop only this is kept: nothing that follows a stop can push it out.
bool is_stop(const void* sample, void*) {
  return static_cast<const std_msgs_msg_dds__Bool_*>(sample)->data_;
}

dds_entity_t make_reader(dds_entity_t participant, const TopicKind& kind, std::int32_t depth,
                         dds_reliability_kind_t reliability) {
  // Each reader has a topic entity of its own, and so a filter.
  const dds_entity_t topic = dds_create_topic(participant, kind.type, kind.name, nullptr, nullptr);
  if (topic < 0) return topic;
  if (&kind == &stop_kind())
    if (const auto set = dds_set_topic_filter_and_arg(topic, is_stop, nullptr); set < 0) return set;
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, reliability, 0);
  dds_qset_durability(qos, DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, depth);
  const std::string hash = hash_user_data(kind.hash);
  dds_qset_userdata(qos, hash.data(), hash.size());
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, nullptr);
  dds_delete_qos(qos);
  return reader;
}

JointCommandLimits limits_of(const config::DroverConfig& config) {
  JointCommandLimits limits;
  limits.oldest = from_s(1e-3 * config.aimrt.max_command_age_ms);
  limits.joints = config.engine.joints.size();
  limits.messages_Hz *= static_cast<double>(1 + config.engine.groups.size());
  return limits;
}

}  // namespace

/// Likewise a thread of DDS' own.
void Heard::wake_timed(dds_entity_t reader, void* timed) {
  auto& wakes = *static_cast<TimedWake*>(timed);
  wakes.arrivals.came(runtime::monotonic_now());
  wake(reader, &wakes.fd);
}

dds_entity_t Heard::add(dds_entity_t reader, const TopicKind& kind, dds_on_data_available_fn came,
                        void* of) {
  if (reader < 0)
    throw NoDomain(std::string(kind.name + 2) + " cannot be heard: " + dds_strretcode(reader));
  readers_.push_back({reader, &kind});
  dds_listener_t* listener = dds_create_listener(of);
  dds_lset_data_available(listener, came);
  dds_set_listener(reader, listener);
  dds_delete_listener(listener);
  came(reader, of);  // what came before
  return reader;
}

dds_entity_t Heard::open(dds_entity_t participant, const TopicKind& kind, std::int32_t depth,
                         dds_reliability_kind_t reliability, TimedWake* timed) {
  const dds_entity_t reader = make_reader(participant, kind, depth, reliability);
  if (timed == nullptr) return add(reader, kind, wake, &fd_);
  timed->fd = fd_;
  return add(reader, kind, wake_timed, timed);
}

void Heard::open_scene(dds_entity_t participant, const TopicKind& kind, SceneInput& input) {
  const auto came = [](dds_entity_t reader, void* of) {
    static_cast<SceneInput*>(of)->came(reader);
  };
  add(make_reader(participant, kind, kSceneMessages, DDS_RELIABILITY_RELIABLE), kind, came, &input);
}

Heard::Heard(dds_entity_t participant, const config::DroverConfig& config, Reach reach,
             std::atomic<std::uint64_t>& scene_lost)
    : came_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)), fd_(came_.get()) {
  const auto& inputs = config.ros2.inputs;
  const bool one_clock = reach == Reach::localhost;
  try {
    if (inputs.e_stop) {
      stop_ = open(participant, stop_kind(), kDepth);
      sure_stop_ = open(participant, stop_kind(), kDepth, DDS_RELIABILITY_RELIABLE);
    }
    if (inputs.cmd_vel != "closed") {
      const bool stamped = inputs.cmd_vel == "twist_stamped";
      cmd_vel_.emplace(open(participant, cmd_vel_kind(stamped), kTwists,
                            DDS_RELIABILITY_BEST_EFFORT, &twist_wake_),
                       stamped, one_clock);
    }
    if (inputs.joint_command)
      joint_commands_.emplace(open(participant, joint_command_kind(), kJointCommands,
                                   DDS_RELIABILITY_BEST_EFFORT, &joint_wake_),
                              limits_of(config), one_clock);
    const auto wake_up = [this] { wake(0, &fd_); };
    using Kind = SceneInput::Kind;
    if (inputs.collision_object)
      open_scene(participant, collision_object_kind(),
                 scene_objects_.emplace(Kind::objects, one_clock, scene_lost, wake_up));
    if (inputs.planning_constraints)
      open_scene(participant, planning_constraints_kind(),
                 scene_constraints_.emplace(Kind::constraints, one_clock, scene_lost, wake_up));
  } catch (...) {
    close();
    throw;
  }
}

Heard::~Heard() {
  close();
}

/// Waits for the listeners, which write to a descriptor of this object.
void Heard::close() {
  for (const Reader& reader : readers_) dds_delete(reader.entity);
}

TwistsHeard Heard::twists(Time now, Duration wall) {
  if (!cmd_vel_) return {};
  auto heard = cmd_vel_->take(now, wall, twist_wake_.arrivals.look(now).newest);
  if (heard.failed) throw NoDomain("/cmd_vel cannot be read");
  return heard;
}

void Heard::add_unmet(Unmet& unmet) {
  for (Reader& reader : readers_)
    if (reader.entity != sure_stop_)  // whom that one does not meet the other one does
      add_unmet_writers(reader.entity, reader.kind->name + 3, reader.unmet, unmet);
}

void Heard::joint_commands(Time now, Duration wall,
                           const std::function<void(const std::string&)>& send) {
  if (!joint_commands_) return;
  const Time came = joint_wake_.arrivals.look(now).oldest;
  if (!joint_commands_->take(now, wall, came, send))
    throw NoDomain("/joint_command cannot be read");
}

void Heard::scene_messages(Time now, Duration wall, const std::function<void(std::string)>& give) {
  for (auto* input : {&scene_objects_, &scene_constraints_}) {
    if (!*input) continue;
    const auto taken = (*input)->take(now, wall, give);
    if (taken == SceneInput::Taken::failed)
      throw NoDomain("the planning scene's messages cannot be read");
    if (taken == SceneInput::Taken::some) wake(0, &fd_);  // after a look for stops
  }
}

/// Takes all that came; false: DDS does not give it.
bool Heard::take_stops(dds_entity_t reader, StopReader which, bool& asked) {
  if (reader <= 0) return true;
  const Time now = runtime::monotonic_now();
  const auto look = [&](const void* sample, const dds_sample_info_t& info) {
    if (!is_stop(sample, nullptr)) return;
    const StopSample said{info.publication_handle, info.source_timestamp};
    asked = stop_copies_.is_stop(which, said, now) || asked;
  };
  return take_samples<kDepth>(reader, look) >= 0;
}

bool Heard::stop_asked() {
  std::uint64_t count = 0;
  (void)!::read(came_.get(), &count, sizeof count);
  bool asked = false;
  const bool one = take_stops(stop_, StopReader::any, asked);
  const bool other = take_stops(sure_stop_, StopReader::sure, asked);
  // What one of them heard is not lost because the other one failed, which fails again.
  if (asked) return true;
  if (!one || !other) throw NoDomain("/e_stop cannot be read");
  return false;
}

}  // namespace drover::ros2
