// A spare receiver, inertial sensor or battery takes over, and the robot drives on; or comes to
// rest where that could make it jump.
#include "engine_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

SensorList two(const char* first, const char* second, Role role = Role::spare) {
  SensorList list;
  (void)list.push_back({first, Role::steers});
  (void)list.push_back({second, role});
  return list;
}

/// The rig's receiver is the front one. The rear one stands elsewhere and has its line across.
class AnEngineWithTwoReceivers : public AnEngine {
 protected:
  AnEngineWithTwoReceivers() { build({-0.4, 0.2, 0, 90}); }
  void build(const AntennaConfig& configured) {
    EngineConfig config = rig_config();
    config.receivers = two("front", "rear");
    (void)config.estimate.antennas.push_back({0.2, 0, 0, 0});
    (void)config.estimate.antennas.push_back(configured);
    rig = EngineRig(config);
    config.estimate.antennas.clear();
    config.estimate.antenna_x_m = kThere.x_m;
    config.estimate.antenna_y_m = kThere.y_m;
    rear.emplace(config.estimate, config.base);
    rear->set_origin(kRigOrigin);
  }
  void tick() {
    rig.environment.gnss[1].state = rear_silent ? SourceState::stale : SourceState::fresh;
    if (!rear_silent) rig.environment.gnss[1].last_good = rig.now;
    if (!rear_silent && ++ticks % 20 == 0) {
      const Pose pose = rig.plant.estimate();
      const GeodeticPoint antenna = rear->antenna_geodetic(pose);
      GnssPosition position;
      position.latitude_deg = antenna.latitude_deg;
      position.longitude_deg = antenna.longitude_deg;
      position.altitude_msl_m = 455;
      position.undulation_m = 45;
      position.quality = FixQuality::rtk_fixed;
      position.correction_age_s = 1;
      measure(position);
      measure(GnssHeading{wrap_deg(compass_deg_from_yaw_rad(pose.yaw_rad) + 90)});
    }
    rig.tick();
  }
  void run_s(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) tick();
  }
  template <class Value>
  void measure(const Value& value) {
    Measurement m;
    m.time = m.received = rig.now;
    m.value = value;
    m.source = 1;
    rig.engine->on_measurement(m);
  }
  void drive_with_both() {
    tick();
    rig.set_origin();
    run_s(8);
    rig.start(path, 40, 0.5);
    run_s(6);
    ASSERT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why();
  }
  bool in_use(std::size_t sensor) const { return rig.snapshot().sensors[sensor].in_use; }
  double off_m() const {
    const Pose pose = rig.plant.estimate();
    return std::hypot(rig.snapshot().pose.x_m - pose.x_m, rig.snapshot().pose.y_m - pose.y_m);
  }

  static constexpr AntennaConfig kThere{-0.4, 0.2, 0, 90};
  std::optional<Estimator> rear;
  bool rear_silent = false;
  int ticks = 0;
};

TEST_F(AnEngineWithTwoReceivers, DrivesOnWithTheSpareAndTellsIt) {
  drive_with_both();
  EXPECT_TRUE(in_use(0));
  rig.receiver_silent = true;
  double worst_m = 0;
  for (int i = 0; i < 400; ++i) {
    tick();
    worst_m = std::max(worst_m, off_m());
  }
  EXPECT_TRUE(in_use(1));
  EXPECT_LT(worst_m, 0.05) << "no jump";
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why();
  EXPECT_EQ(rig.why(), "front gives nothing to go by: rear steers in its place");
  EXPECT_EQ(rig.snapshot().gnss.health, SourceState::fresh);
  const GnssSnapshot& gnss = rig.snapshot().gnss;
  EXPECT_NEAR(gnss.heading_deg, gnss.pose_heading_deg, 1);
  EXPECT_EQ(wrap_deg(gnss.receiver_heading_deg - kThere.heading_baseline_offset_deg),
            gnss.heading_deg)
      << "beside it what the receiver itself says of its antennas";
  run_s(40);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why();
}

TEST_F(AnEngineWithTwoReceivers, StopsAsWithOneWhenTheSpareDiesToo) {
  drive_with_both();
  rig.receiver_silent = true;
  run_s(3);
  rear_silent = true;
  run_s(30);
  EXPECT_TRUE(rig.snapshot().nav.paused);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(rig.why(), HasSubstr("receiver rear silent for"));
}

TEST_F(AnEngineWithTwoReceivers, ComesBackToTheFirstOnlyAtRest) {
  drive_with_both();
  rig.receiver_silent = true;
  run_s(3);
  rig.receiver_silent = false;
  run_s(15);
  EXPECT_TRUE(in_use(1)) << "while it moves";
  EXPECT_THAT(rig.why(), HasSubstr("front is back, and taken again when the robot stands"));
  rig.command(CancelTask{});
  run_s(5);
  EXPECT_TRUE(in_use(0));
  EXPECT_EQ(rig.why(), "");
  EXPECT_LT(off_m(), 0.05);
}

