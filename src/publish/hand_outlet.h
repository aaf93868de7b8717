// A person who drives with a key, over the daemon's socket, and what is measured meanwhile:
// `drover calibrate drive`.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "json/located_json.h"
#include "publish/outlet.h"
#include "publish/token_bucket.h"

namespace drover::publish {

/// As they were read.
struct ConfigurationTexts {
  std::string configuration;
  std::string register_map;  ///< as config::Loaded
};

/// One JSON object: what a calibration looks at, each with the instant at which it was true.
std::string drive_values_json(const Snapshot& seen);

/// Requests: `drive_by_hand` with `vx_mps`, `wz_radps` and `at_ns` (when the key came, by the
/// monotonic clock; not there: now), one for each key that the terminal repeats, answered by the
/// engine; `drive_values`; `configuration`. Whoever asks is one hand as long as he is connected.
/// Each has a rate of his own; that a key is up passes whatever came before.
class HandOutlet final : public Outlet {
 public:
  /// `seen`: the whole state as it is seen at that time.
  HandOutlet(ConfigurationTexts texts, std::function<Snapshot(Time)> seen)
      : texts_(std::move(texts)), seen_(std::move(seen)) {}

  bool needs_broker() const override { return false; }
  bool on_line(ClientId client, std::string_view line, Time now, Actions& out) override;
  void on_event(const Event& event, Actions& out) override;
  void on_undelivered(const Command& command, Actions& out) override;

 private:
  struct Client {
    TokenBucket keys{40, 20};      ///< a terminal repeats 30 a second
    TokenBucket values{250, 100};  ///< looked at a hundred times a second
    bool moves = false;            ///< has asked for motion, and not for rest since
    Time heard = kNever;
  };
  Client& client_of(ClientId id, Time now);
  std::string drive(ClientId client, const json::Node& request, Time now, Actions& out);
  void answer(const RequestId& id, bool ok, std::string_view text, Actions& out);

  ConfigurationTexts texts_;
  std::function<Snapshot(Time)> seen_;
  std::map<ClientId, Client> clients_;         ///< who was heard lately
  std::map<std::uint64_t, ClientId> waiting_;  ///< request number → who asked
  std::uint64_t last_number_ = 0;
};

}  // namespace drover::publish
