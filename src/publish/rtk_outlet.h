// The RTK navigation protocol as an outlet: base_status ten times a second, and what the command
// service learns of the robot. What comes on mqtt_control goes to that service by the way on which
// stops overtake everything else (runtime).
#pragma once

#include "publish/command_service.h"
#include "publish/outlet.h"
#include "publish/rtk_navigation/base_status.h"

namespace drover::publish {

class RtkOutlet final : public Outlet {
 public:
  RtkOutlet(const RtkConfig& config, CommandService& service)
      : base_status_(config), service_(service) {}

  Duration period() const override { return std::chrono::milliseconds(100); }
  bool needs_broker() const override { return false; }  // the service serves the command line, too
  std::vector<WantedTopic> wants() const override { return {{std::string(kTopicControl), 1}}; }
  std::vector<OutMessage> on_snapshot(const Snapshot& seen, const Moment& moment,
                                      Actions& out) override {
    service_.on_snapshot(seen, moment.now, out);
    return {{kTopicBaseStatus.data(), base_status_.text(seen)}};
  }
  void on_event(const Event& event, Actions& out) override { service_.on_event(event, out); }

 private:
  BaseStatus base_status_;
  CommandService& service_;
};

}  // namespace drover::publish
