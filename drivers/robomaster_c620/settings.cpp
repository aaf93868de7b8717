// Option table of RoboMaster motors.
#include "drivers/robomaster_c620/settings.h"

#include <stdexcept>

#include "drivers/checked_options.h"

namespace drover::robomaster {
namespace {

constexpr std::string_view kSets[] = {"1-4", "5-8"};

const OptionSpec kOptions[] = {
    {.name = "motors",
     .default_value = std::string("1-4"),
     .choices = kSets,
     .text =
         "numbers set at the controllers: one frame commands 1 to 4 (0x200), another one 5 to 8 "
         "(0x1FF); channel 1 is the first of them"},
    {.name = "reversed_1",
     .default_value = false,
     .text = "the first motor turns against its joint"},
    {.name = "reversed_2",
     .default_value = false,
     .text = "the second motor turns against its joint"},
    {.name = "reversed_3",
     .default_value = false,
     .text = "the third motor turns against its joint"},
    {.name = "reversed_4",
     .default_value = false,
     .text = "the fourth motor turns against its joint"},
    {.name = "gear_ratio",
     .default_value = 3591.0 / 187,
     .min = 0.001,
     .max = 1000,
     .text = "rotor turns per turn of the joint: M3508 3591/187 (the default), M2006 36, without a "
             "gear 1"},
    {.name = "torque_constant_Nm_per_A",
     .default_value = 0.01562,
     .min = 0.0001,
     .max = 10,
     .text = "at the rotor, before the gear: M3508 0.01562, M2006 0.005"},
    {.name = "full_scale_A",
     .default_value = 20.0,
     .min = 1,
     .max = 100,
     .text = "the most that the controller takes: C620 20, C610 10"},
    {.name = "full_scale_counts",
     .default_value = 16384.0,
     .min = 1000,
     .max = 32767,
     .integer = true,
     .text = "what stands on the wire for full_scale_A: C620 16384, C610 10000"},
    {.name = "current_limit_A",
     .default_value = 16.0,
     .min = 0.1,
     .max = 100,
     .text = "of each motor; an M3508 bears 10 for long, what more does is heat"},
    {.name = "max_rpm",
     .default_value = 9000.0,
     .min = 1,
     .max = 30000,
     .text = "of the rotor: faster set points are clamped"},
    {.name = "velocity_gain_Nms_per_rad",
     .default_value = 0.0,
     .required = true,
     .min = 0.001,
     .max = 1000,
     .text =
         "of the speed loop, at the joint. None fits all: about 35 times the inertia that a wheel "
         "has by itself, with its rotor (kg m²; 0.0085 of a 152 mm wheel on an M3508: 0.3). With "
         "more a tyre swings"},
    {.name = "integrator_s",
     .default_value = 0.12,
     .min = 0.01,
     .max = 100,
     .text =
         "the time after which the speed loop asks for as much again as its gain (s); and so how "
         "stiffly a wheel is kept at rest"},
    {.name = "friction_A",
     .default_value = 0.15,
     .min = 0,
     .max = 5,
     .text = "asked for beside the speed loop, the way that a wheel shall turn: a little less than "
             "what one needs to go on turning, or it creeps; an M3508 by itself 0.15"},
    {.name = "ramp_radps2",
     .default_value = 60.0,
     .min = 0.1,
     .max = 10000,
     .text = "the set point goes no faster, at the joint; the gateway ramps by itself"},
    {.name = "hot_degC",
     .default_value = 70.0,
     .min = 0,
     .max = 125,
     .text = "from this on a motor gets less and less current, down to three tenths"},
    {.name = "too_hot_degC",
     .default_value = 85.0,
     .min = 1,
     .max = 125,
     .text = "this is a fault, and no start before it is cooler; a C610 tells no temperature"},
    {.name = "blind_s",
     .default_value = 0.03,
     .min = 0.002,
     .max = 1,
     .text = "a motor that has told nothing for so long gets no current (s)"},
    {.name = "stale_s",
     .default_value = 0.1,
     .min = 0.02,
     .max = 2,
     .text = "a motor that has told nothing for so long is silent, and the others brake (s)"},
    {.name = "timeout_s",
     .default_value = 0.3,
     .min = 0.05,
     .max = 5,
     .text = "after so long nobody knows what it does (s)"},
};

}  // namespace

std::span<const OptionSpec> option_table() {
  return kOptions;
}

Settings read_settings(const Options& options) {
  const CheckedOptions checked(options, kOptions);
  Settings settings;
  settings.first_motor = checked.text("motors") == kSets[0] ? 1 : 5;
  constexpr std::string_view kReversed[] = {"reversed_1", "reversed_2", "reversed_3", "reversed_4"};
  for (std::size_t i = 0; i < kMotors; ++i) settings.sign[i] = options.flag(kReversed[i]) ? -1 : 1;
  const double full_A = checked.number("full_scale_A");
  const double limit_A = checked.number("current_limit_A");
  settings.gear_ratio = checked.number("gear_ratio");
  settings.most_counts = checked.number("full_scale_counts");
  settings.counts_per_A = settings.most_counts / full_A;
  settings.Nm_per_A = checked.number("torque_constant_Nm_per_A") * settings.gear_ratio;
  settings.limit_Nm = limit_A * settings.Nm_per_A;
  settings.max_radps = checked.number("max_rpm") * kRadpsPerRpm / settings.gear_ratio;
  settings.velocity_gain_Nms_per_rad = checked.number("velocity_gain_Nms_per_rad");
  settings.integrator_gain_Nm_per_rad =
      settings.velocity_gain_Nms_per_rad / checked.number("integrator_s");
  settings.friction_Nm = checked.number("friction_A") * settings.Nm_per_A;
  settings.ramp_radps2 = checked.number("ramp_radps2");
  settings.hot_degC = checked.number("hot_degC");
  settings.too_hot_degC = checked.number("too_hot_degC");
  settings.blind_after = checked.seconds("blind_s");
  settings.stale_after = checked.seconds("stale_s");
  settings.silent_after = checked.seconds("timeout_s");
  if (limit_A > full_A) throw std::runtime_error("current_limit_A is more than full_scale_A");
  if (settings.hot_degC >= settings.too_hot_degC)
    throw std::runtime_error("hot_degC is not below too_hot_degC");
  if (settings.blind_after > settings.stale_after)
    throw std::runtime_error("blind_s is longer than stale_s");
  if (settings.stale_after > settings.silent_after)
    throw std::runtime_error("stale_s is longer than timeout_s");
  return settings;
}

}  // namespace drover::robomaster
