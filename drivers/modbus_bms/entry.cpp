// Options of the Modbus battery driver and its twin, and its line in the registry.
#include "drivers/modbus_bms/entry.h"

#include <memory>
#include <stdexcept>

#include "drivers/checked_options.h"
#include "drivers/modbus_bms/driver.h"
#include "drivers/modbus_bms/twin.h"

namespace drover {
namespace modbus_bms {
namespace {

constexpr std::string_view kSigns[] = {"as_mapped", "reversed"};

const OptionSpec kOptions[] = {
    {.name = "stale_s",
     .default_value = 5.0,
     .min = 1.0,
     .max = 60.0,
     .text = "without a whole good round for longer the battery is unknown (s); five rounds"},
    {.name = "current_sign",
     .default_value = std::string("as_mapped"),
     .choices = kSigns,
     .text = "reversed when the current is positive while the pack discharges: vendors' sheets "
             "and devices differ; the health text tells when current and state contradict"},
    {.name = "min_voltage_V",
     .default_value = 0.0,
     .min = 0.0,
     .max = 1000.0,
     .text = "lower voltages are not believed (V)"},
    {.name = "max_voltage_V",
     .default_value = 1000.0,
     .min = 1.0,
     .max = 1000.0,
     .text = "higher voltages are not believed (V)"},
    {.name = "charger_current_A",
     .default_value = 2.0,
     .min = 0.1,
     .max = 500.0,
     .text = "a charging current of so much (A) for charger_after_s means that a charger is "
             "connected; more than braking gives back, less than the charger does"},
    {.name = "charger_after_s",
     .default_value = 3.0,
     .min = 0.0,
     .max = 60.0,
     .text = "how long (s); 0: the first round with it counts"},
};

const OptionSpec kTwinOptions[] = {
    {.name = "cells",
     .default_value = 8.0,
     .min = 1.0,
     .max = 32.0,
     .integer = true,
     .text = "cells in series"},
    {.name = "probes",
     .default_value = 2.0,
     .min = 1.0,
     .max = 8.0,
     .integer = true,
     .text = "temperature probes"},
};

Made make(const Options& options, const MakeContext& context) {
  if (context.registers == nullptr) throw std::runtime_error("a register map is needed");
  return make_device<ModbusBmsDriver>(read_settings(options), *context.registers);
}
std::unique_ptr<RegisterTwin> make_twin(const Options& options, const RegisterMap& map) {
  return std::make_unique<ModbusBmsTwin>(all_checked(options, kTwinOptions), map);
}

constexpr std::string_view kModbusBmsProducts[] = {"daly", "jk", "jkbms", "jkpb", "jikong"};

}  // namespace

Settings read_settings(const Options& given) {
  const CheckedOptions options(given, kOptions);
  Settings settings;
  settings.stale_after = options.seconds("stale_s");
  settings.current_reversed = options.text("current_sign") == "reversed";
  settings.min_voltage_V = options.number("min_voltage_V");
  settings.max_voltage_V = options.number("max_voltage_V");
  settings.charger_current_A = options.number("charger_current_A");
  settings.charger_after = options.seconds("charger_after_s");
  if (settings.min_voltage_V >= settings.max_voltage_V)
    throw std::runtime_error("min_voltage_V must be below max_voltage_V");
  return settings;
}

}  // namespace modbus_bms

const DriverEntry kModbusBmsEntry = {
    .name = "modbus_bms",
    .folder = "modbus_bms",
    .options = modbus_bms::kOptions,
    .kind = SlotKind::battery,
    .wire = Wire::registers,
    .make = modbus_bms::make,
    .twin_options = modbus_bms::kTwinOptions,
    .make_twin = modbus_bms::make_twin,
    .summary = "battery management system over Modbus, by a register map",
    .products = modbus_bms::kModbusBmsProducts,
};

}  // namespace drover
