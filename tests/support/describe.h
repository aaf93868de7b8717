// Measurements as one line of text each: for golden files and for messages of failing tests.
#pragma once

#include <string>
#include <string_view>

#include "drover/driver.h"

namespace drover::test {

/// `axis_motion axis=0 position_rad=78.5398 velocity_radps=-20.4204`: fields in the order of the
/// struct, absent ones left out, six significant digits (latitude and longitude: ten decimals),
/// texts in double quotes. Times are not part of it.
std::string describe(const Measurement& measurement, const Reason& words = {});
/// All of them, separated by "; "; "nothing" when there are none. With the words of `device`, which
/// said it in the last call.
std::string describe(const DriverOut& out, const Device& device);
/// The same of one that has no words.
std::string describe(const DriverOut& out);
/// candump's notation: `069#00004841000050C0`, `00012345#`, `074#R`.
std::string describe(const CanFrame& frame);
/// The same backwards; throws std::invalid_argument.
CanFrame parse_frame(std::string_view text);

}  // namespace drover::test
