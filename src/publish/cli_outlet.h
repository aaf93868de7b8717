// The command line as an outlet: one JSON request a line, one JSON reply a line.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "publish/command_service.h"
#include "publish/outlet.h"

namespace drover::publish {

/// Takes every line, also to refuse it: the last of the outlets.
class CliOutlet final : public Outlet {
 public:
  /// `status`: the whole state as it is seen at that time, one JSON object (status_json).
  CliOutlet(CommandService& service, std::function<std::string(Time)> status)
      : service_(service), status_(std::move(status)) {}

  bool needs_broker() const override { return false; }
  bool on_line(ClientId client, std::string_view line, Time now, Actions& out) override;
  bool on_answer(const Answer& answer, Actions& out) override;

 private:
  std::string at_once(std::string_view cmd, const std::string& name, Time now) const;

  CommandService& service_;
  std::function<std::string(Time)> status_;
  struct Asked {
    ClientId client = 0;
    bool stop = false;
  };
  std::map<std::uint64_t, Asked> waiting_;  ///< by the number of the request
  std::uint64_t next_request_ = 1;
};

}  // namespace drover::publish
