#include "engine/health/health.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

#include "engine/health/announcer.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

class AHealthMonitor : public ::testing::Test {
 protected:
  AHealthMonitor() {
    for (const char* name : {"front_left", "front_right"}) {
      (void)config.joints.push_back(name);
    }
    (void)config.base.left.push_back(0);
    (void)config.base.right.push_back(1);
    config.line_configured = {true, true, true, true};
    for (std::size_t i = 0; i < 2; ++i) {
      axes[i].joint = config.joints[i];
      axes[i].state = AxisState::running;
      axes[i].last_motion = now;
      environment.axes[i].state = SourceState::fresh;
    }
    for (SourceHealth& line : environment.lines) {
      line.state = SourceState::fresh;
      line.last_good = now;
    }
    environment.guard_alive = true;
    environment.gnss[0].state = SourceState::fresh;
    environment.gnss[0].last_good = now;
    lines.active = {};
    estimate.has_position = estimate.has_heading = true;
    estimate.predicted_error_m = 0.03;
    estimate.yaw_error_rad = 0.01;
  }
  const HealthReport& update() {
    if (!monitor) monitor.emplace(config);
    return monitor->update({now, environment, axes, lines, estimate, has_origin, task, latched});
  }
  std::string first_why() {
    const HealthReport& report = update();
    return report.why.empty() ? "" : std::string(report.why[0].view());
  }
  void expect_stop(const std::string& text) {
    EXPECT_THAT(first_why(), HasSubstr(text));
    EXPECT_THAT(std::string(update().stop.view()), HasSubstr(text));
  }
  SourceHealth& line(Line l) { return environment.lines[static_cast<std::size_t>(l)]; }
  void activate(Line l) { lines.active[static_cast<std::size_t>(l)] = true; }

  EngineConfig config;
  std::optional<HealthMonitor> monitor;
  Environment environment;
  std::array<AxisSnapshot, 2> axes{};
  LineTable lines;
  Estimate estimate;
  bool has_origin = true;
  bool task = false;
  Reason latched;
  Time now{std::chrono::seconds(1000)};
};

