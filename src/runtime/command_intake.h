// Commands and stops as the control thread takes them: in the order in which they were asked for,
// though stops come by a path of their own.
#pragma once

#include <algorithm>
#include <optional>

#include "drover/command.h"
#include "drover/spsc_ring.h"
#include "runtime/stop_requests.h"

namespace drover::runtime {

/// A command and the stops that were asked for before it.
struct QueuedCommand {
  Command command;
  StopCounts before;
};
/// Joint commands that were held up come at once by two ways: beside them there is room for others.
using CommandRing = SpscRing<QueuedCommand, 128>;

inline constexpr std::uint64_t kStopMark = std::uint64_t{1} << 62U;  // fits a signed one, too

/// The control thread's own requests are answered under a number that tells which stops are obeyed
/// with it: so each is answered in its place among starts.
constexpr RequestId stop_request(const StopCounts& obeyed) {
  return {RequestId::Source::internal,
          kStopMark | (obeyed.cancels & 0x3FFFFFFFU) << 32U | (obeyed.stops & 0xFFFFFFFFU)};
}
/// Nothing when the request was another one's.
constexpr std::optional<StopCounts> obeyed_with(const RequestId& id) {
  if (id.source != RequestId::Source::internal || (id.number & kStopMark) == 0) return std::nullopt;
  return StopCounts{(id.number & ~kStopMark) >> 32U, id.number & 0xFFFFFFFFU};
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
      // A start that waited here while a stop overtook it is none any more; what else begins a
      // motion must not outlive that stop.
      const bool overtaken = !queued.before.include(obeyed_);
      auto* const start = std::get_if<StartTask>(&queued.command.body);
      if (start != nullptr) start->overtaken = overtaken;
      obey(queued.command);
      if (overtaken && start == nullptr) repeat(queued.before, now, obey);
    }
    stop(requests.asked(), now, obey);
    requests.set_obeyed(obeyed_);
  }

 private:
  static constexpr std::size_t kMostEachCycle = 64;

  template <class Obey>
  void stop(const StopCounts& asked, Time now, Obey& obey) {
    const StopCounts before = obeyed_;
    obeyed_.stops = std::max(obeyed_.stops, asked.stops);
    obeyed_.cancels = std::max(obeyed_.cancels, asked.cancels);
    const RequestId id = stop_request(obeyed_);
    if (asked.stops > before.stops) obey(Command{id, now, EngageStop{}});
    if (asked.cancels > before.cancels) obey(Command{id, now, CancelTask{}});
  }
  template <class Obey>
  void repeat(const StopCounts& before, Time now, Obey& obey) const {
    const RequestId id = stop_request(obeyed_);
    if (obeyed_.stops > before.stops) obey(Command{id, now, EngageStop{}});
    if (obeyed_.cancels > before.cancels) obey(Command{id, now, CancelTask{}});
  }

  StopCounts obeyed_;
};

}  // namespace drover::runtime
