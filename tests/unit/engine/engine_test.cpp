#include "engine/engine.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "engine_fixture.h"
#include "support/allocation_counter.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;
using How = TaskEnded::How;

// --- refusals ---------------------------------------------------------------------------------

TEST(Engine, RefusesABaseWithAnAxisThatIsNoDrive) {
  EngineConfig config = rig_config();
  (void)config.base.left.push_back(7);
  EXPECT_THROW(Engine{config}, std::invalid_argument);
}
TEST_F(AnEngine, RefusesAStartBeforeItsFirstCycle) {
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_EQ(rig.said<CommandRefused>().size(), 1U);
  EXPECT_EQ(rig.said<PathReleased>().size(), 1U);
}
TEST_F(AnEngine, RefusesAStartWithoutAnOrigin) {
  rig.run_s(1);
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_EQ(refusal(), "no origin is set");
  EXPECT_EQ(rig.snapshot().nav.locate, LocateState::uninit);
}
TEST_F(AnEngine, RefusesAStartWhileAnythingStops) {
  rig.settle();
  const auto refuses = [&](const std::string& text) {
    rig.run_s(0.7);  // what stopped it before is over for long
    rig.start(path, 40, 0.5);
    rig.tick();
    EXPECT_THAT(refusal(), HasSubstr(text));
    EXPECT_EQ(rig.snapshot().nav.status, NavStatus::free);
  };
  rig.lines[0] = true;
  refuses("e-stop pressed");
  rig.lines[0] = false;
  rig.lines[1] = true;
  refuses("bumper touched");
  rig.lines[1] = false;
  rig.line_lost[3] = true;
  refuses("near zone");
  rig.line_lost[3] = false;
  rig.guard_alive = false;
  refuses("guard");
  rig.guard_alive = true;
  rig.guard_has_bus = true;
  refuses("guard");
  rig.guard_has_bus = false;
  rig.drives[2].silent = true;
  refuses("wheel rear_left");
  rig.drives[2].silent = false;
  rig.receiver_silent = true;
  rig.run_s(0.4);
  refuses("receiver");
  EXPECT_EQ(rig.said<PathReleased>().size(), 7U);
}
TEST_F(AnEngine, RefusesAnEmptyCommand) {
  rig.command(std::monostate{});
  rig.tick();
  EXPECT_EQ(rig.said<CommandRefused>().size(), 1U);
}

// --- origins ----------------------------------------------------------------------------------

TEST_F(AnEngine, RefusesToProposeAnOriginWithoutAFix) {
  rig.command(ProposeOrigin{});
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("receiver"));
  rig.quality = FixQuality::rtk_float;
  rig.run_s(1);
  rig.command(ProposeOrigin{});
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("not RTK fixed"));
  rig.quality = FixQuality::rtk_fixed;
  rig.run_s(1);
  rig.receiver_silent = true;
  rig.run_s(0.5);
  rig.command(ProposeOrigin{});
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("receiver"));
  EXPECT_TRUE(rig.said<OriginProposed>().empty());
}
TEST_F(AnEngine, ProposesTheAntennasPlaceAsOftenAsAsked) {
  rig.run_s(1);
  for (int i = 0; i < 3; ++i) rig.command(ProposeOrigin{});
  rig.tick();
  const auto proposed = rig.said<OriginProposed>();
  ASSERT_EQ(proposed.size(), 3U);
  EXPECT_NEAR(proposed[0].origin.latitude_deg, kRigOrigin.latitude_deg, 1e-5);
  EXPECT_NEAR(proposed[0].origin.altitude_m, 500, 1e-6);
  EXPECT_FALSE(rig.snapshot().origin_set) << "a proposal changes nothing";
}
TEST_F(AnEngine, RefusesOriginsThatAreNoPlaceAndThoseDuringATask) {
  rig.tick();
  for (const GeodeticPoint bad : {GeodeticPoint{91, 0, 0}, GeodeticPoint{0, 188.2, 0},
                                  GeodeticPoint{kAbsent, 0, 0}, GeodeticPoint{0, 0, kAbsent}}) {
    rig.command(SetOrigin{bad});
  }
  rig.tick();
  EXPECT_EQ(rig.said<CommandRefused>().size(), 4U);
  rig.log.clear();
  drive();
  rig.set_origin();
  rig.command(ProposeOrigin{});
  rig.tick();
  EXPECT_EQ(rig.said<CommandRefused>().size(), 2U);
  EXPECT_EQ(refusal(), "a task runs: cancel it first");
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run);
}

