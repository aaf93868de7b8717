#include "ros2/heard.h"

#include <sys/eventfd.h>

#include <array>
#include <string>

#include "ros2/domain.h"
#include "ros2/topics.h"

namespace drover::ros2 {
namespace {

/// What comes between two looks: a stop is not to be pushed out by what follows it.
constexpr std::int32_t kDepth = 100;

/// A thread of DDS' own: it only wakes the loop.
void wake(dds_entity_t, void* came) {
  const std::uint64_t one = 1;
  (void)!::write(*static_cast<const int*>(came), &one, sizeof one);
}

/// Best effort matches both kinds of writers.
dds_entity_t make_reader(dds_entity_t participant, const TopicKind& kind) {
  const dds_entity_t topic = dds_create_topic(participant, kind.type, kind.name, nullptr, nullptr);
  if (topic < 0) return topic;
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_durability(qos, DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, kDepth);
  const std::string hash = hash_user_data(kind.hash);
  dds_qset_userdata(qos, hash.data(), hash.size());
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, nullptr);
  dds_delete_qos(qos);
  return reader;
}

}  // namespace

Heard::Heard(dds_entity_t participant, const config::Ros2InputsConfig& inputs)
    : came_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)), fd_(came_.get()) {
  if (!inputs.e_stop) return;
  stop_ = make_reader(participant, stop_kind());
  if (stop_ < 0) throw NoDomain(std::string("/e_stop cannot be heard: ") + dds_strretcode(stop_));
  dds_listener_t* listener = dds_create_listener(&fd_);
  dds_lset_data_available(listener, wake);
  dds_set_listener(stop_, listener);
  dds_delete_listener(listener);
  wake(stop_, &fd_);  // what came before
}

Heard::~Heard() {
  if (stop_ > 0) dds_delete(stop_);  // waits for its listener
}

bool Heard::stop_asked() {
  std::uint64_t count = 0;
  (void)!::read(came_.get(), &count, sizeof count);
  if (stop_ == 0) return false;
  bool asked = false;
  std::array<void*, kDepth> samples{};
  std::array<dds_sample_info_t, kDepth> infos{};
  const auto taken = dds_take(stop_, samples.data(), infos.data(), kDepth, kDepth);
  for (std::int32_t i = 0; i < taken; ++i) {
    const auto* sample = static_cast<const std_msgs_msg_dds__Bool_*>(samples[i]);
    asked = asked || (infos[i].valid_data && sample->data_);
  }
  if (taken > 0) dds_return_loan(stop_, samples.data(), taken);
  return asked;
}

}  // namespace drover::ros2
