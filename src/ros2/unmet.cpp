#include "ros2/unmet.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "ros2/samples.h"
#include "ros2/writer_names.h"

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

constexpr std::int32_t kEndpointsAtOnce = 32;
constexpr std::size_t kMostMatched = 256;
constexpr std::size_t kMostNamed = 3;

/// Of those who are there on the topic of `own`, those who are not met. DDS counts who was ever not
/// met; `others` is its topic that tells of all, `matched` asks whom `own` meets.
template <class Matched>
std::vector<std::string> not_met(dds_entity_t own, dds_entity_t others, const Matched& matched) {
  std::vector<dds_instance_handle_t> met(kMostMatched);
  const auto known = static_cast<std::size_t>(std::max(matched(own, met.data(), met.size()), 0));
  met.resize(std::min(known, kMostMatched));
  std::array<char, 256> topic{};
  std::array<char, 256> type{};
  const dds_entity_t of = dds_get_topic(own);
  (void)dds_get_name(of, topic.data(), topic.size());
  (void)dds_get_type_name(of, type.data(), type.size());
  std::vector<std::string> names;
  const auto look = [&](const void* sample, const dds_sample_info_t& info) {
    const auto& other = *static_cast<const dds_builtintopic_endpoint_t*>(sample);
    if (std::string_view(other.topic_name) == topic.data() &&
        std::string_view(other.type_name) == type.data() &&
        std::find(met.begin(), met.end(), info.instance_handle) == met.end())
      names.push_back(guid_text(other.key));
  };
  // A new one each time: it begins with those who are there.
  const dds_entity_t all = dds_create_reader(dds_get_participant(own), others, nullptr, nullptr);
  while (take_samples<kEndpointsAtOnce>(all, look) == kEndpointsAtOnce) {
  }
  dds_delete(all);
  return names;
}

/// Which of them is the new one DDS does not tell.
std::string in_words(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNamed); ++i)
    text += (text.empty() ? "" : ", ") + names[i];
  if (names.size() > kMostNamed)
    text += " and " + std::to_string(names.size() - kMostNamed) + " others";
  return text.empty() ? "nobody any more" : text;
}

}  // namespace

void add_unmet_readers(dds_entity_t writer, const std::string& topic, std::uint32_t& known,
                       Unmet& unmet) {
  dds_offered_incompatible_qos_status_t refused{};
  if (dds_get_offered_incompatible_qos_status(writer, &refused) != DDS_RETCODE_OK) return;
  if (refused.total_count == 0) return;
  const auto who =
      not_met(writer, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, dds_get_matched_subscriptions);
  unmet.count += static_cast<std::int64_t>(who.size());
  if (refused.total_count > known)
    unmet.news.push_back("a reader of /" + topic + " asks for " +
                         policy_name(refused.last_policy_id) +
                         " that is not offered, and gets nothing: " + in_words(who));
  known = refused.total_count;
}

void add_unmet_writers(dds_entity_t reader, const std::string& topic, std::uint32_t& known,
                       Unmet& unmet) {
  dds_requested_incompatible_qos_status_t refused{};
  if (dds_get_requested_incompatible_qos_status(reader, &refused) != DDS_RETCODE_OK) return;
  if (refused.total_count == 0) return;
  const auto who = not_met(reader, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, dds_get_matched_publications);
  unmet.count += static_cast<std::int64_t>(who.size());
  if (refused.total_count > known)
    unmet.news.push_back("a writer of /" + topic + " offers " +
                         policy_name(refused.last_policy_id) +
                         " that is not asked for, and is not heard: " + in_words(who));
  known = refused.total_count;
}

}  // namespace drover::ros2