// --- driving ----------------------------------------------------------------------------------

TEST_F(AnEngine, DrivesAStraightTrackToItsGoal) {
  rig.settle();
  EXPECT_EQ(rig.snapshot().nav.locate, LocateState::good) << rig.why();
  rig.start(path, 40, 0.5);
  double squares_m2 = 0;
  int samples = 0;
  for (int i = 0; i < 60 * 200 && rig.said<TaskEnded>().empty(); ++i) {
    rig.tick();
    if (rig.snapshot().nav.status == NavStatus::run) {
      squares_m2 += rig.plant.truth().y_m * rig.plant.truth().y_m;
      ++samples;
    }
  }
  ASSERT_EQ(rig.said<TaskEnded>().size(), 1U) << rig.why();
  EXPECT_EQ(rig.said<TaskEnded>()[0].how, How::success);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success);
  EXPECT_EQ(rig.said<PathReleased>().size(), 1U);
  EXPECT_FALSE(rig.snapshot().stop_latched);
  const double miss_m = std::hypot(rig.plant.truth().x_m - 20, rig.plant.truth().y_m);
  EXPECT_LT(miss_m, 0.10);
  EXPECT_LT(std::sqrt(squares_m2 / samples), 0.03);
  std::printf("straight 20 m: cross-track RMS %.4f m, final distance %.4f m\n",
              std::sqrt(squares_m2 / samples), miss_m);
  expect_no_motion_for_s(2);
}
TEST_F(AnEngine, DrivesBackAlongTheListToPointOne) {
  EngineRig back(rig_config(), 20, 0.1, kPi - 0.1);
  back.settle();
  back.start(path, 0, 0.5);
  for (int i = 0; i < 60 * 200 && back.said<TaskEnded>().empty(); ++i) back.tick();
  ASSERT_EQ(back.said<TaskEnded>().size(), 1U) << back.why();
  EXPECT_EQ(back.said<TaskEnded>()[0].how, How::success);
  EXPECT_LT(std::hypot(back.plant.truth().x_m, back.plant.truth().y_m), 0.10);
}
TEST_F(AnEngine, ArmsTheDrivesOnlyForATaskAndLetsThemRestAfterwards) {
  rig.settle();
  for (const AxisCommand& axis : rig.out.axes) EXPECT_EQ(axis.request, AxisRequest::rest);
  rig.start(path, 40, 0.5);
  rig.tick();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(rig.out.axes[i].request, AxisRequest::run);
  EXPECT_EQ(rig.fastest_command_radps(), 0) << "armed with zero first";
  rig.run_s(2);
  rig.command(CancelTask{});
  rig.run_s(2);
  for (const AxisCommand& axis : rig.out.axes) EXPECT_EQ(axis.request, AxisRequest::rest);
}
TEST_F(AnEngine, BeginsNavigationInTheCycleOfTheFirstMotion) {
  rig.settle();
  rig.start(path, 40, 0.5);
  while (rig.fastest_command_radps() == 0 && rig.asked < 100) {
    ASSERT_TRUE(rig.said<NavigationStarted>().empty());
    rig.tick();
  }
  EXPECT_EQ(rig.said<NavigationStarted>().size(), 1U);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::task);
}
TEST_F(AnEngine, SaysWhyItCouldNotBegin) {
  rig.settle();
  rig.drives[3].refuses = true;
  rig.start(path, 40, 0.5);
  rig.run_s(4);
  ASSERT_EQ(rig.said<NavigationNotStarted>().size(), 1U);
  EXPECT_THAT(std::string(rig.said<NavigationNotStarted>()[0].reason.view()),
              HasSubstr("wheel rear_right"));
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
}
TEST_F(AnEngine, ArmsADriveWhoseOldFaultCanBeCleared) {
  rig.settle();
  rig.drives[1].fault = true;
  rig.tick();
  EXPECT_EQ(rig.why(), "wheel front_right: over temperature");
  rig.drives[1].fault = false;
  rig.start(path, 40, 0.5);
  rig.run_s(2);
  EXPECT_EQ(rig.said<NavigationStarted>().size(), 1U);
}
TEST_F(AnEngine, StopsForACancelWithTheConfiguredDeceleration) {
  drive();
  rig.command(CancelTask{});
  double last_radps = rig.fastest_command_radps();
  int ticks = 0;
  while (rig.fastest_command_radps() > 0 && ticks < 400) {
    rig.tick();
    ++ticks;
    EXPECT_LE(rig.fastest_command_radps(), last_radps + 1e-6);
    last_radps = rig.fastest_command_radps();
  }
  EXPECT_NEAR(ticks * 0.005, 0.5 / rig.config.limits.deceleration_mps2, 0.1);
  EXPECT_EQ(rig.said<TaskEnded>()[0].how, How::cancelled);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::free);
}
TEST_F(AnEngine, GoesOnSmoothlyWhenAStartFollowsACancel) {
  drive();
  rig.command(CancelTask{});
  rig.start(path, 40, 0.5);
  double least_mps = 1;
  for (int i = 0; i < 200; ++i) {
    rig.tick();
    least_mps = std::min(least_mps, rig.plant.truth().vx_mps);
  }
  EXPECT_GT(least_mps, 0.3);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run);
  EXPECT_EQ(rig.said<NavigationStarted>().size(), 2U);
}

