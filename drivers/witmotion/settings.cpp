// Which settings of the device an operator's options mean.
#include <algorithm>
#include <stdexcept>
#include <string>

#include "drivers/witmotion/framer.h"
#include "drivers/witmotion/setup.h"
#include "drover/baud.h"

namespace drover::witmotion {
namespace {

constexpr double kFullestLine = 0.9;  // of the line's capacity

bool is_combined(const Options& options) {
  return options.text("protocol") == "combined";
}

std::uint16_t wanted_content(const Options& options) {
  // Frames of 20 bytes hold these three, whatever is asked.
  if (is_combined(options)) return kAcceleration | kAngularRate | kAngles;
  unsigned content = kAcceleration | kAngularRate;
  if (options.text("orientation") == "angles") content |= kAngles;
  if (options.text("orientation") == "quaternion") content |= kQuaternion;
  if (options.flag("magnetic_field")) content |= kMagneticField;
  return static_cast<std::uint16_t>(content);
}

int bits_in(std::uint16_t content) {
  int count = 0;
  for (unsigned bit = 0; bit < 16; ++bit) count += (content >> bit) & 1U;
  return count;
}

std::string text_of(double number) {
  auto text = std::to_string(number);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

/// The line cannot carry what is wanted: which speed can, and how much this one does.
std::string too_slow(const Options& options, double needed_baud) {
  const double baud = options.number("baud");
  const double wanted_Hz = options.number("rate_Hz");
  double fits_Hz = 0;
  for (std::uint16_t code = 1; const auto each_Hz = rate_Hz(code); ++code)
    if (*each_Hz * needed_baud <= wanted_Hz * baud) fits_Hz = *each_Hz;
  // The fastest carries all that can be wanted.
  const auto* const carries =
      std::lower_bound(kSerialBauds.begin(), kSerialBauds.end() - 1, needed_baud);
  const bool sets_it = options.flag("configure") && !is_combined(options);
  return "baud is " + text_of(baud) + ", but rate_Hz " + text_of(wanted_Hz) + " needs " +
         std::to_string(*carries) + " or more: " +
         (sets_it ? "droverd sets the sensor to the speed that stands here"
                  : "set the sensor to it, too") +
         "; or a rate_Hz of " + text_of(fits_Hz) + " and less";
}

}  // namespace

Settings wanted_settings(const Options& options) {
  const double wanted_Hz = options.number("rate_Hz");
  const auto rate = rate_code(wanted_Hz);
  if (!rate)
    throw std::runtime_error("rate_Hz must be one of 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 125, 200");
  const auto baud = baud_code(static_cast<std::uint32_t>(options.number("baud")));
  if (!baud) throw std::runtime_error("baud is no speed that the device has");
  const std::uint16_t content = wanted_content(options);
  const double bytes = is_combined(options) ? static_cast<double>(kCombinedFrameSize)
                                            : static_cast<double>(kFrameSize) * bits_in(content);
  const double needed_baud = bytes * kBitsPerByte * wanted_Hz / kFullestLine;
  if (needed_baud > options.number("baud"))
    throw std::runtime_error(too_slow(options, needed_baud));
  const double bandwidth_Hz = options.number("bandwidth_Hz");
  const auto algorithm =
      options.flag("use_magnetic_yaw") ? Algorithm::nine_axis : Algorithm::six_axis;
  return {content, *rate, *baud, bandwidth_code(bandwidth_Hz > 0 ? bandwidth_Hz : wanted_Hz),
          static_cast<std::uint16_t>(algorithm)};
}

}  // namespace drover::witmotion
