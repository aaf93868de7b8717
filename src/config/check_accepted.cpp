// What a person may accept by name, and what is told of until somebody does.
#include <algorithm>

#include "config/check_subjects.h"
#include "text/suggestion.h"

namespace drover::config {
namespace {

void known_words(const std::string& path, const std::vector<std::string>& words,
                 const std::vector<std::string>& known, Findings& found) {
  for (const auto& word : words)
    if (std::find(known.begin(), known.end(), word) == known.end())
      found.add(path, "nothing of the name \"" + word + "\" can be accepted here",
                text::did_you_mean(word, known));
}

}  // namespace

void check_accepted(Findings& found) {
  for (const auto& device : found.config().devices)
    known_words(device_path(device, "accept"), device.accept, {"no_watchdog"}, found);
  known_words("accept", found.config().accept, {"no_estop", "slow_guard", "no_tilt", "no_soc"},
              found);
}

void warn_of_risks(Findings& found) {
  if (!found.config().engine.line_configured[static_cast<std::size_t>(Line::estop)])
    found.warn("devices",
               "there is no e-stop line: only the broker and the command line can stop it",
               "no_estop");
  const auto& devices = found.config().devices;
  const bool has_imu = std::any_of(devices.begin(), devices.end(),
                                   [](const auto& device) { return device.kind == SlotKind::imu; });
  if (!has_imu && found.config().engine.base.hold == engine::HoldBy::level_ground_only)
    found.warn("groups.base.hold",
               "without an inertial sensor nothing tells how steep the ground is: max_tilt_deg "
               "stops nothing",
               "no_tilt");
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
  constexpr int kSlowGuard_ms = 200;
  if (found.config().guard.limit_ms > kSlowGuard_ms)
    found.warn("guard.limit_ms",
               "the wheels go on for " + std::to_string(found.config().guard.limit_ms) +
                   " ms when droverd dies; up to 200 ms is usual",
               "slow_guard");
}

}  // namespace drover::config