TEST_F(AHealthMonitor, SaysHowLongTheImuHasBeenSilent) {
  environment.imu_configured = true;
  EXPECT_EQ(first_why(), "IMU never heard");
  environment.imu[0].state = SourceState::fresh;
  environment.imu[0].last_good = now - std::chrono::milliseconds(300);
  EXPECT_EQ(first_why(), "");
  EXPECT_LT(update().budget_used, 1);
  environment.imu[0].last_good = now - std::chrono::milliseconds(310);
  EXPECT_EQ(first_why(), "IMU silent for 0.3 s");
  EXPECT_TRUE(update().stop.empty());  // it goes on by the wheels,
  EXPECT_EQ(update().budget_used, 1);  // slowly
  environment.imu_configured = false;
  EXPECT_EQ(first_why(), "");
}
TEST_F(AHealthMonitor, SaysWhatIsWrongWithAnImuThatTalks) {
  environment.imu_configured = true;
  environment.imu[0] = {.state = SourceState::stale, .last_good = now, .reason = "frozen"};
  EXPECT_EQ(first_why(), "sensor IMU: frozen");
}
TEST_F(AHealthMonitor, PassesOnThatSensorsContradictEachOther) {
  estimate.notice = "wheels slip";
  EXPECT_EQ(first_why(), "wheels slip");
  EXPECT_TRUE(update().stop.empty());
  EXPECT_EQ(update().locate, LocateState::good);
}
TEST_F(AHealthMonitor, StopsForAPressedEstop) {
  activate(Line::estop);
  expect_stop("e-stop pressed");
  EXPECT_TRUE(update().estop);
  EXPECT_FALSE(update().lines_ok);
}
TEST_F(AHealthMonitor, StopsForATouchedBumper) {
  activate(Line::bumper);
  expect_stop("bumper touched");
}
TEST_F(AHealthMonitor, StopsForEveryLineThatIsLost) {
  for (const Line l : {Line::estop, Line::bumper, Line::zone_far, Line::zone_near}) {
    for (const SourceState state : {SourceState::stale, SourceState::never_heard}) {
      line(l).state = state;
      expect_stop(std::string("line ") + std::string(line_name(l)));
      line(l).state = SourceState::fresh;
    }
  }
}
TEST_F(AHealthMonitor, TakesALostEstopLineForAPressedEstop) {
  line(Line::estop).state = SourceState::stale;
  EXPECT_TRUE(update().estop);
}
TEST_F(AHealthMonitor, ClaimsNothingOfALineThatIsNotKnownYetButStops) {
  lines.active.fill(true);
  for (SourceHealth& each : environment.lines) each.state = SourceState::never_heard;
  expect_stop("line e-stop: not known yet, just after the start");
  const HealthReport& report = update();
  EXPECT_FALSE(report.estop || report.near_zone || report.far_zone || report.lines_ok);
  EXPECT_FALSE(report.estop_known);
  EXPECT_FALSE(report.holds(Cause::estop) || report.holds(Cause::bumper));
  EXPECT_FALSE(report.holds(Cause::near_zone));
  now += std::chrono::milliseconds(1100);  // by then it is a fault
  EXPECT_TRUE(update().estop && update().near_zone);
  expect_stop("line e-stop: not readable");
}
TEST_F(AHealthMonitor, StopsWhenALineWasNotReadForTwentyMilliseconds) {
  line(Line::bumper).last_good = now - std::chrono::milliseconds(20);
  EXPECT_TRUE(update().stop.empty());
  line(Line::bumper).last_good = now - std::chrono::milliseconds(21);
  expect_stop("line bumper");
}
TEST_F(AHealthMonitor, DoesNotLookAtLinesThatAreNotConfigured) {
  config.line_configured = {true, false, false, false};
  activate(Line::bumper);
  activate(Line::zone_near);
  line(Line::zone_far).state = SourceState::never_heard;
  EXPECT_TRUE(update().stop.empty());
  EXPECT_FALSE(update().near_zone || update().far_zone);
}
TEST_F(AHealthMonitor, StopsWhileTheGuardHasTheBus) {
  environment.guard_has_bus = true;
  expect_stop("the guard stopped the drives");
  EXPECT_FALSE(update().guard_ok);
}
TEST_F(AHealthMonitor, StopsWhileTheGuardKeepsAnotherConfigurationsStopSetAndIsToldHowThatEnds) {
  environment.guard_has_bus = environment.guard_latched = environment.guard_refuses_set = true;
  expect_stop("drover-guard keeps the stop set of another configuration, until drover reset");
  EXPECT_FALSE(update().guard_ok);
  EXPECT_EQ(update().stop_but_guard, "") << "or its reset would be refused for it";
  environment = {};
  environment.guard_alive = environment.guard_refuses_set = true;
  EXPECT_NE(update().stop, "") << "it would stop what that one had";
  config.health.guard_required = false;
  monitor.reset();
  EXPECT_EQ(update().stop.view().find("stop set"), std::string_view::npos);
}
TEST_F(AHealthMonitor, TellsOfAStopAtAGuardThatItDoesNotNeedWhateverThatOneKeeps) {
  config.health.guard_required = false;
  environment.guard_has_bus = environment.guard_latched = environment.guard_refuses_set = true;
  expect_stop("stopped by drover stop at the guard, until drover reset");
}
TEST_F(AHealthMonitor, StopsWithoutAGuardUnlessNoneIsRequired) {
  environment.guard_alive = false;
  expect_stop("the guard does not answer");
  config.health.guard_required = false;
  monitor.reset();
  EXPECT_TRUE(update().stop.empty());
}
TEST_F(AHealthMonitor, NamesTheWheelThatIsSilentAndForHowLong) {
  axes[1].last_motion = now - std::chrono::milliseconds(120);
  expect_stop("wheel front_right: no feedback for 0.12 s");
  EXPECT_FALSE(update().drives_ok);
  EXPECT_FALSE(update().drives_running);
}
TEST_F(AHealthMonitor, CallsAWheelSilentAtTheLimitAndNotBefore) {
  axes[0].last_motion = now - std::chrono::milliseconds(99);
  EXPECT_TRUE(update().stop.empty());
  axes[0].last_motion = now - std::chrono::milliseconds(100);
  EXPECT_FALSE(update().stop.empty());
}
TEST_F(AHealthMonitor, BelievesADriverThatCallsItsDriveStale) {
  environment.axes[0].state = SourceState::stale;
  environment.axes[0].reason = "heartbeat missing";
  expect_stop("wheel front_left: heartbeat missing");
}
TEST_F(AHealthMonitor, TellsTheDriversReasonAlsoWhenTheFeedbackIsOld) {
  axes[0].last_motion = now - std::chrono::milliseconds(500);
  environment.axes[0].state = SourceState::stale;
  environment.axes[0].reason = "can0 is bus-off";
  expect_stop("wheel front_left: can0 is bus-off");
}
TEST_F(AHealthMonitor, TellsOfABusInTroubleAndDrivesOn) {
  environment.bus = "can0 has many errors";
  EXPECT_TRUE(update().stop.empty());
  ASSERT_EQ(update().why.size(), 1U);
  EXPECT_EQ(update().why[0], "can0 has many errors");
}
TEST_F(AHealthMonitor, StopsForADriveThatWasNeverHeard) {
  axes[0].last_motion = kNever;
  expect_stop("wheel front_left: never heard");
}
TEST_F(AHealthMonitor, SaysThatNoDriveAnswersWhenAllAreSilent) {
  for (auto& axis : axes) axis.last_motion = now - std::chrono::milliseconds(500);
  expect_stop("no drive answers (wheel front_left: no feedback for 0.50 s)");
}
/// Of motors behind one device all are given up together.
TEST_F(AHealthMonitor, NamesTheWheelThatHasTheFaultOfADeviceOfSeveral) {
  for (AxisSnapshot& axis : axes) {
    axis.state = AxisState::fault;
    axis.fault = "motor 2 is stuck";
  }
  axes[1].error_code = 1;
  EXPECT_EQ(first_why(), "wheel front_right: motor 2 is stuck");
  EXPECT_EQ(update().not_running, "wheel front_right: motor 2 is stuck");
  axes[1].error_code = 0;
  EXPECT_EQ(first_why(), "wheel front_left: motor 2 is stuck");
}
TEST_F(AHealthMonitor, NamesTheWheelThatIsSilentOfADeviceOfSeveral) {
  for (std::size_t i = 0; i < 2; ++i) {
    environment.axes[i].state = SourceState::stale;
    environment.axes[i].reason = "motor 2 is silent";
  }
  axes[1].last_motion = now - std::chrono::milliseconds(50);
  axes[0].last_motion = now - std::chrono::milliseconds(2);
  expect_stop("wheel front_right: motor 2 is silent");
  EXPECT_EQ(first_why().find("no drive answers"), std::string::npos) << "three of four do";
  axes[1].last_motion = kNever;
  expect_stop("wheel front_right: motor 2 is silent");
  axes[0].last_motion = kNever;
  expect_stop("no drive answers (wheel front_left: motor 2 is silent)");
  axes[0].last_motion = axes[1].last_motion = now - std::chrono::milliseconds(30);
  expect_stop("no drive answers (wheel front_left: motor 2 is silent)");
  axes[1].last_motion = now - std::chrono::milliseconds(800);
  axes[0].last_motion = now - std::chrono::milliseconds(700);
  expect_stop("no drive answers (wheel front_right: motor 2 is silent)");
}
/// Its cause is told first: what cut the power silenced the drives.
TEST_F(AHealthMonitor, TellsWhatCutThePowerBeforeTheDrivesThatAreSilentWithoutIt) {
  for (auto& axis : axes) axis.last_motion = now - std::chrono::milliseconds(500);
  latched = "the robot did not stop";
  environment.gnss[0].state = SourceState::never_heard;
  if (!monitor) monitor.emplace(config);
  const auto whys = [&](bool power_cut) {
    std::vector<std::string> all;
    const HealthReport& report = monitor->update({.now = now,
                                                  .environment = environment,
                                                  .axes = axes,
                                                  .lines = lines,
                                                  .estimate = estimate,
                                                  .has_origin = has_origin,
                                                  .task_active = task,
                                                  .latched = latched,
                                                  .power_cut = power_cut});
    for (const Reason& why : report.why) all.emplace_back(why.view());
    return all;
  };
  const auto cut = whys(true);
  ASSERT_GE(cut.size(), 3U);
  EXPECT_EQ(cut.front(), "stopped: the robot did not stop");
  EXPECT_THAT(cut.back(), HasSubstr("no drive answers"));
  EXPECT_THAT(whys(false).front(), HasSubstr("no drive answers"));
}
TEST_F(AHealthMonitor, StopsWithoutDrives) {
  config.base.left.clear();
  config.base.right.clear();
  expect_stop("no drives are configured");
}
TEST_F(AHealthMonitor, TellsADrivesFaultInItsOwnWords) {
  axes[1].state = AxisState::fault;
  axes[1].fault = "motor over temperature";
  EXPECT_EQ(first_why(), "wheel front_right: motor over temperature");
  EXPECT_TRUE(update().stop.empty()) << "at rest it is no stop: arming may clear it";
  EXPECT_EQ(update().not_running, "wheel front_right: motor over temperature");
}
TEST_F(AHealthMonitor, SeesThatADriveIsNotInClosedLoop) {
  axes[0].state = AxisState::idle;
  EXPECT_TRUE(update().drives_ok);
  EXPECT_FALSE(update().drives_running);
  EXPECT_THAT(std::string(update().not_running.view()), HasSubstr("not in closed loop"));
  EXPECT_EQ(first_why(), "") << "idle drives are how a robot rests";
}
/// So a start that comes to nothing names a locked brake.
TEST_F(AHealthMonitor, TellsWhyADriveIsNotInClosedLoopInItsOwnWords) {
  axes[0].state = AxisState::arming;
  axes[0].fault = "its brake is locked";
  EXPECT_EQ(update().not_running, "wheel front_left: its brake is locked");
  EXPECT_TRUE(update().drives_ok);
  EXPECT_EQ(first_why(), "") << "it is no fault";
}
TEST_F(AHealthMonitor, PutsTheEstopBeforeTheDrivesThatItSilences) {
  axes[0].last_motion = axes[1].last_motion = kNever;
  estimate.predicted_error_m = 5;
  activate(Line::estop);
  const HealthReport& report = update();
  ASSERT_EQ(report.why.size(), 3U);
  EXPECT_EQ(report.why[0], "e-stop pressed");
  EXPECT_THAT(std::string(report.why[1].view()), HasSubstr("no drive answers"));
  EXPECT_THAT(std::string(report.why[2].view()), HasSubstr("position uncertain"));
}
TEST_F(AHealthMonitor, PutsPresentCausesBeforeLatchedOnes) {
  latched = "bumper touched";
  EXPECT_EQ(first_why(), "stopped: bumper touched");
  activate(Line::estop);
  EXPECT_EQ(first_why(), "e-stop pressed");
}
TEST_F(AHealthMonitor, TellsTheReceiversSilence) {
  environment.gnss[0].last_good = now - std::chrono::milliseconds(1200);
  EXPECT_EQ(first_why(), "receiver silent for 1.2 s");
  EXPECT_FALSE(update().gnss_ok);
  EXPECT_TRUE(update().stop.empty()) << "wheels carry the position for a while";
}
TEST_F(AHealthMonitor, TellsWhyThereIsNoPosition) {
  has_origin = false;
  EXPECT_EQ(first_why(), "no origin is set");
  has_origin = true;
  estimate.has_heading = false;
  EXPECT_EQ(first_why(), "no heading yet (with one antenna: drover heading find)");
}
TEST_F(AHealthMonitor, CountsTheCausesThatFindNoRoom) {
  environment.imu_configured = true;
  environment.guard_alive = false;
  environment.axes[0].state = SourceState::stale;
  environment.axes[1].reason = "odd";
  environment.gnss[0].state = SourceState::stale;
  environment.program = "the publish thread stands still";
  environment.foreign = "somebody else commands the drives";
  environment.bus = "can0: error passive";
  estimate.notice = "the wheels and the gyro differ";
  latched = "it was pushed";
  for (const Line each : {Line::estop, Line::bumper, Line::zone_near, Line::zone_far})
    activate(each);
  const HealthReport& report = update();
  const auto causes = static_cast<std::size_t>(std::popcount(report.causes));
  ASSERT_GT(causes, report.why.capacity());
  EXPECT_TRUE(report.why.full());
  EXPECT_EQ(report.why_untold, causes - report.why.size());
  EXPECT_TRUE(report.gives(report.why[0]));
  EXPECT_FALSE(report.gives("nothing of that"));
  for (const Line each : {Line::estop, Line::bumper, Line::zone_near, Line::zone_far})
    lines.active[static_cast<std::size_t>(each)] = false;
  environment.foreign.clear();
  environment.program.clear();
  latched.clear();
  EXPECT_EQ(update().why_untold, 0U);
}

