// A simulated inertial sensor on a CAN bus: its twin and its plug.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "drover/twin.h"

namespace drover::sim {

class CanImu {
 public:
  /// `bus`: index into the scenario's.
  CanImu(std::unique_ptr<CanImuTwin> twin, std::size_t bus) : twin_(std::move(twin)), bus_(bus) {}

  std::size_t bus() const { return bus_; }
  /// Any frame on any bus. What it answers leaves with the next tick.
  void on_frame(std::size_t bus, const CanFrame& frame, Time now);
  /// One tick.
  void step(Time now, const ImuTruth& truth);
  /// What it sends at this tick. Cleared by the next step.
  std::span<const CanFrame> frames() const { return {sent_.data(), sent_.size()}; }

  /// "unplug"; "plug": its supply was away; "well", or a state of the twin. False: unknown.
  bool command(std::string_view what, Time now);

 private:
  std::unique_ptr<CanImuTwin> twin_;
  std::size_t bus_ = 0;
  bool plugged_ = true;
  TwinFrames answers_;
  TwinFrames sent_;
};

}  // namespace drover::sim
