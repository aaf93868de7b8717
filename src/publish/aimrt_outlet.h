// The AimRT channel as an outlet: states at a rate of its own, joint commands in.
#pragma once

#include "publish/aimrt/channel.h"
#include "publish/outlet.h"

namespace drover::publish {

class AimrtOutlet final : public Outlet {
 public:
  AimrtOutlet(const aimrt::ChannelConfig& config, double rate_Hz, bool commands)
      : channel_(config), period_(from_s(1 / rate_Hz)), commands_(commands) {}

  Duration period() const override { return period_; }
  std::vector<WantedTopic> wants() const override;
  std::vector<OutMessage> on_snapshot(const Snapshot& seen, const Moment& moment,
                                      Actions& out) override;
  bool on_message(std::string_view topic, std::string_view payload, const Arrival& arrival,
                  Time now, Actions& out) override;
  std::string_view trouble(Time now) const override { return channel_.rivals(now); }
  void count(DaemonStatus& status) const override;

 private:
  aimrt::Channel channel_;
  Duration period_;
  bool commands_;  ///< joint commands are heard
};

}  // namespace drover::publish
