#include "runtime/scene_loop.h"

#include <cerrno>
#include <ctime>

#include <algorithm>
#include <utility>

#include "runtime/clock.h"
#include "runtime/log.h"
#include "runtime/realtime.h"
#include "runtime/scene_settings.h"

namespace drover::runtime {

namespace {

using namespace std::chrono_literals;

constexpr Duration kLeastRest = 5ms;

/// Below the control thread, which never waits for this one.
int priority_below(int control) {
  return std::max(1, control - 10);
}

void sleep_until(Time when) {
  const auto since = when.time_since_epoch();
  const timespec at{static_cast<time_t>(since / 1s), static_cast<long>((since % 1s).count())};
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr) == EINTR) {
  }
}

}  // namespace

SceneLoop::SceneLoop(const config::DroverConfig& config, SceneExchange& exchange,
                     std::shared_ptr<const store::StoredScene> stored,
                     std::span<const std::unique_ptr<ScanLink>> scanners)
    : control_(config.control),
      exchange_(exchange),
      scanners_(scanners),
      work_(keeper_settings(config), exchange, std::move(stored)),
      late_(from_s(config.engine.clearance.max_age_s), from_s(config.engine.clearance.silent_s)) {}

void SceneLoop::run(const std::atomic<bool>& stop) {
  if (control_.realtime)
    if (const auto missing = become_real_time(priority_below(control_.priority)); !missing.empty())
      log(LogLevel::warning, "scene: " + missing);
  Time next = monotonic_now();
  while (!stop.load(std::memory_order_relaxed)) {
    turn();
    turns_.fetch_add(1, std::memory_order_relaxed);
    // Turns that were missed are not made up for, and who is late all the time leaves some to
    // others.
    next = std::max(next + kPeriod, monotonic_now() + kLeastRest);
    sleep_until(next);
  }
}

/// Jobs before the look, so that it tells of what came a moment ago, and both by the newest pose.
/// What is answered is in force by then. Looks along tracks last: whoever waits for a start waits a
/// little longer, and the robot for nothing.
void SceneLoop::turn() {
  const auto until = [](Time end) { return [end] { return monotonic_now() < end; }; };
  (void)see();
  work_.work(until(monotonic_now() + kWork));
  if (see()) look();
  work_.send_replies();
  work_.check(until(monotonic_now() + kChecks));
  work_.send_replies();
}

void SceneLoop::look() {
  look_at_scanners();
  auto& found = exchange_.sight.clearance.back();
  found.clearance = work_.look();
  late_.note(found.clearance.t, monotonic_now());
  if (found.clearance.unknown.empty())
    found.clearance.unknown = late_.words(work_.objects(), work_.constraints());
  found.number = ++found_;
  exchange_.sight.clearance.publish();
}

/// What they said last, if that is still true.
void SceneLoop::look_at_scanners() {
  if (scanners_.empty()) return;
  FixedVector<scene::sensor::ScanSeen, kMaxOfKind> seen;
  for (std::size_t i = 0; i < scanners_.size(); ++i) {
    (void)seen.push_back(scanners_[i]->exchange.seen.latest());
    work_.see_turn(static_cast<std::uint8_t>(i), scanners_[i]->exchange.turn.latest());
  }
  work_.set_sensors(scene::sensor::view({seen.data(), seen.size()}, monotonic_now()));
}

/// False: there was no first cycle yet.
bool SceneLoop::see() {
  const Viewpoint& from = exchange_.sight.viewpoint.latest();
  if (from.t == kNever) return false;
  work_.see(from);
  return true;
}

}  // namespace drover::runtime
