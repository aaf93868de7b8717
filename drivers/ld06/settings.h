// Options of the LD06 driver, read and checked.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "drover/fixed_vector.h"
#include "drover/options.h"
#include "drover/scan.h"

namespace drover::ld06 {

/// A point of the robot's outline, in base_link.
struct Corner {
  double x_m = 0;
  double y_m = 0;
};
/// What is inside is the robot itself; empty: nothing is.
using Outline = FixedVector<Corner, 16>;

struct Settings {
  ScanMount mount;
  bool upside_down = false;
  double range_min_m = 0.05;
  double range_max_m = 12;
  Outline self_filter;
  std::size_t sectors = 24;
  double least_share = 0.5;
  Duration stale = std::chrono::milliseconds(400);
  double baud = 230400;
};

/// The option table, for the configuration's reader.
std::span<const OptionSpec> option_table();

/// Throws std::runtime_error that begins with the option's name; only at start-up.
Settings read_settings(const Options& options);

/// "x y, x y, ...", metres; empty: no outline. Throws as above, as `name`.
Outline parse_outline(std::string_view name, std::string_view text);

}  // namespace drover::ld06
