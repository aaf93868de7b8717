// The chassis on CAN: factories and the line in the registry.
#include "drivers/gt01/can/entry.h"

#include "drivers/gt01/can/driver.h"
#include "drivers/gt01/can/twin.h"

namespace drover {
namespace gt01::can {
namespace {

Made make(const Options& options, const MakeContext& context) {
  return make_device<Gt01CanDriver>(read_settings(options, option_table()), read_layout(options),
                                    context.axis(0));
}

std::unique_ptr<CanTwin> make_twin(const Options& options) {
  return std::make_unique<Gt01CanTwin>(read_settings(options, option_table()), read_layout(options),
                                       read_chassis_settings(options));
}

constexpr std::string_view kGt01CanProducts[] = {"gt01"};

}  // namespace
}  // namespace gt01::can

const DriverEntry kGt01CanEntry = {
    .name = "gt01_can",
    .folder = "gt01/can",
    .options = gt01::can::option_table(),
    .kind = SlotKind::drive,
    .wire = Wire::can,
    .channels = gt01::kChannels,
    .make = gt01::can::make,
    .twin_options = gt01::chassis_option_table(),
    .make_twin = gt01::can::make_twin,
    .summary = "GT01 chassis, takes a twist on CAN, protocol 1.0",
    .products = gt01::can::kGt01CanProducts,
    .twin_shafts = gt01::kTwinShafts,
};

}  // namespace drover
