// The task's life: free, starting, running, paused, ended; and what is answered to whom.
#include "engine/navigate/navigator.h"

#include <algorithm>
#include <cmath>

#include "engine/navigate/navigator_checks.h"
#include "engine/still.h"
#include "track/path_search.h"

namespace drover::engine {
namespace {

constexpr double kGoalNear_m = 0.5;  // the arrival time-out runs inside this
// Shoved so far beside its track it goes back to it slowly, until it is so near.
constexpr double kAside_m = 0.10;
constexpr double kBack_m = 0.05;
constexpr double kBackToTrack_mps = 0.2;
constexpr Duration kShovedOfLate = std::chrono::seconds(2);
constexpr Duration kReturnsWithin = std::chrono::seconds(20);
constexpr double kSlowFrom = 0.5;  // share of the error budget from which on it slows
constexpr double kSlowest = 0.5;   // share of the speed that is left when the budget is spent

unsigned long long as_counted(std::uint32_t target) {
  return static_cast<unsigned long long>(target) + 1;
}

/// Nothing goes on from another place than it stopped at.
Reason find_health_failure(const HealthReport& health) {
  return health.end_task.empty() ? health.end_wait : health.end_task;
}

}  // namespace

Navigator::Navigator(const EngineConfig& config, Latch& latch)
    : config_(config),
      latch_(latch),
      body_(limits(kinematics_of(config.base))),
      tracker_(config.navigate, config.limits, body_),
      waits_(config) {}

void Navigator::start(const RequestId& id, const StartTask& task, Time now,
                      const Estimate& estimate, bool has_origin, const HealthReport& health,
                      EventQueue& events) {
  const auto refuse = [&](const Reason& reason) {
    events.push(now, CommandRefused{id, reason});
    if (task.path != nullptr) events.push(now, PathReleased{task.path});
  };
  if (active()) return refuse("a task runs already");
  if (task.path == nullptr) return refuse("there is no such track");
  if (const Reason why = check_path(*task.path, task.target); !why.empty()) return refuse(why);
  const SpeedCheck speed = check_speed(task.speed_mps, config_.limits);
  if (!speed.refusal.empty()) return refuse(speed.refusal);
  if (const Reason why = latch_.hinders_all(); !why.empty()) return refuse(why);
  if (const Reason why = check_robot(health, has_origin); !why.empty()) return refuse(why);
  const Pose& pose = estimate.pose;
  const auto target = static_cast<std::uint32_t>(
      track::target_ahead(task.path->points, task.target, {pose.x_m, pose.y_m}, pose.yaw_rad,
                          track::gears_of(*task.path)));
  tracker_.begin(*task.path, target, speed.speed_mps, pose);
  progress_ = tracker_.locate(pose);
  // The first point of a loop is reached by who stands there, whichever leg he would leave it by.
  const bool at_first = target == 0 && track::is_closed(task.path->points) &&
                        progress_.distance_to_goal_m <= config_.navigate.goal_tolerance_m;
  progress_.arrived = progress_.arrived || at_first;
  Reason why = check_place(*task.path, target, pose, progress_, config_.navigate);
  if (why.empty()) why = check_curves(*task.path, target, pose, config_.navigate, body_);
  if (why.empty()) why = check_joining(target, progress_, config_.navigate, body_);
  if (!why.empty()) {
    tracker_.end();
    return refuse(why);
  }
  events.push(now, CommandAccepted{id, speed.note});
  id_ = id;
  path_ = task.path;
  track_.assign(task.path->name);
  target_ = task.target;
  speed_mps_ = speed.speed_mps;
  accepted_ = now;
  goal_near_since_ = kNever;
  begun_ = stopping_at_goal_ = returns_ = false;
  drives_.begin();
  waits_.begin();
  latch_.reset(Act::begin);
  phase_ = Phase::starting;
  status_ = NavStatus::run;
  if (progress_.arrived && progress_.distance_to_goal_m <= config_.navigate.goal_tolerance_m) {
    end(now, TaskEnded::How::success, "the robot was there already", events);
  }
}

void Navigator::cancel(const RequestId& id, Time now, EventQueue& events) {
  events.push(now, CommandAccepted{id, {}});
  if (active()) {
    end(now, TaskEnded::How::cancelled, "cancelled", events);
  }
  status_ = NavStatus::free;
}

void Navigator::make_way() {
  if (active()) return;
  latch_.reset(Act::begin);
  status_ = NavStatus::free;
}

void Navigator::stop(Time now, EventQueue& events) {
  if (active()) fail(now, latch_.stop(), events);
}

void Navigator::end(Time now, TaskEnded::How how, const Reason& reason, EventQueue& events) {
  if (how == TaskEnded::How::success && !begun_) {
    begun_ = true;
    events.push(now, NavigationStarted{id_});
  }
  if (begun_) {
    events.push(now, TaskEnded{id_, how, reason});
  } else {
    events.push(now, NavigationNotStarted{id_, reason});
  }
  tracker_.end();
  events.push(now, PathReleased{path_});
  path_ = nullptr;
  phase_ = Phase::idle;
  switch (how) {
    case TaskEnded::How::success: status_ = NavStatus::success; break;
    case TaskEnded::How::cancelled: status_ = NavStatus::free; break;
    case TaskEnded::How::failed: status_ = NavStatus::error; break;
  }
}

Reason Navigator::waits_for(const HealthReport& health) const {
  Reason text;
  if (phase_ == Phase::paused && !waits_.outside().empty()) return waits_.outside();
  if (phase_ == Phase::paused && waits_.holds() && health.why.empty()) {
    text.format("goes on when nothing has held it up for %.1f s", config_.navigate.resume_after_s);
    return text;
  }
  if (status_ != NavStatus::error || !latch_.stop().empty() || !latch_.task().empty()) return text;
  text.format("waits for a new start; the task ended: %.*s", static_cast<int>(ended_.view().size()),
              ended_.view().data());
  return text;
}

void Navigator::fail(Time now, const Reason& reason, EventQueue& events) {
  ended_ = reason;
  latch_.set(Latched::task_failed, reason);
  end(now, TaskEnded::How::failed, reason, events);
}

/// What leaves no time for a ramp, and what no task survives.
bool Navigator::stop_at_once(const NavInput& input, EventQueue& events) {
  Reason why;
  const bool ran_away = input.wheels == WheelFault::runaway;
  if (!ran_away && !input.health.stop.empty()) {
    why = input.health.stop;
  } else if (ran_away || !latch_.stop().empty()) {
    why = latch_.stop();
  } else if (phase_ == Phase::running || phase_ == Phase::paused) {
    why = !input.health.drives_running ? input.health.not_running : input.wheel_reason;
  }
  if (why.empty()) return false;
  if (active()) fail(input.now, why, events);
  return true;
}

NavOutput Navigator::step(const NavInput& input, EventQueue& events) {
  if (stop_at_once(input, events)) return {{}, false, Stop::immediate};
  switch (phase_) {
    case Phase::idle: return {{}, false, Stop::controlled};
    case Phase::starting: return arm(input, events);
    case Phase::running:
    case Phase::paused: return run(input, events);
  }
  return {{}, false, Stop::immediate};
}

NavOutput Navigator::arm(const NavInput& input, EventQueue& events) {
  const bool late = input.now - accepted_ > from_s(config_.navigate.start_timeout_s);
  const Drives drives = drives_.look(input.health.drives_running, late);
  if (drives == Drives::asked) return {{}, true, Stop::controlled};
  if (const Reason why = find_health_failure(input.health); !why.empty()) {
    fail(input.now, why, events);
    return {{}, false, Stop::controlled};
  }
  if (drives == Drives::armed) {
    phase_ = Phase::running;
    return run(input, events);
  }
  if (drives == Drives::late) {
    fail(input.now, input.health.not_running, events);
    return {{}, false, Stop::immediate};
  }
  return {{}, true, Stop::controlled};
}

Reason Navigator::find_position_failure(const Estimate& estimate,
                                        const HealthReport& health) const {
  const Pose& pose = estimate.pose;
  if (estimate.has_position && !std::isfinite(pose.x_m + pose.y_m + pose.yaw_rad + pose.vx_mps)) {
    return "the position estimate is not a number";
  }
  if (estimate.disagrees && !estimate.disputed) {
    return estimate.reason.empty() ? Reason("position disagrees with odometry") : estimate.reason;
  }
  if (health.locate != LocateState::good) return {};  // a pause, not a failure
  Reason why = left_corridor(on_track(estimate));
  if (why.empty() && progress_.goal_passed && !progress_.arrived && !stopping_at_goal_)
    why.format("passed point %llu at %.2f m", as_counted(target_), progress_.distance_to_goal_m);
  return why;
}

Reason Navigator::find_failure(const NavInput& input) {
  const NavigateConfig& limits = config_.navigate;
  if (input.refusal == TargetRefusal::not_finite) return "the wanted speed was not a number";
  if (const Reason why = find_health_failure(input.health); !why.empty()) return why;
  if (const Reason why = find_position_failure(input.estimate, input.health); !why.empty()) {
    return why;
  }
  Reason why = waits_.too_long(input, on_track(input.estimate));
  if (why.empty() && goal_near_since_ != kNever &&
      input.now - goal_near_since_ > from_s(limits.arrival_timeout_s))
    why.format("did not arrive at point %llu within %.0f s", as_counted(target_),
               limits.arrival_timeout_s);
  return why;
}

/// Inside its tolerance of the goal it has no need to go on to where the place that was not
/// believed would be past the end.
bool Navigator::ends_short(const Estimate& estimate, bool located) const {
  const bool near = progress_.distance_left_m < kGoalNear_m &&
                    progress_.distance_to_goal_m <= config_.navigate.goal_tolerance_m;
  return near && located && begun_ && !waits_.for_constraint() &&
         !(unbelieved_m(on_track(estimate)) <= config_.navigate.corridor_m);
}

void Navigator::watch_pauses(const NavInput& input, EventQueue& events) {
  waits_.update(input, on_track(input.estimate));
  const bool wait = waits_.holds();
  if (wait && phase_ == Phase::running) {
    phase_ = Phase::paused;
    Reason text = "paused: ";
    text.append(waits_.why(input.health));
    events.notice(input.now, Notice::Level::warning, text);
  } else if (!wait && phase_ == Phase::paused) {
    phase_ = Phase::running;
    events.notice(input.now, Notice::Level::info, "goes on after a pause");
  }
}

void Navigator::settle_at_goal(const NavInput& input, EventQueue& events) {
  if (!input.at_rest ||
      std::hypot(input.estimate.pose.vx_mps, input.estimate.pose.vy_mps) > kStands_mps)
    return;
  Reason text;
  text.format("%.2f m from point %llu", progress_.distance_to_goal_m, as_counted(target_));
  if (progress_.distance_to_goal_m <= config_.navigate.goal_tolerance_m) {
    end(input.now, TaskEnded::How::success, text, events);
  } else if (progress_.goal_passed) {
    fail(input.now, text, events);
  } else {
    stopping_at_goal_ = false;  // short of it: goes on
  }
}

void Navigator::watch_shoves(const NavInput& input) {
  const double off_m = std::abs(progress_.cross_track_m);
  const Time shoved = input.estimate.shoved;
  const bool of_late = shoved != kNever && input.now - shoved < kShovedOfLate;
  // One that crabs along a slope may never come nearer.
  const bool long_ago = shoved == kNever || input.now - shoved > kReturnsWithin;
  returns_ =
      progress_.joined && (returns_ ? off_m > kBack_m && !long_ago : of_late && off_m > kAside_m);
}

double Navigator::speed_cap_mps(const NavInput& input) const {
  const HealthReport& health = input.health;
  double cap_mps = speed_mps_;
  if (returns_)
    cap_mps = std::min(cap_mps, std::max(kBackToTrack_mps, config_.limits.min_speed_mps));
  if (health.far_zone) cap_mps = std::min(cap_mps, config_.navigate.far_zone_speed_mps);
  const double over = (health.budget_used - kSlowFrom) / (1 - kSlowFrom);
  const double share = 1 - (1 - kSlowest) * std::clamp(over, 0.0, 1.0);
  cap_mps = std::min(cap_mps, std::max(share * speed_mps_, config_.limits.min_speed_mps));
  return std::min(cap_mps, input.speed_cap_mps);
}

/// At rest only, before what is in its way: where its track goes from here is looked at then, too.
Twist Navigator::asked(const NavInput& input) {
  if (waits_.for_place() || stopping_at_goal_) return {};
  return tracker_.follow(input.estimate.pose, progress_, speed_cap_mps(input), input.dt,
                         input.may_go_aside);
}

NavOutput Navigator::run(const NavInput& input, EventQueue& events) {
  const bool located = input.health.locate == LocateState::good;
  if (located) progress_ = tracker_.locate(input.estimate.pose);
  if (const Reason why = find_failure(input); !why.empty()) {
    fail(input.now, why, events);
    return {{}, false, Stop::controlled};
  }
  watch_pauses(input, events);
  watch_shoves(input);
  // What holds it up at its goal holds up nothing any more.
  const bool near_enough = ends_short(input.estimate, located);
  const bool there =
      near_enough || (progress_.arrived && !waits_.for_place() && !waits_.for_constraint());
  if (phase_ == Phase::paused && !there) {
    if (goal_near_since_ != kNever) goal_near_since_ = input.now;  // waiting is not creeping
    return {{}, true, Stop::controlled, asked(input)};
  }
  if (goal_near_since_ == kNever && progress_.distance_left_m < kGoalNear_m) {
    goal_near_since_ = input.now;
  }
  stopping_at_goal_ = stopping_at_goal_ || progress_.arrived || near_enough;
  if (stopping_at_goal_) {
    settle_at_goal(input, events);
    return {{}, active(), Stop::none};  // a ramp as the tracker foresaw it
  }
  if (!(input.along_cap_mps > 0)) return {{}, true, Stop::controlled, asked(input)};
  const double cap_mps = std::min(speed_cap_mps(input), input.along_cap_mps);
  const Twist target =
      tracker_.follow(input.estimate.pose, progress_, cap_mps, input.dt, input.may_go_aside);
  return {target, true, Stop::none, target};
}

WayLeft Navigator::way() const {
  if (path_ == nullptr) return {};
  WayLeft way = tracker_.way();
  way.path = path_->number;
  return way;
}

void Navigator::on_commanded(Time now, bool moving, EventQueue& events) {
  if (phase_ != Phase::running || begun_ || !moving) return;
  begun_ = true;
  events.push(now, NavigationStarted{id_});
}

NavSnapshot Navigator::snapshot(const HealthReport& health) const {
  NavSnapshot nav;
  nav.status = status_;
  nav.locate = health.locate;
  nav.obstacle = health.near_zone || (phase_ == Phase::paused && waits_.for_obstacle());
  nav.paused = phase_ == Phase::paused;
  if (status_ == NavStatus::free) return nav;
  nav.track = track_;
  nav.target_id = target_ + 1;
  nav.asked_speed_mps = speed_mps_;
  if (status_ == NavStatus::success) return nav;
  // After an error: what was left when it stopped.
  nav.cross_track_m = progress_.cross_track_m;
  nav.distance_left_m = progress_.distance_left_m;
  return nav;
}

}  // namespace drover::engine
