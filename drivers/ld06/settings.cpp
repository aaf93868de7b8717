#include "drivers/ld06/settings.h"

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>

#include "drivers/checked_options.h"
#include "drover/angle.h"

namespace drover::ld06 {
namespace {

// Where it is has no default: what is seen from a place where it is not is seen beside the robot,
// and it drives into what stands ahead.
const OptionSpec kOptions[] = {
    {.name = "mount_x_m",
     .default_value = 0.0,
     .required = true,
     .min = -10.0,
     .max = 10.0,
     .text = "the sensor's place in base_link, ahead (m)"},
    {.name = "mount_y_m",
     .default_value = 0.0,
     .required = true,
     .min = -10.0,
     .max = 10.0,
     .text = "the same, to the left (m)"},
    {.name = "mount_z_m",
     .default_value = 0.2,
     .required = true,
     .min = 0.0,
     .max = 5.0,
     .text = "its beams above the ground (m): a ramp of 15 % is an obstacle this height "
             "divided by 0.15 beyond its foot"},
    {.name = "mount_yaw_deg",
     .default_value = 0.0,
     .required = true,
     .min = -180.0,
     .max = 180.0,
     .text = "from ahead to the sensor's 0 degrees, counter-clockwise seen from above"},
    {.name = "upside_down",
     .default_value = false,
     .text = "it hangs: its angles count counter-clockwise seen from above"},
    {.name = "range_min_m",
     .default_value = 0.05,
     .min = 0.02,
     .max = 1.0,
     .text = "nearer is the lens or its dirt (m)"},
    {.name = "range_max_m",
     .default_value = 12.0,
     .min = 0.5,
     .max = 12.0,
     .text = "farther is not told (m)"},
    {.name = "self_filter",
     .default_value = std::string(),
     .text = "outline of the robot in base_link, 3 to 16 corners as \"x y, x y, x y\" (m): points "
             "inside are the robot itself. Counted, for dirt on the lens lies there too"},
    {.name = "sectors",
     .default_value = 24.0,
     .min = 8.0,
     .max = static_cast<double>(kMaxScanSectors),
     .integer = true,
     .text = "parts of the turn that are judged each for itself; fewer than 18 beams in each say "
             "little"},
    {.name = "least_share",
     .default_value = 0.5,
     .min = 0.0,
     .max = 1.0,
     .text =
         "of the beams of a sector that have to come back for it to count as seen, whatever "
         "was learned. With less it may not be noticed that the sun blinds it; in the open, with "
         "nothing within reach, it does not make the robot go"},
    {.name = "stale_s",
     .default_value = 0.4,
     .min = 0.15,
     .max = 5.0,
     .text = "without a good turn for longer the scanner is stale (s); four turns"},
    {.name = "baud",
     .default_value = 230400.0,
     .min = 4800.0,
     .max = 921600.0,
     .integer = true,
     .text = "pace of the line (bit/s), as the link is opened with; the device knows one"},
};

constexpr double kFarthestCorner_m = 10;
constexpr double kLeastArea_m2 = 1e-4;

[[noreturn]] void refuse(std::string_view name, const std::string& why) {
  throw std::runtime_error(std::string(name) + ": " + why);
}

double area_m2(const Outline& outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Corner& a = outline[i];
    const Corner& b = outline[(i + 1) % outline.size()];
    twice += a.x_m * b.y_m - b.x_m * a.y_m;
  }
  return std::abs(twice) / 2;
}

/// Takes a number, and the white space around it, from the front of `text`.
double take_number(std::string_view name, std::string_view& text, std::size_t corner) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc{} || !(std::abs(value) <= kFarthestCorner_m))
    refuse(name, "corner " + std::to_string(corner) +
                     ": two numbers between -10 and 10 (m) with a space between are expected");
  text.remove_prefix(static_cast<std::size_t>(result.ptr - text.data()));
  while (text.starts_with(' ')) text.remove_prefix(1);
  return value;
}

}  // namespace

std::span<const OptionSpec> option_table() {
  return kOptions;
}

Outline parse_outline(std::string_view name, std::string_view text) {
  Outline outline;
  if (text.find_first_not_of(' ') == std::string_view::npos) return outline;
  while (true) {
    const std::size_t corner = outline.size() + 1;
    const double x_m = take_number(name, text, corner);
    const double y_m = take_number(name, text, corner);
    if (!outline.push_back({x_m, y_m})) refuse(name, "more than 16 corners");
    if (text.empty()) break;
    if (!text.starts_with(','))
      refuse(name, "corner " + std::to_string(corner) + ": a comma is expected behind it");
    text.remove_prefix(1);
  }
  if (outline.size() < 3) refuse(name, "fewer than 3 corners");
  if (area_m2(outline) < kLeastArea_m2) refuse(name, "the outline has no area");
  return outline;
}

Settings read_settings(const Options& options) {
  const CheckedOptions checked(options, kOptions);
  Settings settings;
  settings.mount = {checked.number("mount_x_m"), checked.number("mount_y_m"),
                    checked.number("mount_z_m"), to_rad(checked.number("mount_yaw_deg"))};
  settings.upside_down = options.flag("upside_down");
  settings.range_min_m = checked.number("range_min_m");
  settings.range_max_m = checked.number("range_max_m");
  if (settings.range_min_m >= settings.range_max_m)
    refuse("range_min_m", "is not below range_max_m");
  settings.self_filter = parse_outline("self_filter", checked.text("self_filter"));
  settings.sectors = static_cast<std::size_t>(checked.number("sectors"));
  settings.least_share = checked.number("least_share");
  settings.stale = checked.seconds("stale_s");
  settings.baud = checked.number("baud");
  return settings;
}

}  // namespace drover::ld06
