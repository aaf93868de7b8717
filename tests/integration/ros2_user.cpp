#include "integration/ros2_user.h"

#include <gtest/gtest.h>

namespace drover::test {

std::string settings_of(User user) {
  if (user == User::defaults) return "<CycloneDDS><Domain id=\"any\"/></CycloneDDS>";
  std::string text = "<CycloneDDS><Domain id=\"any\"><General>";
  if (user == User::humble)
    text += "<Interfaces><NetworkInterface address=\"127.0.0.1\"/></Interfaces>";
  return text +
         "<AllowMulticast>false</AllowMulticast></General><Discovery>"
         "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32"
         "</MaxAutoParticipantIndex><Peers><Peer address=\"localhost\"/></Peers></Discovery>"
         "</Domain></CycloneDDS>";
}

dds_entity_t make_writer(dds_entity_t participant, const ros2::TopicKind& kind,
                         dds_reliability_kind_t reliability) {
  const dds_entity_t topic = dds_create_topic(participant, kind.type, kind.name, nullptr, nullptr);
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, reliability, 0);
  const dds_entity_t writer = dds_create_writer(participant, topic, qos, nullptr);
  dds_delete_qos(qos);
  EXPECT_GT(writer, 0);
  return writer;
}

dds_entity_t make_reader(dds_entity_t participant, const ros2::TopicKind& kind,
                         dds_reliability_kind_t reliability, dds_durability_kind_t durability) {
  const dds_entity_t topic = dds_create_topic(participant, kind.type, kind.name, nullptr, nullptr);
  EXPECT_GT(topic, 0);
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, reliability, 0);
  dds_qset_durability(qos, durability);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 10);
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, nullptr);
  dds_delete_qos(qos);
  EXPECT_GT(reader, 0);
  return reader;
}

}  // namespace drover::test
