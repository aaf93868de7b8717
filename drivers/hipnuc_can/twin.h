// A simulated HiPNUC sensor on CAN: noise, bias, gravity, and a yaw that begins anywhere.
#pragma once

#include "drivers/hipnuc_can/driver.h"
#include "drivers/noise.h"
#include "drover/twin.h"

namespace drover::hipnuc_can {

/// What it is set to, and what is wrong with its readings: nothing.
struct TwinSettings {
  Duration period = std::chrono::milliseconds(10);
  double rate_sigma_radps = 0;
  double rate_bias_sigma_radps = 0;
  double acceleration_sigma_mps2 = 0;
  double acceleration_bias_sigma_mps2 = 0;
  double attitude_sigma_rad = 0;
};

/// States of set_state(); each but `restart` replaces the one before:
///   ""                 well
///   silent             no frames; it does not listen either
///   no_rates           accelerations and attitude only
///   saturated          acceleration x and rate z at the end of their range
///   bias:<deg/s>       that much more bias about z of base_link
///   restart            its supply was away: with CANopen frames it waits for an NMT start again
class HipnucCanTwin final : public CanImuTwin {
 public:
  HipnucCanTwin(const Settings& settings, const TwinSettings& own, std::uint64_t seed);

  /// Frames of a sample leave together, with J1939 frames from the first tick on.
  void on_tick(Time now, const ImuTruth& truth, TwinFrames& out) override;
  /// An NMT command for it.
  void on_frame(const CanFrame& frame, Time now, TwinFrames& out) override;
  bool set_state(std::string_view name, Time now) override;

 private:
  enum class Fault : std::uint8_t { none, silent, no_rates, saturated };

  void say_sample(const ImuTruth& truth, TwinFrames& out);
  Vector3 noise(double sigma);

  Settings settings_;
  TwinSettings own_;
  Random noise_;
  Vector3 rate_bias_radps_;  ///< in base_link, as the next
  Vector3 acceleration_bias_mps2_;
  double first_yaw_rad_ = kAbsent;
  double yaw_error_rad_ = 0;  ///< what the bias has made of its yaw
  bool started_ = false;
  Fault fault_ = Fault::none;
  double fault_bias_radps_ = 0;
  Time next_ = kNever;
};

}  // namespace drover::hipnuc_can
