// Four simulated controllers and their motors: a current in, its torque on the shaft; angle, speed,
// current and heat out.
//
// They keep the last current for ever, the worst of what users report. The torque is the current's
// alone: drag, friction and the rotor's inertia are the world's (README.md has the numbers).
#pragma once

#include "drivers/robomaster_c620/settings.h"
#include "drover/twin.h"

namespace drover::robomaster {

struct TwinSettings {
  Duration silence{};  ///< no current without a command for longer; 0: it stands for ever
  Duration period{};   ///< between two frames of each
  double winding_ohm = 0.17;
  double thermal_resistance_KpW = 1.5;
  double thermal_capacity_JpK = 150;
  double ambient_degC = 25;
  double current_noise_A = 0;  ///< at most, of what it tells
  bool tells_temperature = true;
  Duration boot_time{};
};

TwinSettings read_twin_settings(const Options& options);
std::span<const OptionSpec> twin_option_table();

class RobomasterTwin final : public CanTwin {
 public:
  RobomasterTwin(const Settings& settings, const TwinSettings& twin);

  void on_frame(const CanFrame& frame, Time now, TwinFrames& out) override;
  void on_tick(Time now, std::span<Shaft> shafts, TwinFrames& out) override;
  void set_power(bool on, Time now) override;
  /// Known: "silent" (they tell nothing, and still obey), "silent:2" (the second one alone),
  /// "no_torque:2" (a line of its motor is torn), "stuck_encoder:2", "over_temperature:2",
  /// "loose:2" (it turns in its wheel and does not take it along).
  bool set_fault(std::string_view name, Time now) override;

 private:
  struct Unit {
    std::int16_t current = 0;
    std::int16_t told_current = 0;
    double angle_rad = 0;  ///< of the rotor
    double rotor_radps = 0;
    double degC = 25;
    bool silent = false;
    bool torn = false;
    bool stuck = false;
    bool hot = false;
    bool loose = false;
    double free_radps = 0;  ///< of its shaft, which nothing hangs on
  };
  void boot(Time now);
  void move(std::size_t channel, double dt_s, Shaft& shaft);
  std::int16_t noisy(std::int16_t current);
  void tell(std::size_t channel, TwinFrames& out);

  Settings settings_;
  TwinSettings twin_;
  bool powered_ = true;
  bool booted_ = false;
  Time boot_at_ = kNever;
  Time last_tick_ = kNever;
  Time last_fed_ = kNever;
  Time next_ = kNever;
  std::uint32_t noise_ = 1;
  std::array<Unit, kMotors> units_;
};

}  // namespace drover::robomaster