/// Somebody measured its place wrongly, by more than both are uncertain.
TEST_F(AnEngineWithTwoReceivers, IsNotMovedByASpareThatStandsElsewhereThanConfigured) {
  build({0.4, 0.2, 0, 90});
  drive_with_both();
  EXPECT_THAT(rig.why(), HasSubstr("the spare rear contradicts the position"));
  rig.receiver_silent = true;
  double worst_m = 0;
  for (int i = 0; i < 200 * 40; ++i) {
    tick();
    if (rig.snapshot().nav.status == NavStatus::run) worst_m = std::max(worst_m, off_m());
  }
  EXPECT_LT(worst_m, 0.3);
  EXPECT_NE(rig.snapshot().nav.status, NavStatus::success);
  EXPECT_EQ(rig.fastest_command_radps(), 0) << "it came to rest";
}

class AnEngineWithTwoImus : public AnEngine {
 protected:
  AnEngineWithTwoImus() {
    EngineConfig config = rig_config();
    config.imus = two("imu", "imu_rear");
    rig = EngineRig(config);
    rig.imu = true;
  }
  void tick() {
    rig.environment.imu[1].state = SourceState::fresh;
    rig.environment.imu[1].last_good = rig.now;
    ImuSample sample;
    sample.acceleration_mps2 = gravity_mps2;
    sample.angular_velocity_radps.z = rig.plant.truth().wz_radps + bias_radps;
    Measurement m;
    m.time = m.received = rig.now;
    m.value = sample;
    m.source = 1;
    rig.engine->on_measurement(m);
    rig.tick();
    if (!first_dead) return;
    rig.imu = false;
    rig.environment.imu[0].state = SourceState::stale;
  }
  void run_s(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) tick();
  }
  void drive_with_both() {
    tick();
    rig.set_origin();
    run_s(8);
    rig.start(path, 40, 0.5);
    run_s(6);
    ASSERT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why();
  }

  Vector3 gravity_mps2{0, 0, 9.81};
  double bias_radps = 0.01;
  bool first_dead = false;
};

TEST_F(AnEngineWithTwoImus, GoesByTheZeroThatTheSpareShowedAtRest) {
  drive_with_both();
  first_dead = true;
  run_s(1);
  EXPECT_TRUE(rig.snapshot().sensors[1].in_use);
  EXPECT_NEAR(rig.snapshot().imu.gyro_bias_radps.z, bias_radps, 0.002);
  EXPECT_EQ(rig.snapshot().imu.health, SourceState::fresh);
  EXPECT_EQ(rig.why(), "imu gives nothing to go by: imu_rear steers in its place");
  run_s(45);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why();
}

/// Mounted otherwise than configured it tells of a slope that is not there.
TEST_F(AnEngineWithTwoImus, DrivesOnWithoutOneRatherThanWithASpareThatIsMountedWrongly) {
  gravity_mps2 = {-9.81 * std::sin(0.2), 0, 9.81 * std::cos(0.2)};
  drive_with_both();
  EXPECT_THAT(rig.why(), HasSubstr("the spare imu_rear contradicts the other IMU"));
  first_dead = true;
  run_s(2);
  EXPECT_FALSE(rig.snapshot().sensors[1].in_use);
  EXPECT_THAT(rig.why(), HasSubstr("imu"));
  rig.command(CancelTask{});
  run_s(5);
  EXPECT_TRUE(rig.snapshot().sensors[1].in_use) << "at rest it is better than none";
}

class AnEngineWithTwoBatteries : public AnEngine {
 protected:
  explicit AnEngineWithTwoBatteries(Role second = Role::steers) {
    EngineConfig config = rig_config();
    config.battery_configured = true;
    config.batteries = two("left_pack", "right_pack", second);
    config.health.battery_stale_s = 120;
    rig = EngineRig(config);
    tell(0, 70);
    tell(1, 60);
  }
  void tell(std::uint8_t source, double percent, bool charger = false) {
    rig.environment.battery[source].state = SourceState::fresh;
    BatterySample sample;
    sample.soc_percent = percent;
    sample.charger_connected = charger;
    Measurement m;
    m.time = m.received = rig.now;
    m.value = sample;
    m.source = source;
    rig.engine->on_measurement(m);
  }
};

TEST_F(AnEngineWithTwoBatteries, ShowsTheEmptierAndGoesByTheWorse) {
  drive();
  EXPECT_EQ(rig.snapshot().battery.sample.soc_percent, 60);
  tell(0, 70, true);
  rig.run_s(3);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
  EXPECT_THAT(rig.why(), HasSubstr("charging"));
}

TEST_F(AnEngineWithTwoBatteries, NamesTheOneThatIsSilent) {
  drive();
  rig.environment.battery[1].state = SourceState::stale;
  rig.run_s(1);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run);
  EXPECT_EQ(rig.why(), "right_pack unknown: no answer");
  EXPECT_EQ(rig.snapshot().battery.sample.soc_percent, 70) << "of the one that is heard";
}

class AnEngineWithASpareBattery : public AnEngineWithTwoBatteries {
 protected:
  AnEngineWithASpareBattery() : AnEngineWithTwoBatteries(Role::spare) {}
};

TEST_F(AnEngineWithASpareBattery, GoesByItOnlyWhileTheOtherIsSilent) {
  tell(1, 60, true);
  drive();
  EXPECT_EQ(rig.snapshot().battery.sample.soc_percent, 70);
  rig.environment.battery[0].state = SourceState::stale;
  rig.run_s(3);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
  EXPECT_THAT(rig.why(), HasSubstr("charging"));
}

}  // namespace
}  // namespace drover::engine
