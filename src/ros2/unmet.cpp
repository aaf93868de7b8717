#include "ros2/unmet.h"

namespace drover::ros2 {
namespace {

std::string policy_name(std::uint32_t id) {
  switch (id) {
    case DDS_DURABILITY_QOS_POLICY_ID: return "a durability";
    case DDS_RELIABILITY_QOS_POLICY_ID: return "a reliability";
    case DDS_DEADLINE_QOS_POLICY_ID: return "a deadline";
    case DDS_LIVELINESS_QOS_POLICY_ID: return "a liveliness";
    case DDS_OWNERSHIP_QOS_POLICY_ID: return "an ownership";
    case DDS_DESTINATIONORDER_QOS_POLICY_ID: return "a destination order";
    case DDS_PRESENTATION_QOS_POLICY_ID: return "a presentation";
    case DDS_LATENCYBUDGET_QOS_POLICY_ID: return "a latency budget";
    case DDS_DATA_REPRESENTATION_QOS_POLICY_ID: return "a data representation";
    default: return "a policy " + std::to_string(id);
  }
}

}  // namespace

void add_unmet_readers(dds_entity_t writer, const std::string& topic, std::uint32_t& known,
                       Unmet& unmet) {
  dds_offered_incompatible_qos_status_t refused{};
  if (dds_get_offered_incompatible_qos_status(writer, &refused) != DDS_RETCODE_OK) return;
  unmet.count += refused.total_count;
  if (refused.total_count > known)
    unmet.news.push_back("a reader of /" + topic + " asks for " +
                         policy_name(refused.last_policy_id) +
                         " that is not offered, and gets nothing");
  known = refused.total_count;
}

void add_unmet_writers(dds_entity_t reader, const std::string& topic, std::uint32_t& known,
                       Unmet& unmet) {
  dds_requested_incompatible_qos_status_t refused{};
  if (dds_get_requested_incompatible_qos_status(reader, &refused) != DDS_RETCODE_OK) return;
  unmet.count += refused.total_count;
  if (refused.total_count > known)
    unmet.news.push_back("a writer of /" + topic + " offers " +
                         policy_name(refused.last_policy_id) +
                         " that is not asked for, and is not heard");
  known = refused.total_count;
}

}  // namespace drover::ros2
