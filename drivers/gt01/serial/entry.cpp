// The chassis on a serial line: factories and the line in the registry.
#include "drivers/gt01/serial/entry.h"

#include "drivers/gt01/serial/driver.h"
#include "drivers/gt01/serial/twin.h"

namespace drover {
namespace gt01::serial {
namespace {

constexpr int kBauds[] = {115200};

Made make(const Options& options, const MakeContext& context) {
  return make_device<Gt01SerialDriver>(read_settings(options, option_table()), context.axis(0));
}

std::unique_ptr<ByteDriveTwin> make_twin(const Options& options) {
  return std::make_unique<Gt01SerialTwin>(read_settings(options, option_table()),
                                          read_chassis_settings(options));
}

constexpr std::string_view kGt01SerialProducts[] = {"searobot"};

}  // namespace
}  // namespace gt01::serial

const DriverEntry kGt01SerialEntry = {
    .name = "gt01_serial",
    .folder = "gt01/serial",
    .options = gt01::serial::option_table(),
    .kind = SlotKind::drive,
    .wire = Wire::bytes,
    .bauds = gt01::serial::kBauds,
    .channels = gt01::kChannels,
    .make = gt01::serial::make,
    .twin_options = gt01::chassis_option_table(),
    .make_twin = gt01::serial::make_twin,
    .summary = "SeaRobot chassis (the GT01's sibling), takes a twist on RS-232, protocol 1.0.3",
    .products = gt01::serial::kGt01SerialProducts,
    .twin_shafts = gt01::kTwinShafts,
};

}  // namespace drover
