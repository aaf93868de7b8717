// The AimRT channel as an outlet: states at a rate of its own, joint commands in.
#pragma once

#include "publish/aimrt/channel.h"
#include "publish/outlet.h"

namespace drover::publish {

class AimrtOutlet final : public Outlet {
 public:
  /// `commands` outlives it; they are heard only if `hears_commands`.
  AimrtOutlet(const aimrt::ChannelConfig& config, aimrt::JointCommands& commands, double rate_Hz,
              bool hears_commands)
      : channel_(config, commands), period_(from_s(1 / rate_Hz)), hears_commands_(hears_commands) {}

  Duration period() const override { return period_; }
  std::vector<WantedTopic> wants() const override;
  std::vector<OutMessage> on_snapshot(const Snapshot& seen, const Moment& moment,
                                      Actions& out) override;
  bool on_message(std::string_view topic, std::string_view payload, const Arrival& arrival,
                  Time now, Actions& out) override;

 private:
  aimrt::Channel channel_;
  Duration period_;
  bool hears_commands_;
};

}  // namespace drover::publish