TEST_F(AHealthMonitor, SeesBothZones) {
  activate(Line::zone_far);
  EXPECT_TRUE(update().far_zone);
  EXPECT_THAT(first_why(), HasSubstr("far zone"));
  activate(Line::zone_near);
  EXPECT_TRUE(update().near_zone);
  EXPECT_THAT(first_why(), HasSubstr("near zone"));
  EXPECT_TRUE(update().stop.empty());
}
TEST_F(AHealthMonitor, HasNothingToSayAboutAHealthyRobot) {
  const HealthReport& report = update();
  EXPECT_TRUE(report.why.empty());
  EXPECT_TRUE(report.drives_ok && report.drives_running && report.lines_ok);
  EXPECT_TRUE(report.gnss_ok && report.guard_ok);
  EXPECT_EQ(report.locate, LocateState::good);
}

class AnAnnouncer : public AHealthMonitor {
 protected:
  std::vector<std::string> said() {
    announcer.update(now, update(), events);
    FixedVector<Event, 64> some;
    events.drain(some);
    std::vector<std::string> texts;
    for (const Event& event : some) {
      texts.emplace_back(std::get<Notice>(event.body).text.view());
    }
    return texts;
  }
  void wait(Duration time) {
    now += time;
    for (auto& l : environment.lines) l.last_good = now;
    for (auto& axis : axes) axis.last_motion = now;
    environment.gnss[0].last_good = now;
  }
  Announcer announcer;
  EventQueue events;
};

