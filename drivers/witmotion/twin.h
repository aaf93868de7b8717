// A simulated WitMotion sensor: noise, bias, gravity, and registers that obey the commands.
#pragma once

#include <cstdint>
#include <vector>

#include "drivers/noise.h"
#include "drivers/witmotion/codec.h"
#include "drivers/witmotion/framer.h"
#include "drivers/witmotion/setup.h"
#include "drover/options.h"
#include "drover/twin.h"

namespace drover::witmotion {

/// Measures at each output cycle the truth of that instant. Settings work while it is unlocked (10
/// s from an unlock), not while it is busy with the command before, and are lost by a restart
/// unless they were saved. It starts with the settings that the driver's options ask for, or, by
/// the option `factory`, with those it is shipped with: 9600, 10 Hz, acceleration, rate, angles and
/// field.
///
/// States of set_state(); each but `restart` replaces the one before:
///   ""                 well
///   silent             no bytes; it does not listen either
///   frozen             the same readings over and over
///   saturated          acceleration x and rate z at the end of their range
///   garbage            as many bytes as ever, none of them a frame
///   bias:<deg/s>       that much more bias about z of base_link
///   scale:<factor>     the rate is that factor of the truth
///   vibration:<m/s2>   acceleration along z of base_link, 60 Hz, this amplitude
///   rate:<Hz>          its output falls to this pace, whatever the register says
///   restart            its supply was away: the saved settings count
class WitmotionTwin final : public ImuTwin {
 public:
  WitmotionTwin(const Options& options, std::uint64_t seed);

  std::size_t on_tick(Time now, const ImuTruth& truth, std::span<char> out) override;
  void on_bytes(std::span<const std::uint8_t> bytes, Time now) override;
  std::uint32_t baud() const override;
  bool set_state(std::string_view name, Time now) override;

  const Settings& settings() const { return active_; }
  const Settings& saved() const { return saved_; }
  int saves() const { return saves_; }  ///< how often flash was written

 private:
  enum class Fault : std::uint8_t { none, silent, frozen, saturated, garbage };
  /// One cycle's readings as words.
  struct Readings {
    Words acceleration{};
    Words rate{};
    Words angles{};
    std::array<std::int16_t, 4> quaternion{};
    Words field{};
    std::int16_t temperature = 0;
  };

  void obey(const Command& command, Time now);
  void answer(std::uint8_t first);
  std::uint16_t* setting(std::uint8_t address);
  double pace_Hz() const;
  void measure(Time now, const ImuTruth& truth);
  Vector3 noise(double sigma);
  void say_cycle(Time now);
  void say(FrameType type, std::array<std::int16_t, 4> words);
  void say_combined();
  void say_date(Time now);

  // Settings of the simulation.
  bool combined_;
  Quaternion to_base_;
  Vector3 rate_bias_radps_;  ///< in base_link, as all below
  Vector3 acceleration_bias_mps2_;
  double rate_sigma_radps_;
  double acceleration_sigma_mps2_;
  double bias_walk_;  ///< rad/s per square root of a second
  double attitude_sigma_rad_;
  double temperature_degC_;
  double magnetic_error_rad_;

  Settings active_;
  Settings saved_;
  int saves_ = 0;
  Time unlocked_until_ = kNever;
  Time busy_until_ = kNever;
  Command incoming_{};
  std::size_t incoming_size_ = 0;

  Random noise_;
  Fault fault_ = Fault::none;
  double fault_bias_radps_ = 0;
  double fault_scale_ = 1;
  double vibration_mps2_ = 0;
  double fault_pace_Hz_ = kAbsent;

  Time start_ = kNever;
  Time next_cycle_ = kNever;
  Time last_cycle_ = kNever;
  double first_yaw_rad_ = kAbsent;
  double yaw_error_rad_ = 0;  ///< what the bias has made of the six-axis yaw
  Readings readings_;
  std::vector<std::uint8_t> said_;  ///< waits for the next tick
};

}  // namespace drover::witmotion
