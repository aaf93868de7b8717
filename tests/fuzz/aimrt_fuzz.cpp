// Any bytes as a packet on the joint command topics, and as the JSON in one: no crash, one command
// or one refusal, and what reaches the engine is finite and of this robot.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "publish/aimrt/channel.h"
#include "publish/aimrt/packet.h"

namespace {

using namespace drover;
using namespace drover::publish;

void require(bool holds) {
  if (!holds) std::abort();
}

void check_packet(std::string_view payload) {
  const auto packet = aimrt::decode_packet(payload);
  if (!packet) return;
  // One length byte and one number of pairs are all that is not given back.
  require(packet->content_type.size() + packet->context.size() + packet->message.size() + 2 ==
          payload.size());
  require(payload.ends_with(packet->message));
}

void check_targets(const JointTargets& targets, std::size_t joints) {
  require(!targets.joints.empty() && targets.joints.size() <= joints);
  std::array<bool, kMaxAxes> named{};
  for (const JointTarget& target : targets.joints) {
    require(target.axis < joints && !named[target.axis]);
    named[target.axis] = true;
    require(std::isfinite(target.velocity_radps) && std::abs(target.velocity_radps) <= 1e5);
  }
}

/// The whole way: one command or one refusal in words, and the same for both families' names.
void check_way(aimrt::Names names, std::string_view payload) {
  aimrt::JointCommandsConfig config;
  config.rules.joints = {"left", "right"};
  aimrt::JointCommands commands(config);
  aimrt::Channel channel({}, commands);
  // The corpus' stamps are about one second after the epoch.
  const Time now{from_s(1)};
  Actions actions;
  channel.on_command(names, payload, {}, now, Duration(0), actions);
  int given = 0;
  for (const Action& action : actions) {
    const auto* command = std::get_if<Command>(&action);
    if (command == nullptr) continue;
    ++given;
    if (const auto* refused = std::get_if<JointTargetsRefused>(&command->body)) {
      require(!refused->reason.empty());
      for (const char c : refused->reason.view()) require(static_cast<unsigned char>(c) >= 0x20);
    } else {
      require(std::holds_alternative<JointTargets>(command->body));
      check_targets(std::get<JointTargets>(command->body), config.rules.joints.size());
      Actions later;
      channel.on_command(names, payload, {.retain = Retain::stored}, now, Duration(0), later);
      require(std::holds_alternative<JointTargetsRefused>(std::get<Command>(later.back()).body));
    }
  }
  require(given == 1);
}

void check_json(std::string_view text) {
  const auto message = aimrt::decode_joint_command_json(text);
  if (message) return;
  require(!message.error().empty());
  for (const char c : message.error().view()) require(static_cast<unsigned char>(c) >= 0x20);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view payload(reinterpret_cast<const char*>(data), size);
  check_packet(payload);
  check_json(payload);
  const std::string in_json = aimrt::encode_packet(payload, aimrt::Content::json);
  for (const auto names : {aimrt::Names::document, aimrt::Names::aimrt_1x})
    for (const std::string_view packet : {payload, std::string_view(in_json)})
      check_way(names, packet);
  return 0;
}
