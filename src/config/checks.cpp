#include "config/checks.h"

#include "config/check_subjects.h"

namespace drover::config {
namespace {

/// The engine's own copies of what other sections say.
void finish_engine(DroverConfig& c) {
  c.engine.tick_Hz = c.control.tick_Hz;
  c.engine.health.guard_required = c.guard.required;
  c.engine.battery_configured = c.battery.configured;
  for (const auto& drive : c.drives) (void)c.engine.joints.push_back(Name(drive.joint));
  for (std::size_t i = 0; i < kLineCount; ++i)
    c.engine.line_configured[i] = c.lines.line[i].configured;
  for (std::size_t i = 0; i < kOutputCount; ++i)
    c.engine.output_configured[i] = c.outputs.output[i].configured;
}

}  // namespace

void check_and_resolve(const json::Node& root, const BaseNames& base, const std::string& folder,
                       Loaded& loaded) {
  Findings found(root, loaded);
  check_drive_names(found);
  check_base(base, found);
  check_lines(found);
  check_limits(found);
  check_broker(found);
  check_channel(found);
  check_battery(folder, found);
  follow_baud_rates(found);
  finish_engine(loaded.config);
  check_drivers(found);  // with the options as they are by now
  check_ports(found);
  check_accepted(found);
  warn_of_risks(found);
}

}  // namespace drover::config
