// The short straight way that shows a receiver with one antenna where the robot is heading.
#include "engine/own/heading_creep.h"

#include <cmath>

namespace drover::engine {
namespace {

constexpr double kLag_s = 0.2;

}  // namespace

double HeadingCreep::timeout_s() const {
  return config_.start_timeout_s +
         3 * config_.find_heading_distance_m / config_.find_heading_speed_mps;
}

void HeadingCreep::start(const RequestId& id, std::string_view hindrance, const Estimate& estimate,
                         const HealthReport& health, Time now, EventQueue& events) {
  const auto refuse = [&](const Reason& why) { events.push(now, CommandRefused{id, why}); };
  if (active_) return refuse("the heading is being looked for already");
  if (!hindrance.empty()) return refuse(hindrance);
  if (knows_heading(estimate)) return refuse("the heading is known already");
  if (!health.gnss_ok) return refuse("the receiver gives no position");
  if (!estimate.has_position) return refuse("there is no position yet");
  if (!(estimate.predicted_error_m <= config_.find_heading_distance_m / 2)) {
    return refuse("the position is too uncertain to show a heading");
  }
  active_ = true;
  failed_.clear();
  began_ = now;
  driven_m_ = 0;
  drives_.begin();
  Reason note;
  note.format("drives at most %.1f m straight ahead", config_.find_heading_distance_m);
  events.push(now, CommandAccepted{id, note});
}

void HeadingCreep::end(std::string_view why, Time now, EventQueue& events) {
  if (!active_) return;
  active_ = false;
  failed_.format("no heading: %.*s", static_cast<int>(why.size()), why.data());
  events.notice(now, Notice::Level::warning, failed_);
}

Twist HeadingCreep::step(Time now, Duration dt, const Estimate& estimate,
                         const HealthReport& health, EventQueue& events) {
  lost_ = false;
  const bool known = knows_heading(estimate);
  if (known) failed_.clear();
  if (!active_) return {};
  if (known) {
    active_ = false;
    Reason text;
    text.format("heading found after %.1f m", driven_m_);
    events.notice(now, Notice::Level::info, text);
    return {};
  }
  if (health.near_zone) {
    end(health.obstacle(), now, events);
    return {};
  }
  for (const Cause cause : {Cause::constraint, Cause::surroundings}) {
    if (!health.holds(cause)) continue;
    end(health.text(cause), now, events);
    return {};
  }
  const bool late = now - began_ > from_s(config_.start_timeout_s);
  const Drives drives = drives_.look(health.drives_running, late);
  switch (drives) {
    case Drives::armed: break;
    case Drives::asked:
    case Drives::arming: return {};
    case Drives::late:
    case Drives::lost:
      lost_ = drives == Drives::lost;
      end(health.not_running, now, events);
      return {};
  }
  driven_m_ += std::abs(estimate.body.twist.vx_mps) * to_s(dt);
  // The way that the ramp to zero takes, and what drives lag behind it, count as well.
  const double vx_mps = std::abs(estimate.body.twist.vx_mps);
  const double rolls_on_m = vx_mps * vx_mps / (2 * deceleration_mps2_) + vx_mps * kLag_s;
  if (driven_m_ + rolls_on_m > config_.find_heading_distance_m) {
    end("the way did not show it", now, events);
  } else if (now - began_ > from_s(timeout_s())) {
    end("the robot did not move", now, events);
  }
  return active_ ? Twist{config_.find_heading_speed_mps, 0} : Twist{};
}

}  // namespace drover::engine