// --- what it promises to the runtime ----------------------------------------------------------

TEST_F(AnEngine, AnswersEveryCommandOnceAndReturnsEveryPathOnce) {
  rig.settle();
  rig.log.clear();
  const std::uint64_t before = rig.asked;
  for (int i = 0; i < 40; ++i) {
    rig.start(path, i % 2 == 0 ? 40 : 400, 0.5);
    if (i % 3 == 0) rig.command(CancelTask{});
    if (i % 5 == 0) rig.command(ResetStop{});
    if (i % 7 == 0) rig.set_origin();
    if (i % 11 == 0) rig.command(ProposeOrigin{});
  }
  rig.command(CancelTask{});
  rig.run_s(0.1);
  const std::size_t answers = rig.said<CommandAccepted>().size() +
                              rig.said<CommandRefused>().size() + rig.said<OriginProposed>().size();
  EXPECT_EQ(answers, rig.asked - before);
  EXPECT_EQ(rig.said<PathReleased>().size(), 40U);
}
TEST_F(AnEngine, AllocatesNothingAfterConstruction) {
  rig.settle();
  rig.start(path, 40, 0.5);
  rig.run_s(2);
  // The rig itself allocates; so a cycle is done by hand here.
  std::uint64_t allocations = 0;
  for (int i = 0; i < 400; ++i) {
    rig.tick();
    rig.now += kRigTick;
    Measurement fix;
    fix.time = fix.received = rig.now;
    const test::AllocationCounter counter;
    fix.value = rig.snapshot().gnss.position;
    rig.engine->on_measurement(fix);
    fix.value = AxisMotion{0, 1.0, 2.0, 0.0};
    rig.engine->on_measurement(fix);
    fix.value = LineState{Line::zone_far, i % 40 < 20};
    rig.engine->on_measurement(fix);
    if (i % 50 == 10) rig.engine->on_command({{}, rig.now, CancelTask{}}, rig.now);
    if (i % 50 == 20) rig.engine->on_command({{}, rig.now, StartTask{&path, 40, 9}}, rig.now);
    if (i % 50 == 21) rig.engine->on_command({{}, rig.now, StartTask{&path, 99, 9}}, rig.now);
    if (i % 50 == 30) rig.engine->on_command({{}, rig.now, ProposeOrigin{}}, rig.now);
    if (i == 390) rig.engine->on_command({{}, rig.now, SetOrigin{kRigOrigin}}, rig.now);
    rig.engine->step(rig.now, rig.environment, rig.out);
    allocations += counter.count();
  }
  EXPECT_EQ(allocations, 0U);
}
TEST_F(AnEngine, GivesEqualOutputsForEqualInputsToTheBit) {
  EngineRig other;
  const Path same = path;
  for (EngineRig* r : {&rig, &other}) {
    r->settle();
    r->start(r == &rig ? path : same, 40, 0.5);
  }
  for (int i = 0; i < 4000; ++i) {
    rig.tick();
    other.tick();
    for (std::size_t k = 0; k < 4; ++k) {
      ASSERT_EQ(std::memcmp(&rig.out.axes[k].velocity_radps, &other.out.axes[k].velocity_radps,
                            sizeof(double)),
                0)
          << i;
    }
  }
}
TEST_F(AnEngine, ReportsPoseAndAntennaOfOneInstant) {
  drive();
  Estimator geo(rig.config.estimate, rig.config.base);
  geo.set_origin(kRigOrigin);
  const Snapshot& snapshot = rig.snapshot();
  const GeodeticPoint antenna = geo.antenna_geodetic(snapshot.pose);
  EXPECT_DOUBLE_EQ(snapshot.gnss.pose_latitude_deg, antenna.latitude_deg);
  EXPECT_DOUBLE_EQ(snapshot.gnss.pose_longitude_deg, antenna.longitude_deg);
  EXPECT_NEAR(snapshot.gnss.heading_deg, 90, 3);
  EXPECT_EQ(snapshot.axes[0].joint, "front_left");
  EXPECT_EQ(snapshot.nav.target_id, 41U);
  EXPECT_EQ(snapshot.nav.track, "straight");
  EXPECT_NEAR(snapshot.pose.x_m, rig.plant.truth().x_m, 0.1);
}
TEST_F(AnEngine, DoesNotLetFramesThatOvertookEachOtherMoveAStateBackwards) {
  rig.settle();
  Measurement m;
  m.received = rig.now;
  m.time = rig.now - std::chrono::milliseconds(50);
  m.value = AxisMotion{0, 1234, 0, 0};
  rig.engine->on_measurement(m);
  EXPECT_NE(rig.snapshot().axes[0].motion.position_rad, 1234);
  m.time = rig.now;
  m.value = GnssVelocity{.speed_mps = 0.25};
  rig.engine->on_measurement(m);
  m.time = rig.now - std::chrono::milliseconds(50);
  m.value = GnssVelocity{.speed_mps = 7};
  rig.engine->on_measurement(m);
  EXPECT_EQ(rig.snapshot().gnss.velocity.speed_mps, 0.25);
}
TEST_F(AnEngine, NoticesASilentDriveWhoseLastStampLayInTheFuture) {
  drive();
  Measurement m;
  m.received = rig.now;
  m.time = rig.now + std::chrono::seconds(60);
  m.value = rig.snapshot().axes[0].motion;
  rig.engine->on_measurement(m);
  rig.drives[0].silent = true;
  for (int i = 0; i < 25; ++i) {
    rig.now += kRigTick;
    for (SourceHealth& line : rig.environment.lines) line.last_good = rig.now;
    for (std::size_t k = 1; k < 4; ++k) {
      m.time = m.received = rig.now;
      AxisMotion motion = rig.snapshot().axes[k].motion;
      motion.axis = static_cast<AxisId>(k);
      m.value = motion;
      rig.engine->on_measurement(m);
    }
    rig.engine->step(rig.now, rig.environment, rig.out);
  }
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(rig.why(), HasSubstr("wheel front_left: no feedback"));
}
TEST_F(AnEngine, ShowsTheLatestSampleOfTheInertialSensorAndItsHealth) {
  rig.tick();
  EXPECT_FALSE(rig.snapshot().imu.configured);
  rig.environment.imu_configured = true;
  rig.environment.imu[0].state = SourceState::fresh;
  ImuSample sample;
  sample.angular_velocity_radps.z = 0.25;
  const Time at = rig.now - std::chrono::milliseconds(3);
  rig.engine->on_measurement({at, rig.now, sample});
  sample.angular_velocity_radps.z = 9;  // one that overtook it
  rig.engine->on_measurement({at - std::chrono::milliseconds(10), rig.now, sample});
  rig.tick();
  EXPECT_TRUE(rig.snapshot().imu.configured);
  EXPECT_EQ(rig.snapshot().imu.health, SourceState::fresh);
  EXPECT_EQ(rig.snapshot().imu.time, at);
  EXPECT_EQ(rig.snapshot().imu.sample.angular_velocity_radps.z, 0.25);
}
TEST_F(AnEngine, IgnoresMeasurementsOfThingsItDoesNotHave) {
  rig.tick();
  Measurement m;
  m.time = m.received = rig.now;
  m.value = AxisMotion{15, 1, 1, 1};
  rig.engine->on_measurement(m);
  m.value = AxisStatus{200, AxisState::fault, 1};
  rig.engine->on_measurement(m);
  rig.engine->on_words(m, "x");
  m.value = AxisTemperature{99, 1, 1};
  rig.engine->on_measurement(m);
  m.value = AxisSupply{99, 1, 1};
  rig.engine->on_measurement(m);
  m.value = LineState{static_cast<Line>(9), true};
  rig.engine->on_measurement(m);
  rig.tick();
  EXPECT_EQ(rig.snapshot().axes.size(), 4U);
}

}  // namespace
}  // namespace drover::engine
