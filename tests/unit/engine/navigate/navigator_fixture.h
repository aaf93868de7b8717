// A navigator with its whole surroundings in a test's hands.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "engine/navigate/navigator.h"

namespace drover::engine {

/// A navigator with everything about it in a test's hands: track along x from 0 to 10 m, the robot
/// at (2, 0) looking along it, all healthy, drives in closed loop.
class ANavigator : public ::testing::Test {
 protected:
  ANavigator() {
    for (int i = 0; i <= 10; ++i) path.points.push_back({1.0 * i, 0});
    path.name = "row";
    health.ready = health.drives_ok = health.drives_running = health.lines_ok = true;
    health.gnss_ok = health.guard_ok = true;
    health.locate = LocateState::good;
    health.budget_used = 0.2;
    estimate.has_position = estimate.has_heading = true;
    estimate.predicted_error_m = 0.03;
    estimate.yaw_error_rad = 0.01;
    estimate.pose.x_m = 2;
  }

  template <class Body>
  std::vector<Body> said() {
    std::vector<Body> all;
    for (const Event& event : log) {
      if (const auto* body = std::get_if<Body>(&event.body)) all.push_back(*body);
    }
    return all;
  }
  void drain() {
    FixedVector<Event, 64> some;
    events.drain(some);
    log.insert(log.end(), some.begin(), some.end());
  }
  RequestId next_id() { return {RequestId::Source::mqtt, ++number}; }
  void start(double speed_mps = 0.5, std::uint32_t target = 10) {
    start_on(&path, target, speed_mps);
  }
  void start_on(const Path* p, std::uint32_t target, double speed_mps) {
    navigator.start(next_id(), {p, target, speed_mps}, now, estimate, has_origin, health, events);
    drain();
  }
  void cancel() {
    navigator.cancel(next_id(), now, events);
    drain();
  }
  NavOutput step() {
    now += std::chrono::milliseconds(5);
    if (wheels == WheelFault::runaway) latch.set(Latched::ran_away, wheel_reason);
    const NavOutput out = navigator.step({now, std::chrono::milliseconds(5), estimate, health,
                                          wheels, wheel_reason, at_rest, refusal},
                                         events);
    const bool moving = out.target.vx_mps != 0 || out.target.wz_radps != 0;
    navigator.on_commanded(now, moving && out.stop == Stop::none, events);
    drain();
    return out;
  }
  NavOutput run_s(double seconds) {
    NavOutput out;
    for (int i = 0; i < static_cast<int>(seconds * 200); ++i) out = step();
    return out;
  }
  void start_and_run() {
    start();
    step();  // the drives hear of it
    step();
    ASSERT_EQ(said<NavigationStarted>().size(), 1U);
  }
  NavStatus status() { return navigator.snapshot(health).status; }
  std::string refusal_text() {
    const auto refused = said<CommandRefused>();
    return refused.empty() ? "" : std::string(refused.back().reason.view());
  }
  void expect_failed(const std::string& reason) {
    ASSERT_EQ(said<TaskEnded>().size(), 1U);
    EXPECT_EQ(said<TaskEnded>()[0].how, TaskEnded::How::failed);
    EXPECT_THAT(std::string(said<TaskEnded>()[0].reason.view()), ::testing::HasSubstr(reason));
    EXPECT_EQ(status(), NavStatus::error);
    EXPECT_EQ(said<PathReleased>().size(), 1U);
    EXPECT_THAT(std::string(latch.why().view()), ::testing::HasSubstr(reason));
    EXPECT_FALSE(step().drives);
  }

  EngineConfig config;
  Latch latch;
  Navigator navigator{config, latch};
  EventQueue events;
  std::vector<Event> log;
  Path path;
  HealthReport health;
  Estimate estimate;
  WheelFault wheels = WheelFault::none;
  Reason wheel_reason;
  bool at_rest = true;
  bool has_origin = true;
  TargetRefusal refusal = TargetRefusal::none;
  Time now{std::chrono::seconds(50)};
  std::uint64_t number = 0;
};

}  // namespace drover::engine
