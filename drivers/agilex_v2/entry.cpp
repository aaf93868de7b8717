#include "drivers/agilex_v2/entry.h"

#include "drivers/agilex_v2/driver.h"
#include "drivers/agilex_v2/twin.h"
#include "drivers/checked_options.h"

namespace drover {
namespace {

using agilex_v2::AgilexV2Driver;
using agilex_v2::AgilexV2Twin;

Made make(const Options& options, const MakeContext& context) {
  return make_device<AgilexV2Driver>(
      context.axis(0), std::optional<agilex_v2::Steering>(),
      CheckedOptions(options, agilex_v2::option_table()).flag("zero_holds"));
}

std::unique_ptr<CanTwin> make_twin(const Options& options) {
  return std::make_unique<AgilexV2Twin>(options);
}

constexpr std::string_view kAgilexV2Products[] = {"scout"};

}  // namespace

const DriverEntry kAgilexV2Entry{
    .name = "agilex_v2",
    .folder = "agilex_v2",
    .options = agilex_v2::option_table(),
    .kind = SlotKind::drive,
    .wire = Wire::can,
    .channels = agilex_v2::kChannels,
    .make = make,
    .twin_options = agilex_v2::twin_option_table(),
    .make_twin = make_twin,
    .summary = "AgileX Scout on CAN, protocol v2: a base that takes a twist",
    .products = kAgilexV2Products,
    .twin_shafts = 2,
};

}  // namespace drover
