// A simulated HiPNUC sensor on CAN.
#pragma once

#include "drivers/hipnuc_can/driver.h"
#include "drover/twin.h"

namespace drover::hipnuc_can {

class HipnucCanTwin final {
 public:
  explicit HipnucCanTwin(const Settings& settings) : settings_(settings) {}

  /// Call at each step; sends what is due, each 10 ms.
  void on_tick(Time now, const ImuTruth& truth, TwinFrames& out);
  /// An NMT start for it, which its CANopen frames wait for.
  void on_frame(const CanFrame& frame);
  /// "silent", "no_rates", "" (well). Returns false when unknown.
  bool set_state(std::string_view name);

 private:
  Settings settings_;
  bool started_ = false;
  bool silent_ = false;
  bool no_rates_ = false;
  Time next_ = kNever;
};

}  // namespace drover::hipnuc_can
