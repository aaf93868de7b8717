// The task's life: free, starting, running, paused, ended; and what is answered to whom.
#pragma once

#include "engine/event_queue.h"
#include "engine/health/arm_wait.h"
#include "engine/health/latch.h"
#include "engine/navigate/corridor.h"
#include "engine/navigate/nav_input.h"
#include "engine/navigate/tracker.h"
#include "engine/navigate/waits.h"

namespace drover::engine {

struct NavOutput {
  Twist target;
  bool drives = false;  ///< there is a task: axes are to run (armed, if at rest)
  Stop stop = Stop::controlled;
  Twist asked{};  ///< what it would do if nothing were in the way
};

/// Nothing moves but between an accepted StartTask and the end of that task. Each StartTask is
/// answered once, its path returned once; each accepted one has exactly one NavigationStarted and
/// then one TaskEnded, or exactly one NavigationNotStarted.
class Navigator final {
 public:
  /// A task that fails is latched there, and what is latched there hinders a start.
  Navigator(const EngineConfig& config, Latch& latch);

  void start(const RequestId& id, const StartTask& task, Time now, const Estimate& estimate,
             bool has_origin, const HealthReport& health, EventQueue& events);
  void cancel(const RequestId& id, Time now, EventQueue& events);
  /// Another owner moves the base: how the last task ended is no news any more.
  void make_way();
  /// A stop was latched: the task fails.
  void stop(Time now, EventQueue& events);

  NavOutput step(const NavInput& input, EventQueue& events);
  /// After the gate: the first motion commanded begins the navigation.
  void on_commanded(Time now, bool moving, EventQueue& events);

  bool active() const { return phase_ != Phase::idle; }
  /// Of the task's track; 0: there is no task.
  std::uint64_t path_number() const { return path_ == nullptr ? 0 : path_->number; }
  WayLeft way() const;
  bool starting() const { return phase_ == Phase::starting; }
  /// After an error that nothing holds any more: what a person has to do. In a pause whose cause is
  /// gone: that it goes on soon. Empty otherwise.
  Reason waits_for(const HealthReport& health) const;
  NavSnapshot snapshot(const HealthReport& health) const;

 private:
  enum class Phase : std::uint8_t {
    idle,
    starting,  ///< accepted, drives are being armed
    running,
    paused,
  };

  void end(Time now, TaskEnded::How how, const Reason& reason, EventQueue& events);
  void fail(Time now, const Reason& reason, EventQueue& events);
  NavOutput arm(const NavInput& input, EventQueue& events);
  NavOutput run(const NavInput& input, EventQueue& events);
  void settle_at_goal(const NavInput& input, EventQueue& events);
  void watch_pauses(const NavInput& input, EventQueue& events);
  bool stop_at_once(const NavInput& input, EventQueue& events);
  Reason find_failure(const NavInput& input);
  Reason find_position_failure(const Estimate& estimate, const HealthReport& health) const;
  void watch_shoves(const NavInput& input);
  double speed_cap_mps(const NavInput& input) const;
  bool ends_short(const Estimate& estimate, bool located) const;
  OnTrack on_track(const Estimate& estimate) const {
    return {estimate, progress_, tracker_, config_};
  }
  Twist asked(const NavInput& input);

  EngineConfig config_;
  Latch& latch_;
  BodyLimits body_;
  Tracker tracker_;
  Phase phase_ = Phase::idle;
  NavStatus status_ = NavStatus::free;
  RequestId id_;
  const Path* path_ = nullptr;
  Name track_;
  std::uint32_t target_ = 0;
  double speed_mps_ = 0;
  bool begun_ = false;  ///< NavigationStarted was said
  bool stopping_at_goal_ = false;
  bool returns_ = false;  ///< to its track, after a shove
  ArmWait drives_;
  Time accepted_ = kNever;
  Time goal_near_since_ = kNever;
  Waits waits_;
  TrackProgress progress_;
  Reason ended_;  ///< why the task ended in an error; outlives a reset
};

}  // namespace drover::engine
