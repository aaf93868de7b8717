// A second connection to the broker, in a thread of its own, that hears nothing but stops. The
// first one may be far behind: it parses, answers and sends lists, and of what waits too long for
// it the broker drops some, a stop among it. This one throws everything else away as it comes.
//
// Answers leave by it, too: on the first, the broker's acknowledgements wait behind the flood, and
// without them no more than a few answers may be under way.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "config/config.h"
#include "drover/spsc_ring.h"
#include "publish/arrival.h"
#include "publish/rtk_navigation/control.h"
#include "runtime/mqtt_client.h"
#include "runtime/stop_order.h"
#include "runtime/stop_requests.h"
#include "runtime/wake.h"

namespace drover::runtime {

/// Asks for what a stop means: zero at once for a terminate, a ramp for a cancel.
StopCounts ask(StopRequests& stops, const publish::ControlCommand& stop);

class StopListener final : public HearsStops {
 public:
  StopListener(const config::MqttConfig& config, StopRequests& stops);

  void run(const std::atomic<bool>& stop);
  void wake() const { wake_.notify(); }
  /// Counts several times a second while the thread lives.
  const std::atomic<std::uint64_t>& turns() const { return turns_; }

  // Publish thread:
  bool connected() const override { return connected_.load(std::memory_order_relaxed); }
  /// A message for `feedback`. False: not taken, say because the broker is gone.
  bool answer(const std::string& text);
  /// Answers that could not leave after all.
  bool take_unsent(std::string& text) { return unsent_.pop(text); }
  /// Answers that found no room to be given back: nobody gets them.
  std::uint64_t lost_answers() const { return lost_answers_.load(std::memory_order_relaxed); }
  bool take(HeardStop& heard) override {
    const bool taken = heard_.pop(heard);
    taken_ += taken ? 1U : 0U;
    return taken;
  }
  std::uint64_t lost() const override { return lost_.load(std::memory_order_acquire); }
  bool knows_more() const override {
    return begun_.load(std::memory_order_acquire) != taken_ + lost();
  }
  /// Readable when there is one.
  const Wake& heard_ready() const { return heard_ready_; }

 private:
  void on_message(const MqttMessage& message);

  StopRequests& stops_;
  MqttClient broker_;
  SpscRing<HeardStop, 64> heard_;
  Wake heard_ready_;
  std::atomic<std::uint64_t> begun_{0};
  std::atomic<std::uint64_t> lost_{0};
  std::uint64_t taken_ = 0;  ///< publish thread's
  SpscRing<std::string, 64> answers_;
  SpscRing<std::string, 64> unsent_;
  std::atomic<std::uint64_t> lost_answers_{0};
  Wake wake_;
  std::atomic<bool> connected_{false};
  std::atomic<std::uint64_t> turns_{0};
};

}  // namespace drover::runtime
