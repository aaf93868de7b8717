#include "sim/scenario/waits.h"

#include <array>
#include <cstdio>

namespace drover::sim {

std::string Waits::look(Time now, const RobotReport& report) {
  const bool waited = !waits_.empty() && waits_.back().end == kNever;
  if (report.waits()) {
    if (!waited) waits_.push_back({now, kNever, {}});
    if (waits_.back().why.empty()) waits_.back().why = report.why();
    return waited ? "" : "the robot waits: " + waits_.back().why;
  }
  if (!waited) return {};
  waits_.back().end = now;
  // It may have been told to end instead.
  const bool goes_on = report.nav_status() == "NAV_RUN" || report.nav_status() == "NAV_SUCCESS";
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "the robot %s after %.1f s",
                goes_on ? "goes on" : "waits no more", to_s(now - waits_.back().begin));
  return text.data();
}

}  // namespace drover::sim
