// The seam to whoever reads the robot's state and hears or gives commands: the RTK navigation
// protocol, the AimRT channel, and what comes after them. README.md tells how one is added.
//
// Pure, as the command service: time is an argument, and what must be done is appended to actions.
// All calls from one thread.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drover/event.h"
#include "drover/snapshot.h"
#include "drover/time.h"
#include "publish/actions.h"
#include "publish/arrival.h"
#include "publish/status/status.h"

namespace drover::publish {

/// A topic of the broker that an outlet wants to hear.
struct WantedTopic {
  std::string name;
  int qos = 0;  ///< 0: what did not arrive is not worth sending twice
};

/// Telemetry: dropped while the last one has not left.
struct OutMessage {
  const char* topic;  ///< lives as long as the outlet
  std::string payload;
};

/// What a message's stamps are made of.
struct Moment {
  Time now = kNever;
  Duration wall_minus_monotonic{};
};

class Outlet {
 public:
  virtual ~Outlet() = default;

  /// How often on_snapshot() is called; zero: never.
  virtual Duration period() const { return Duration::zero(); }
  /// Nothing is asked of it while the broker is away.
  virtual bool needs_broker() const { return true; }
  virtual std::vector<WantedTopic> wants() const { return {}; }

  /// What is told now of the robot as it is seen (as_seen).
  virtual std::vector<OutMessage> on_snapshot(const Snapshot& /*seen*/, const Moment& /*moment*/,
                                              Actions& /*out*/) {
    return {};
  }
  /// A message of the broker. False: the topic is another one's.
  virtual bool on_message(std::string_view /*topic*/, std::string_view /*payload*/,
                          const Arrival& /*arrival*/, Time /*now*/, Actions& /*out*/) {
    return false;
  }
  /// A line of a client of the daemon's socket; the Reply comes now or later. False: as above.
  virtual bool on_line(ClientId /*client*/, std::string_view /*line*/, Time /*now*/,
                       Actions& /*out*/) {
    return false;
  }
  /// A client of that socket is gone: no other one will have its number.
  virtual void on_gone(ClientId /*client*/) {}
  /// Of a request that came in by a line. False: it was another one's.
  virtual bool on_answer(const Answer& /*answer*/, Actions& /*out*/) { return false; }
  /// Each of the engine's, in their order.
  virtual void on_event(const Event& /*event*/, Actions& /*out*/) {}

  /// A command of this outlet's found the engine's ring full: nobody else answers.
  virtual void on_undelivered(const Command& /*command*/, Actions& /*out*/) {}

  /// What operators are told beside the robot's own reasons; empty: nothing.
  virtual std::string_view trouble(Time /*now*/) const { return {}; }
  /// Adds its counters to what `drover status` shows.
  virtual void count(DaemonStatus& /*status*/) const {}
};

}  // namespace drover::publish