TEST_F(AnAnnouncer, IsSilentWhileAllIsWell) {
  EXPECT_TRUE(said().empty());
}
TEST_F(AnAnnouncer, WaitsASecondBeforeItCallsItNewsThatNothingWasHeardYet) {
  activate(Line::bumper);
  EXPECT_TRUE(said().empty());
  wait(std::chrono::milliseconds(999));
  EXPECT_TRUE(said().empty());
  wait(std::chrono::milliseconds(1));
  EXPECT_THAT(said(), ::testing::ElementsAre("bumper touched"));
}
TEST_F(AnAnnouncer, SaysOnceWhatBeginsAndOnceThatItIsOver) {
  EXPECT_TRUE(said().empty());
  wait(std::chrono::seconds(1));
  activate(Line::bumper);
  EXPECT_THAT(said(), ::testing::ElementsAre("bumper touched"));
  EXPECT_TRUE(said().empty());
  lines.active = {};
  EXPECT_THAT(said(), ::testing::ElementsAre("bumper free"));
}
TEST_F(AnAnnouncer, DoesNotFloodTheJournalWhenASourceFlaps) {
  std::size_t count = 0;
  for (int i = 0; i < 400; ++i) {
    wait(std::chrono::milliseconds(5));
    lines.active[static_cast<std::size_t>(Line::bumper)] = i % 2 == 0;
    count += said().size();
  }
  EXPECT_LE(count, 6U);
}

}  // namespace
}  // namespace drover::engine
