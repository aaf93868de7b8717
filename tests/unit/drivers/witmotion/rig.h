// A WitMotion driver and its twin, with options by name.
#pragma once

#include <initializer_list>
#include <utility>

#include "drivers/witmotion/driver.h"
#include "drivers/witmotion/entry.h"
#include "drivers/witmotion/twin.h"
#include "support/imu_bench.h"

namespace drover::witmotion {

using OptionList = std::initializer_list<std::pair<std::string_view, OptionValue>>;

inline Options options_with(OptionList changes) {
  Options options(kWitmotionEntry.options);
  for (const OptionSpec& spec : kWitmotionEntry.twin_options)
    options.set(spec.name, spec.default_value);
  for (const auto& [name, value] : changes) options.set(name, value);
  return options;
}

/// The driver's and the twin's options; the sensor is as its options say, the host as its.
struct Rig : test::ImuBench {
  explicit Rig(OptionList driver_options = {}, OptionList twin_options = {})
      : Rig(options_with(driver_options), twin_options) {}
  Rig(const Options& options, OptionList twin_options)
      : ImuBench(make_device<WitmotionDriver>(options), make(options, twin_options),
                 static_cast<std::uint32_t>(options.number("baud"))) {}

  WitmotionTwin& device() { return static_cast<WitmotionTwin&>(*twin); }
  SourceState state() const { return driver->health(now).state; }
  std::string reason() const { return std::string(driver->health(now).reason.view()); }

 private:
  static std::unique_ptr<ImuTwin> make(Options options, OptionList changes) {
    for (const auto& [name, value] : changes) options.set(name, value);
    return std::make_unique<WitmotionTwin>(options, 7);
  }
};

}  // namespace drover::witmotion
