// The command line as an outlet: one JSON request a line, one JSON reply a line.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "json/located_json.h"
#include "publish/command_service.h"
#include "publish/outlet.h"

namespace drover::publish {

/// Whether a line asks for a stop, orderly or not, as drover and drover-ros2 write it: such a line
/// waits for no other. Cheap for those that do not.
bool is_stop_line(std::string_view line);

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
  /// A stop that tells whose it is and which one, of someone who may lose its answer.
  struct NamedStop {
    std::string from;
    std::int64_t number = 0;
    std::uint64_t request = 0;
    bool done = false;
  };
  static std::optional<NamedStop> named_stop(const json::Node& request);
  bool told_again(ClientId client, const NamedStop& stop, Actions& out);
  std::string at_once(std::string_view cmd, const std::string& name, Time now) const;

  CommandService& service_;
  std::function<std::string(Time)> status_;
  struct Asked {
    ClientId client = 0;
    bool stop = false;
  };
  std::map<std::uint64_t, Asked> waiting_;  ///< by the number of the request
  std::uint64_t next_request_ = 1;
  NamedStop last_stop_;
};

}  // namespace drover::publish
