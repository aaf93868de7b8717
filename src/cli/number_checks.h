// What a number on the command line may be. The library takes hexadecimals and octals, "nan" for a
// speed and the largest number for one that is larger: what drives the robot is a plain number.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>

namespace drover::cli {

/// Decimal, finite, and from `least` to `most` where these are finite.
CLI::Validator plain_number(double least = -HUGE_VAL, double most = HUGE_VAL);
/// Decimal digits; "010" is ten, for which it has to be given to transform(): check() changes
/// nothing.
CLI::Validator whole_number(std::int64_t least, std::int64_t most);

}  // namespace drover::cli
