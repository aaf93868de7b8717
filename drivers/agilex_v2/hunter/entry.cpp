#include "drivers/agilex_v2/hunter/entry.h"

#include <array>

#include "drivers/agilex_v2/driver.h"
#include "drivers/agilex_v2/hunter/twin.h"
#include "drivers/checked_options.h"

namespace drover {
namespace agilex_v2 {
namespace {

constexpr std::array kHunterOptions{
    OptionSpec{.name = "wheelbase_m",
               .default_value = 0.65,
               .min = 0.2,
               .max = 3,
               .text = "Between its axles"},
    OptionSpec{.name = "track_m",
               .default_value = 0.605,
               .min = 0.1,
               .max = 3,
               .text = "Between its steered wheels"},
    OptionSpec{.name = "max_steering_rad",
               .default_value = 0.576,
               .min = 0.1,
               .max = 1,
               .text = "How far its inner wheel is steered at the most"},
};

Steering read_steering(const Options& given) {
  const CheckedOptions options(given, kHunterOptions);
  return {options.number("wheelbase_m"), options.number("track_m"),
          options.number("max_steering_rad")};
}

Made make_hunter(const Options& options, const MakeContext& context) {
  return make_device<AgilexV2Driver>(context.axis(0), read_steering(options));
}

std::unique_ptr<CanTwin> make_hunter_twin(const Options& options) {
  return std::make_unique<HunterTwin>(options, read_steering(options));
}

constexpr std::string_view kAgilexV2HunterProducts[] = {"hunter"};

}  // namespace
}  // namespace agilex_v2

const DriverEntry kAgilexHunterEntry{
    .name = "agilex_hunter",
    .folder = "agilex_v2/hunter",
    .options = agilex_v2::kHunterOptions,
    .kind = SlotKind::drive,
    .wire = Wire::can,
    .channels = agilex_v2::kChannels,
    .make = agilex_v2::make_hunter,
    .twin_options = agilex_v2::hunter_twin_option_table(),
    .make_twin = agilex_v2::make_hunter_twin,
    .summary = "AgileX Hunter 2 on CAN: a base that takes a twist, and steers",
    .products = agilex_v2::kAgilexV2HunterProducts,
    .twin_shafts = agilex_v2::kHunterShafts,
    .steers = true,
};

}  // namespace drover
