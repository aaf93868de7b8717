#include <gtest/gtest.h>

#include <cmath>

#include "drover/angle.h"
#include "drover/rotation.h"
#include "unit/drivers/witmotion/rig.h"

namespace drover::witmotion {
namespace {

using namespace std::chrono_literals;

TEST(WitmotionDriver, RejectsOptionsThatCannotBe) {
  const auto make = [](OptionList list) { WitmotionDriver driver(options_with(list)); };
  EXPECT_NO_THROW(make({}));
  EXPECT_THROW(make({{"rate_Hz", 99.0}}), std::runtime_error);
  EXPECT_THROW(make({{"baud", 100000.0}}), std::runtime_error);
  EXPECT_THROW(make({{"baud", 9600.0}}), std::runtime_error);
  EXPECT_NO_THROW(make({{"baud", 9600.0}, {"rate_Hz", 20.0}}));
  EXPECT_THROW(make({{"stale_s", 0.01}}), std::runtime_error);
  EXPECT_THROW(make({{"use_magnetic_yaw", true}, {"orientation", std::string("none")}}),
               std::runtime_error);
}

TEST(WitmotionDriver, TellsEveryCycleOfAHundredHertz) {
  Rig rig;
  rig.run(10s);
  EXPECT_NEAR(static_cast<double>(rig.samples), 1000, 5);
  EXPECT_EQ(rig.reason(), "");
  EXPECT_NEAR(rig.sample.temperature_degC, 31, 0.2);
  EXPECT_FALSE(rig.sample.has_magnetic_field);
}

TEST(WitmotionDriver, StampsASampleWithTheFirstByteOfItsCycle) {
  WitmotionDriver driver(options_with({}));
  std::vector<std::uint8_t> cycle;
  for (const FrameType type :
       {FrameType::acceleration, FrameType::angular_rate, FrameType::angles}) {
    std::array<std::uint8_t, kFrameSize> frame{kHeader, static_cast<std::uint8_t>(type)};
    frame.back() = checksum({frame.data(), kFrameSize - 1});
    cycle.insert(cycle.end(), frame.begin(), frame.end());
  }
  DriverOut out;
  const Time start{100s};
  driver.on_bytes({cycle.data(), 20}, start, out);
  EXPECT_TRUE(out.measurements.empty());
  // The rest is held up on its way.
  driver.on_bytes({cycle.data() + 20, 13}, start + 16ms, out);
  ASSERT_EQ(out.measurements.size(), 1U);
  EXPECT_EQ(out.measurements[0].time, start);
  EXPECT_EQ(out.measurements[0].received, start + 16ms);
  // A chunk that seems to come from before does not turn time back.
  out.clear();
  driver.on_bytes(cycle, start - 5ms, out);
  ASSERT_EQ(out.measurements.size(), 1U);
  EXPECT_EQ(out.measurements[0].time, start);
}

// As its label is printed, X to the right, its own pitch rolls it about the base's x.
TEST(WitmotionDriver, SeesARollWhereTheSensorIsRolledAndItIsNotTold) {
  Rig rig(
      {{"mount_yaw_deg", -90.0}},
      {{"mount_yaw_deg", -90.0}, {"mount_pitch_deg", 1.0}, {"acceleration_bias_sigma_mps2", 0.0}});
  rig.run(2s);
  EXPECT_NEAR(rig.sample.acceleration_mps2.x, 0, 0.05);
  EXPECT_NEAR(rig.sample.acceleration_mps2.y, 9.80665 * std::sin(to_rad(1)), 0.05);
}

TEST(WitmotionDriver, TurnsTheSensorsAxesIntoThoseOfTheBase) {
  // Upside down, and its x to the right.
  Rig rig({{"mount_roll_deg", 180.0}, {"mount_yaw_deg", -90.0}, {"magnetic_field", true}},
          {{"acceleration_bias_sigma_mps2", 0.0}, {"bias_sigma_dps", 0.0}});
  const Quaternion pose = from_angles(to_rad(5), to_rad(-8), to_rad(30));
  rig.truth.orientation = pose;
  rig.truth.specific_force_mps2 = rotate(conjugate(pose), {0, 0, 9.80665});
  rig.run(2s);
  rig.truth.angular_velocity_radps = {0.1, -0.2, 0.3};
  rig.run(20ms);
  const ImuSample& s = rig.sample;
  EXPECT_NEAR(s.acceleration_mps2.x, rig.truth.specific_force_mps2.x, 0.1);
  EXPECT_NEAR(s.acceleration_mps2.y, rig.truth.specific_force_mps2.y, 0.1);
  EXPECT_NEAR(s.acceleration_mps2.z, rig.truth.specific_force_mps2.z, 0.1);
  EXPECT_NEAR(s.angular_velocity_radps.x, 0.1, 0.01);
  EXPECT_NEAR(s.angular_velocity_radps.y, -0.2, 0.01);
  EXPECT_NEAR(s.angular_velocity_radps.z, 0.3, 0.01);
  ASSERT_TRUE(s.has_orientation);
  // Roll and pitch as they are, yaw from where it began.
  const Quaternion wrong = conjugate(from_angles(to_rad(5), to_rad(-8), 0)) * s.orientation;
  EXPECT_GT(std::abs(wrong.w), std::cos(to_rad(1) / 2));
  ASSERT_TRUE(s.has_magnetic_field);
  const Vector3 field = rotate(pose, s.magnetic_field);
  EXPECT_NEAR(field.x, 0, 5);
  EXPECT_NEAR(field.y, 400, 5);
  EXPECT_NEAR(field.z, -400, 5);
}

TEST(WitmotionDriver, TellsTheSameByQuaternionAsByAngles) {
  for (const char* how : {"angles", "quaternion"}) {
    Rig rig({{"orientation", std::string(how)}});
    rig.truth.orientation = from_angles(0.1, 0.05, 0);
    rig.truth.specific_force_mps2 = rotate(conjugate(rig.truth.orientation), {0, 0, 9.80665});
    rig.run(1s);
    const Quaternion wrong = conjugate(rig.truth.orientation) * rig.sample.orientation;
    EXPECT_GT(std::abs(wrong.w), std::cos(to_rad(1) / 2)) << how;
  }
}

TEST(WitmotionDriver, LeavesYawRelativeUnlessTheMagnetometerIsTrusted) {
  const auto yaw_deg = [](bool magnetic) {
    Rig rig({{"use_magnetic_yaw", magnetic}, {"magnetic_yaw_offset_deg", -12.0}});
    rig.truth.orientation = about_z(to_rad(70));
    rig.run(1s);
    const Quaternion& q = rig.sample.orientation;
    return to_deg(2 * std::atan2(q.z, q.w));
  };
  EXPECT_NEAR(yaw_deg(false), 0, 1);
  EXPECT_NEAR(yaw_deg(true), 70, 1);
}

TEST(WitmotionDriver, IsStaleWithinATenthOfASecondWhenReadingsStandStill) {
  Rig rig;
  rig.run(2s);
  ASSERT_TRUE(rig.twin->set_state("frozen", rig.now));
  rig.run(100ms + 50ms + 10ms);
  EXPECT_EQ(rig.state(), SourceState::stale);
  EXPECT_EQ(rig.reason(), "the inertial sensor's readings stand still");
  const auto before = rig.samples;
  rig.run(1s);
  EXPECT_EQ(rig.samples, before);
  ASSERT_TRUE(rig.twin->set_state("", rig.now));
  rig.run(100ms);
  EXPECT_EQ(rig.state(), SourceState::fresh);
}

TEST(WitmotionDriver, TakesARateOfExactlyZeroForRest) {
  Rig rig({},
          {{"rate_sigma_dps", 0.0}, {"bias_sigma_dps", 0.0}, {"bias_walk_dps_per_sqrt_s", 0.0}});
  rig.run(5s);
  EXPECT_EQ(rig.sample.angular_velocity_radps.z, 0);
  EXPECT_EQ(rig.state(), SourceState::fresh);
  EXPECT_EQ(rig.reason(), "");
}

TEST(WitmotionDriver, FlagsSaturatedSamplesAndIsStaleWhenThereAreNoOthers) {
  Rig rig;
  rig.run(1s);
  ASSERT_TRUE(rig.twin->set_state("saturated", rig.now));
  rig.run(20ms);
  EXPECT_TRUE(rig.sample.saturated);
  EXPECT_EQ(rig.state(), SourceState::fresh);
  EXPECT_EQ(rig.reason(), "acceleration or rate was at the end of its range");
  rig.run(80ms);
  EXPECT_EQ(rig.state(), SourceState::stale);
  EXPECT_EQ(rig.reason(), "acceleration or rate is at the end of its range");
}

TEST(WitmotionDriver, TellsGravityOnAWrongAxisAndBelievesNothingThen) {
  Rig rig({{"mount_roll_deg", 90.0}}, {{"mount_roll_deg", 0.0}});
  rig.run(2s);
  EXPECT_EQ(rig.state(), SourceState::stale);
  EXPECT_NE(rig.reason().find("gravity on the wrong axis"), std::string::npos) << rig.reason();
  const auto before = rig.samples;
  rig.run(1s);
  EXPECT_EQ(rig.samples, before);
}

TEST(WitmotionDriver, TakesASlopeForASlope) {
  Rig rig;
  rig.truth.orientation = from_angles(to_rad(15), to_rad(-15), 0);
  rig.truth.specific_force_mps2 = rotate(conjugate(rig.truth.orientation), {0, 0, 9.80665});
  rig.run(3s);
  EXPECT_EQ(rig.state(), SourceState::fresh) << rig.reason();
}

TEST(WitmotionDriver, TellsAWrongPace) {
  Rig rig({{"stale_s", 0.5}});
  ASSERT_TRUE(rig.twin->set_state("rate:20", rig.now));
  rig.run(6s);
  EXPECT_EQ(rig.state(), SourceState::fresh);
  EXPECT_EQ(rig.reason(), "samples come at 20.0 Hz, 100.0 Hz expected");
  ASSERT_TRUE(rig.twin->set_state("rate:1", rig.now));
  rig.run(3s);
  for (const auto before = rig.samples; rig.samples == before;) rig.step();
  rig.run(600ms);
  EXPECT_EQ(rig.state(), SourceState::stale);
}

TEST(WitmotionDriver, AsksForTheBaudWithinTwoSecondsOfBytesWithoutAFrame) {
  Rig rig({{"configure", false}}, {{"factory", true}});
  rig.run(2s);
  EXPECT_EQ(rig.state(), SourceState::never_heard);
  EXPECT_EQ(rig.reason(), "bytes but no frame at 115200: baud, or another device?");
}

TEST(WitmotionDriver, DropsACycleThatLostItsRateAndGoesOn) {
  Rig rig;
  rig.run(1s);
  const auto before = rig.samples;
  DriverOut out;
  const std::array<std::uint8_t, kFrameSize> lone{0x55, 0x51, 1, 0, 0, 0, 0, 8, 0xf6, 9, 0xae};
  rig.made.bytes->on_bytes(lone, rig.now + 2ms, out);
  EXPECT_TRUE(out.measurements.empty());
  rig.run(1s);
  EXPECT_EQ(rig.samples, before + 100);
}

}  // namespace
}  // namespace drover::witmotion
