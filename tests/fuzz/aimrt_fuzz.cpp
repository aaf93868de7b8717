// Any bytes as a packet on the joint command topic: no crash, one command or one refusal, and what
// reaches the engine is finite and of this robot.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view payload(reinterpret_cast<const char*>(data), size);
  check_packet(payload);
  aimrt::ChannelConfig config;
  config.rules.joints = {"left", "right"};
  aimrt::Channel channel(config);
  // The corpus' stamps are about one second after the epoch.
  const Time now{from_s(1)};
  Actions actions;
  channel.on_command(payload, {}, now, Duration(0), actions);
  int commands = 0;
  for (const Action& action : actions) {
    const auto* command = std::get_if<Command>(&action);
    if (command == nullptr) continue;
    ++commands;
    if (const auto* refused = std::get_if<JointTargetsRefused>(&command->body)) {
      require(!refused->reason.empty());
      for (const char c : refused->reason.view()) require(static_cast<unsigned char>(c) >= 0x20);
    } else {
      require(std::holds_alternative<JointTargets>(command->body));
      check_targets(std::get<JointTargets>(command->body), config.rules.joints.size());
      Actions later;
      channel.on_command(payload, {.retain = Retain::stored}, now, Duration(0), later);
      require(std::holds_alternative<JointTargetsRefused>(std::get<Command>(later.back()).body));
    }
  }
  require(commands == 1);
  return 0;
}
