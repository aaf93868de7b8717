// The parser's thread: reads large messages of mqtt_control where nobody waits for it. Two
// megabytes take longer than a stop may.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "drover/spsc_ring.h"
#include "publish/arrival.h"
#include "publish/rtk_navigation/control.h"
#include "runtime/stop_requests.h"
#include "runtime/wake.h"

namespace drover::runtime {

struct ParseJob {
  std::string payload;
  publish::Arrival arrival;
  StopCounts before = {};  ///< the stops that were asked for before it came
};

struct ParseReply {
  ParseJob job;
  std::optional<Result<publish::ControlCommand, publish::ControlRefusal>> request;
};

class ParserLoop final {
 public:
  /// Four of the largest: what is beyond is refused aloud rather than kept.
  static constexpr std::size_t kMostWaitingBytes = std::size_t{8} << 20;
  static constexpr Duration kLongestTurn = std::chrono::seconds(5);

  explicit ParserLoop(const publish::ControlLimits& limits) : limits_(limits) {}

  // Publish thread:
  /// False when too much waits; then nothing was taken.
  [[nodiscard]] bool give(ParseJob job);
  /// Something was given whose reply was not taken yet: what comes after it must wait for it.
  bool busy() const { return under_way_ > 0; }
  bool take(ParseReply& reply);
  /// Readable when a reply waits.
  const Wake& replies_ready() const { return replies_ready_; }

  void run(const std::atomic<bool>& stop);
  void wake() const { jobs_ready_.notify(); }
  /// Counts at least once in kLongestTurn while the thread lives.
  const std::atomic<std::uint64_t>& turns() const { return turns_; }

 private:
  publish::ControlLimits limits_;
  SpscRing<ParseJob, 64> jobs_;
  SpscRing<ParseReply, 64> replies_;
  Wake jobs_ready_;
  Wake replies_ready_;
  std::size_t under_way_ = 0;      ///< publish thread's
  std::size_t waiting_bytes_ = 0;  ///< publish thread's
  std::atomic<std::uint64_t> turns_{0};
};

}  // namespace drover::runtime
