// Options of a digital input and its line in the registry.
#include "drivers/gpio_line/entry.h"

#include <memory>
#include <stdexcept>

#include "drivers/checked_options.h"
#include "drivers/gpio_line/driver.h"

namespace drover {
namespace gpio_line {
namespace {

constexpr std::string_view kLevels[] = {"low", "high"};
constexpr std::string_view kGpioLineProducts[] = {"estop", "emergencystop", "bumper", "button"};

const OptionSpec kOptions[] = {
    {.name = "active_level",
     .default_value = std::string("low"),
     .choices = kLevels,
     .text = "level that means stop, touched or occupied; low, because a normally closed contact "
             "that feeds the line high reads low when it opens and when its wire breaks"},
    {.name = "active_debounce_s",
     .default_value = 0.0,
     .min = 0.0,
     .max = 1.0,
     .text = "active for so long before it counts (s); 0 for an emergency stop, always; a scanner "
             "whose outputs carry test pulses needs a little more than a pulse"},
    {.name = "release_debounce_s",
     .default_value = 0.2,
     .min = 0.0,
     .max = 10.0,
     .text = "inactive without a break for so long before it is released (s); contacts bounce for "
             "some 20 ms, and nobody is in a hurry to be moved"},
    {.name = "stale_s",
     .default_value = 0.02,
     .min = 0.001,
     .max = 1.0,
     .text = "without a reading for longer it counts as active (s); four control cycles"},
};

Made make(const Options& options, const MakeContext& context) {
  return make_device<GpioLineDriver>(read_settings(options, context.line));
}

}  // namespace

std::span<const OptionSpec> option_table() {
  return kOptions;
}

Settings read_settings(const Options& options, Line line) {
  const CheckedOptions checked(options, kOptions);
  Settings settings;
  settings.line = line;
  settings.active_high = checked.text("active_level") == "high";
  settings.active_debounce = checked.seconds("active_debounce_s");
  settings.release_debounce = checked.seconds("release_debounce_s");
  settings.stale_after = checked.seconds("stale_s");
  if (line == Line::estop && settings.active_debounce != Duration{})
    throw std::runtime_error("active_debounce_s must be 0: an emergency stop counts at once");
  return settings;
}

}  // namespace gpio_line

const DriverEntry kGpioLineEntry = {
    .name = "gpio_line",
    .folder = "gpio_line",
    .options = gpio_line::kOptions,
    .kind = SlotKind::line,
    .wire = Wire::levels,
    .make = gpio_line::make,
    .twin_options = {},
    .make_twin = {},
    .summary = "digital input: emergency stop, bumper, zones of a safety scanner",
    .products = gpio_line::kGpioLineProducts,
};

}  // namespace drover
