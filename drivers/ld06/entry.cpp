#include "drivers/ld06/entry.h"

#include <memory>

#include "drivers/ld06/driver.h"
#include "drivers/ld06/settings.h"
#include "drivers/ld06/twin.h"

namespace drover {
namespace ld06 {
namespace {

constexpr int kBauds[] = {230400};

Made make(const Options& options, const MakeContext&) {
  return make_device<Ld06Driver>(options);
}
std::unique_ptr<ScannerTwin> make_twin(const Options& options, std::uint64_t seed) {
  return std::make_unique<Ld06Twin>(options.flag("upside_down"), seed);
}

constexpr std::string_view kLd06Products[] = {"ld19", "d300", "ldrobot"};

}  // namespace
}  // namespace ld06

const DriverEntry kLd06Entry = {
    .name = "ld06",
    .folder = "ld06",
    .options = ld06::option_table(),
    .kind = SlotKind::scanner,
    .wire = Wire::bytes,
    .bauds = ld06::kBauds,
    .make = ld06::make,
    .twin_options = {},
    .make_twin = ld06::make_twin,
    .summary = "LD06 and LD19, scanners of one level plane, 10 turns a second",
    .products = ld06::kLd06Products,
};

}  // namespace drover
