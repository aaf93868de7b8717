// What a person may accept by name, and what is told of until somebody does.
#include <algorithm>
#include <cmath>

#include "config/check_subjects.h"
#include "text/number.h"
#include "text/suggestion.h"

namespace drover::config {
namespace {

const std::vector<std::string> kOfADrive{"no_watchdog"};
const std::vector<std::string> kAtTheTop{"no_estop",      "slow_guard",
                                         "no_tilt",       "no_soc",
                                         "no_relay",      "short_look",
                                         "slow_chassis",  "far_antenna",
                                         "slow_watchdog", "no_guard",
                                         "falls",         "no_first_way",
                                         "late_silence",  "estop_not_fail_safe",
                                         "remote_broker", "lets_fall",
                                         "rolls",         "early_time_out",
                                         "swings",        "mixed_bus"};

bool is_one_of(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// `elsewhere` are words of the other list, which stands at `there`.
void known_words(const std::string& path, const std::vector<std::string>& words,
                 const std::vector<std::string>& known, const std::vector<std::string>& elsewhere,
                 const std::string& there, Findings& found) {
  for (const auto& word : words) {
    if (is_one_of(known, word)) continue;
    if (is_one_of(elsewhere, word))
      found.add(path, "\"" + word + "\" is not accepted here",
                "write it into the \"accept\" " + there);
    else
      found.add(path, "nothing of the name \"" + word + "\" can be accepted here",
                text::did_you_mean(word, known));
  }
}

/// What only a relay in its supply stops when its line is cut.
void warn_of_what_goes_on(Findings& found) {
  const auto& devices = found.config().devices;
  const auto goes_on = [](const auto& device) { return device.goes_on_in_silence; };
  const auto first = std::find_if(devices.begin(), devices.end(), goes_on);
  const auto others = std::count_if(devices.begin(), devices.end(), goes_on) - 1;
  const std::string so_do_others = others == 0 ? ""
                                   : others == 1
                                       ? ", and so does 1 other"
                                       : ", and so do " + std::to_string(others) + " others";
  found.warn(device_path(*first, "accept"),
             "it goes on for ever when its line is cut" + so_do_others +
                 "; there is no outputs.enable_relay, so nothing of this gateway stops it then",
             "no_relay", "an enable_relay in its supply");
}

void warn_of_no_relay(Findings& found) {
  const auto& config = found.config();
  if (config.outputs.output[static_cast<std::size_t>(Output::enable_relay)].configured) return;
  const auto& devices = config.devices;
  if (std::any_of(devices.begin(), devices.end(),
                  [](const auto& device) { return device.goes_on_in_silence; }))
    return warn_of_what_goes_on(found);
  if (config.engine.base.hold == engine::HoldBy::level_ground_only)
    found.warn("groups.base.hold",
               "where a stop does not work the drives let go and then the enable relay opens, but "
               "there is no outputs.enable_relay: drives that do not listen keep their power",
               "no_relay", "an enable_relay in their supply");
}

/// Nothing else ends it when its cable is torn.
void warn_of_slow_watchdogs(Findings& found) {
  constexpr int kSlow_ms = 1000;
  for (const auto& device : found.config().devices) {
    if (device.stops_after_ms <= kSlow_ms) continue;
    found.warn(device_path(device, "options"),
               "it goes on for " + text::number_text(device.stops_after_ms / 1000.0) +
                   " s when its line is cut; up to 1 s is usual",
               "slow_watchdog", "a shorter time-out of its own");
  }
}

/// What holds the line at "released" with the wire off is not the button.
void warn_of_open_estop(Findings& found) {
  for (const auto& device : found.config().devices) {
    if (device.kind != SlotKind::line || line_of(device) != Line::estop) continue;
    if (!device.options.has("active_level") || device.options.text("active_level") == "low")
      continue;
    found.warn(device_path(device, "options.active_level"),
               "is high: when its wire breaks it reads as released, and the button stops nothing",
               "estop_not_fail_safe",
               "a normally closed contact that feeds the line high, and \"low\"");
  }
}

void warn_of_no_first_way(Findings& found) {
  if (found.config().engine.navigate.first_way_m > 0 || found.has_problem("navigate")) return;
  found.warn(
      "navigate.first_way_m",
      "is 0: nothing looks whether wheels, gyro and receiver agree before it drives fast, so "
      "a wrong unit, gear or side is not noticed",
      "no_first_way", "0.3 is usual");
}

/// Whichever is shorter acts: the driver's own, or the one of all drives.
void warn_of_late_silence(Findings& found) {
  constexpr double kLate_s = 0.5;
  const double all_s = found.config().engine.health.drive_stale_s;
  for (const auto& device : found.config().devices) {
    if (device.kind != SlotKind::drive || !device.options.has("stale_s")) continue;
    const double own_s = device.options.number("stale_s");
    if (std::min(all_s, own_s) <= kLate_s) continue;
    return found.warn("health.drive_stale_s",
                      "is " + text::number_text(all_s) + ", and " +
                          device_path(device, "options.stale_s") + " is " +
                          text::number_text(own_s) + ": the robot drives on for " +
                          text::number_text(std::min(all_s, own_s)) +
                          " s when the drive is silent; up to 0.5 s is usual",
                      "late_silence", "a shorter one of the two");
  }
}

/// Where the ground is steeper than the robot may be tilted, that it is tilted stops it first.
void warn_of_idle_tilt(Findings& found) {
  const auto& engine = found.config().engine;
  const double limit_deg = engine.health.tilt_limit_deg;
  if (engine.base.hold != engine::HoldBy::level_ground_only) return;
  if (engine.base.max_tilt_deg <= limit_deg) return;
  found.hint_at("groups.base.max_tilt_deg",
                "is " + text::number_text(engine.base.max_tilt_deg) +
                    ", but health.tilt_limit_deg stops the robot at " +
                    text::number_text(limit_deg) + " already",
                text::number_text(limit_deg) + " or less");
}

/// In centimetres, say.
void warn_of_far_antenna(Findings& found) {
  const auto& config = found.config();
  constexpr double kLeast_m = 1;
  constexpr double kTracks = 3;
  const auto& antenna = config.engine.estimate;
  const double away_m = std::hypot(antenna.antenna_x_m, antenna.antenna_y_m);
  const double track_m = config.engine.base.track_m;
  if (found.has_problem("estimate") || found.has_problem("groups")) return;
  if (away_m <= std::max(kLeast_m, kTracks * track_m)) return;
  found.warn("estimate",
             "the antenna is " + text::number_text(std::round(away_m * 100) / 100) +
                 " m from base_link, on a base whose track is " + text::number_text(track_m) + " m",
             "far_antenna", "antenna_x_m and antenna_y_m in metres");
}

}  // namespace

void check_accepted(Findings& found) {
  for (const auto& device : found.config().devices)
    known_words(device_path(device, "accept"), device.accept, kOfADrive, kAtTheTop,
                "at the top of the file", found);
  known_words("accept", found.config().accept, kAtTheTop, kOfADrive, "of the drive", found);
}

void warn_of_risks(Findings& found) {
  const auto& devices = found.config().devices;
  // One that is misspelt may be what is missed.
  const bool all_known = std::all_of(devices.begin(), devices.end(), [&](const auto& device) {
    return find_driver(device.driver) != nullptr && !found.has_problem(device_path(device, "is"));
  });
  if (all_known && !found.config().engine.line_configured[static_cast<std::size_t>(Line::estop)])
    found.warn("devices",
               "there is no e-stop line: only the broker and the command line can stop it",
               "no_estop");
  warn_of_open_estop(found);
  const bool has_imu = std::any_of(devices.begin(), devices.end(),
                                   [](const auto& device) { return device.kind == SlotKind::imu; });
  if (all_known && !has_imu && found.config().engine.base.hold == engine::HoldBy::level_ground_only)
    found.warn("groups.base.hold",
               "without an inertial sensor nothing tells how steep the ground is: max_tilt_deg "
               "stops nothing",
               "no_tilt");
  warn_of_no_relay(found);
  for (const auto& device : devices) {
    const auto& fields = device.registers.fields;
    const bool has_charge = std::any_of(fields.begin(), fields.end(), [](const auto& field) {
      return field.field == BatteryField::soc_percent;
    });
    if (!fields.empty() && !has_charge)
      found.warn(device_path(device, "map"),
                 "tells no soc: an empty battery is not noticed, and no task ends for it",
                 "no_soc");
  }
  if (!found.config().guard.required)
    found.warn("guard.required",
               "is false: the robot drives without drover-guard, and nothing stops it then when "
               "droverd dies or hangs but the drives' own time-outs",
               "no_guard", "true");
  constexpr int kSlowGuard_ms = 200;
  if (found.config().guard.limit_ms > kSlowGuard_ms)
    found.warn("guard.limit_ms",
               "the wheels go on for " + std::to_string(found.config().guard.limit_ms) +
                   " ms when droverd dies; up to 200 ms is usual",
               "slow_guard");
  warn_of_slow_watchdogs(found);
  warn_of_no_first_way(found);
  warn_of_late_silence(found);
  warn_of_idle_tilt(found);
  warn_of_far_antenna(found);
  warn_of_slow_chassis(found);
  warn_of_short_look(found);
  warn_of_short_field(found);
}

}  // namespace drover::config
