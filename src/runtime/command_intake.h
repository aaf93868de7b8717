// Commands and stops as the control thread takes them: in the order in which they were asked for,
// though stops come by a path of their own.
#pragma once

#include <algorithm>

#include "drover/command.h"
#include "drover/spsc_ring.h"
#include "runtime/stop_requests.h"

namespace drover::runtime {

/// A command and the stops that were asked for before it.
struct QueuedCommand {
  Command command;
  StopCounts before;
};
using CommandRing = SpscRing<QueuedCommand, 64>;

/// The control thread's own requests are answered under this number: nobody waits for it.
inline constexpr RequestId kStopRequest{RequestId::Source::internal, 0};
constexpr bool is_stop_request(const RequestId& id) {
  return id.source == kStopRequest.source && id.number == kStopRequest.number;
}

class CommandIntake final {
 public:
  /// Hands each command to `obey(const Command&)`, once a cycle. `obey` must neither throw nor
  /// allocate.
  template <class Obey>
  void take(CommandRing& ring, StopRequests& requests, Time now, Obey&& obey) {
    QueuedCommand queued;
    for (std::size_t i = 0; i < kMostEachCycle && ring.pop(queued); ++i) {
      stop(queued.before, now, obey);
      obey(queued.command);
      // A start that waited here while a stop overtook it must not outlive that stop.
      if (!queued.before.include(obeyed_)) repeat(queued.before, now, obey);
    }
    stop(requests.asked(), now, obey);
    requests.set_obeyed(obeyed_);
  }

 private:
  static constexpr std::size_t kMostEachCycle = 64;

  template <class Obey>
  void stop(const StopCounts& asked, Time now, Obey& obey) {
    if (asked.stops > obeyed_.stops) obey(Command{kStopRequest, now, EngageStop{}});
    if (asked.cancels > obeyed_.cancels) obey(Command{kStopRequest, now, CancelTask{}});
    obeyed_.stops = std::max(obeyed_.stops, asked.stops);
    obeyed_.cancels = std::max(obeyed_.cancels, asked.cancels);
  }
  template <class Obey>
  void repeat(const StopCounts& before, Time now, Obey& obey) const {
    if (obeyed_.stops > before.stops) obey(Command{kStopRequest, now, EngageStop{}});
    if (obeyed_.cancels > before.cancels) obey(Command{kStopRequest, now, CancelTask{}});
  }

  StopCounts obeyed_;
};

}  // namespace drover::runtime
