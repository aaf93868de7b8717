#include "ros2/shown.h"

#include "ros2/domain.h"

namespace drover::ros2 {
namespace {

void put_history(dds_qos_t* qos, Kept kept) {
  constexpr std::int32_t kFew = 5;
  constexpr std::int32_t kHundred = 100;
  const std::int32_t depth = kept == Kept::few ? kFew : kept == Kept::hundred ? kHundred : 1;
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, depth);
  dds_qset_durability(
      qos, kept == Kept::for_later ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  if (kept == Kept::for_later)
    dds_qset_durability_service(qos, 0, DDS_HISTORY_KEEP_LAST, depth, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
}

/// As ROS 2 asks of its own publishers.
dds_qos_t* qos_of(const TopicKind& kind) {
  dds_qos_t* qos = dds_create_qos();
  // Both kinds of readers match. Nobody is waited for.
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, 0);
  put_history(qos, kind.kept);
  dds_qset_writer_data_lifecycle(qos, false);
  const std::string hash = hash_user_data(kind.hash);
  dds_qset_userdata(qos, hash.data(), hash.size());
  return qos;
}

}  // namespace

Shown::Shown(dds_entity_t participant, const Robot& robot, Stamp_ns at_ns)
    : participant_(participant), robot_(robot) {
  for (std::size_t i = 0; i < kTopicCount; ++i)
    writers_[i] = make(topic_kinds()[i], topic_kinds()[i].name);
  const auto& kind = topic_kinds()[static_cast<std::size_t>(Topic::scan)];
  for (std::size_t i = 1; i < robot_.scanners.size(); ++i) {
    const std::string& name = robot_.scanners[i].frame.name;
    const auto& topic = names_[name] = "rt/" + name + "/scan";
    more_scans_[name] = make(kind, topic);
    more_scans_[name].topic = topic.c_str();
  }
  send(writer(Topic::tf_static), fixed_frames(at_ns, robot_.frames, arena_));
}

Shown::Writer Shown::make(const TopicKind& kind, const std::string& name) {
  dds_qos_t* qos = qos_of(kind);
  const dds_entity_t topic =
      dds_create_topic(participant_, kind.type, name.c_str(), nullptr, nullptr);
  const dds_entity_t entity =
      topic < 0 ? topic : dds_create_writer(participant_, topic, qos, nullptr);
  dds_delete_qos(qos);
  if (entity < 0)
    throw NoDomain("the topic " + name + " cannot be written: " + dds_strretcode(entity));
  return {kind.name, entity, 0};
}

template <class Message>
void Shown::send(const Writer& writer, const Message& message) {
  if (dds_write(writer.entity, &message) != DDS_RETCODE_OK) ++failed_;
  arena_.clear();
}

void Shown::show(const Told& told) {
  if (told.joints) {
    send(writer(Topic::joint_states), joint_state(*told.joints, arena_));
    send(writer(Topic::joint_state), joint_state_array(*told.joints, ++joint_sequence_, arena_));
  }
  if (told.imu) send(writer(Topic::imu), imu(*told.imu, arena_));
  if (told.fix) send(writer(Topic::fix), nav_sat_fix(*told.fix, arena_));
  if (told.odometry) {
    send(writer(Topic::tf), frames(*told.odometry, told.pose, arena_));
    send(writer(Topic::odom), odometry(*told.odometry, arena_));
    if (told.pose)
      send(writer(Topic::rtk_pose), rtk_pose(told.odometry->at_ns, *told.pose, arena_));
  }
  if (told.battery) send(writer(Topic::battery_state), battery_state(*told.battery, arena_));
  if (told.touch)
    send(writer(Topic::touch_state), touch_state(*told.touch, ++touch_sequence_, arena_));
  for (const ScanTold& scan : told.scans) show_scan(scan);
}

void Shown::show_scan(const ScanTold& scan) {
  for (const ScannerFrame& scanner : robot_.scanners) {
    if (scanner.frame.name != scan.name) continue;
    const auto more = more_scans_.find(scan.name);
    send(more == more_scans_.end() ? writer(Topic::scan) : more->second,
         laser_scan(scan, scanner.limits, scanner.angles, arena_));
  }
}

void Shown::show_diagnostics(Stamp_ns at_ns, std::span<const DiagnosticTold> told) {
  send(writer(Topic::diagnostics), diagnostics(at_ns, robot_.name, told, arena_));
}

void Shown::count(Writer& writer, Readers& readers) {
  dds_publication_matched_status_t matched{};
  if (dds_get_publication_matched_status(writer.entity, &matched) == DDS_RETCODE_OK)
    readers.matched += matched.current_count;
  add_unmet_readers(writer.entity, writer.topic + 3, writer.unmet, readers.unmet);
}

Readers Shown::readers() {
  Readers readers;
  for (Writer& writer : writers_) count(writer, readers);
  for (auto& [name, writer] : more_scans_) count(writer, readers);
  return readers;
}

}  // namespace drover::ros2
