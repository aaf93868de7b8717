#include "scene/sensor/seen.h"

#include <algorithm>

namespace drover::scene::sensor {
namespace {

void say(Reason& into, const Name& device, std::string_view what) {
  const auto name = device.view();
  into.format("%.*s: %.*s", static_cast<int>(name.size()), name.data(),
              static_cast<int>(what.size()), what.data());
}

/// Empty: its latest turn is of the present, and the scanner is well.
Reason why_not_well(const ScanSeen& seen, Time now) {
  Reason why;
  if (seen.state != SourceState::fresh) {
    say(why, seen.device, seen.reason.empty() ? "the scanner is not heard" : seen.reason.view());
  } else if (seen.end == kNever) {
    say(why, seen.device, "no turn of the scanner yet");
  } else if (!(now - seen.end <= kOldestTurn)) {
    Reason age;
    age.format("no turn of the scanner for %.1f s", to_s(now - seen.end));
    say(why, seen.device, age);
  }
  return why;
}

void add(FieldView& all, const ScanSeen& seen) {
  all.since = all.since == kNever ? seen.begin : std::min(all.since, seen.begin);
  if (!seen.field.blocked) return;
  all.field.points += seen.field.points;
  if (all.field.blocked && all.field.free_m <= seen.field.free_m) return;
  all.field.blocked = true;
  all.field.nearest = seen.field.nearest;
  all.field.free_m = seen.field.free_m;
  all.scanner = seen.device;
}

}  // namespace

FieldView view(std::span<const ScanSeen> scanners, Time now) {
  FieldView all;
  if (scanners.empty()) {
    all.unknown = "there is no scanner";
    return all;
  }
  all.field.free_m = scanners.front().field.free_m;
  bool seen_whole = false;
  Reason hidden;
  for (const ScanSeen& seen : scanners) {
    const Reason why = why_not_well(seen, now);
    if (!why.empty()) {
      if (all.unknown.empty()) all.unknown = why;
      continue;
    }
    add(all, seen);
    seen_whole = seen_whole || !seen.field.unknown;
    if (!seen.field.unknown || !hidden.empty()) continue;
    say(hidden, seen.device,
        seen.reason.empty() ? "part of the field ahead is hidden from it" : seen.reason.view());
  }
  if (all.unknown.empty() && !seen_whole) all.unknown = hidden;
  all.field.unknown = !all.unknown.empty();
  return all;
}

}  // namespace drover::scene::sensor
