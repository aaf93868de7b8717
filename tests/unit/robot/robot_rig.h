// A robot with devices that only remember and repeat.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "sim/robot/robot.h"

namespace drover::sim {

/// A drive with a torque from its last frame, which reports its angle once a tick.
class FakeDrive final : public CanTwin {
 public:
  explicit FakeDrive(std::uint32_t id) : id_(id) {}
  void on_frame(const CanFrame& frame, Time, TwinFrames& out) override {
    if (frame.id != id_) return;
    torque_Nm_ = frame.data[0];
    armed_ = true;
    (void)out.push_back(make_frame(id_ + 0x100, {frame.data[0]}));
  }
  void on_tick(Time now, std::span<Shaft> shafts, TwinFrames& out) override {
    Shaft& shaft = shafts.front();
    shaft.torque_Nm = torque_Nm_;
    shaft.energized = armed_;
    (void)out.push_back(
        make_frame(id_ + (now.time_since_epoch() % kTick == Duration{} ? 0x200 : 0x300)));
  }
  void set_power(bool on, Time) override {
    torque_Nm_ = on ? torque_Nm_ : 0;
    armed_ = on && armed_;
  }
  bool set_fault(std::string_view name, Time) override { return name == "hot" || name.empty(); }

 private:
  std::uint32_t id_;
  double torque_Nm_ = 0;
  bool armed_ = false;
};

struct FakeReceiver final : GnssTwin {
  explicit FakeReceiver(GnssTruth* seen) : last(seen) {}
  std::size_t on_tick(Time, const GnssTruth& truth, std::span<char> out) override {
    *last = truth;
    out[0] = '$';
    return 1;
  }
  bool set_state(std::string_view name, Time) override { return name == "float"; }
  GnssTruth* last;
};

struct FakeSensor final : ImuTwin {
  explicit FakeSensor(ImuTruth* seen) : last(seen) {}
  std::size_t on_tick(Time, const ImuTruth& truth, std::span<char> out) override {
    *last = truth;
    out[0] = 'U';
    return 1;
  }
  void on_bytes(std::span<const std::uint8_t>, Time) override {}
  std::uint32_t baud() const override { return 9600; }
  bool set_state(std::string_view name, Time) override { return name.empty() || name == "frozen"; }
  ImuTruth* last;
};

/// On a bus: tells once a tick how fast it turns, in mrad/s, and answers what it hears.
struct FakeCanSensor final : CanImuTwin {
  void on_frame(const CanFrame& frame, Time, TwinFrames& out) override {
    if (frame.id == 0x600) (void)out.push_back(make_frame(0x580));
  }
  void on_tick(Time, const ImuTruth& truth, TwinFrames& out) override {
    const auto turn = static_cast<std::int8_t>(1000 * truth.angular_velocity_radps.z);
    (void)out.push_back(make_frame(0x188, {static_cast<std::uint8_t>(turn)}));
  }
  bool set_state(std::string_view name, Time) override {
    restarts += name == "restart" ? 1 : 0;
    return name.empty() || name == "silent" || name == "restart";
  }
  int restarts = 0;
};

class RobotTest : public testing::Test {
 protected:
  RobotTest() {
    scenario.world = std::string(DROVER_SOURCE_DIR) + "/sim/worlds/field.xml";
    scenario.origin_latitude_deg = 52;
    scenario.origin_longitude_deg = 13;
    scenario.buses = {{"can0", CanKind::vcan}, {"can1", CanKind::vcan}};
    for (const auto* joint : {"front_left", "front_right", "rear_left", "rear_right"})
      scenario.drives.emplace_back().joints = {joint};
    scenario.gnss.emplace();
    scenario.gnss->antenna_x_m = 1;
  }
  Robot make() {
    Twins twins;
    for (std::uint32_t i = 0; i < scenario.drives.size(); ++i)
      twins.drives.push_back(std::make_unique<FakeDrive>(i + 1));
    twins.gnss = std::make_unique<FakeReceiver>(&seen);
    if (scenario.imu && scenario.imu->bus) {
      auto sensor = std::make_unique<FakeCanSensor>();
      on_can = sensor.get();
      twins.can_imu = std::move(sensor);
    } else if (scenario.imu) {
      twins.imu = std::make_unique<FakeSensor>(&felt);
    }
    return {scenario, std::move(twins)};
  }
  void run(Robot& robot, Duration time) {
    for (const Time end = now + time; now < end; now += kTick) robot.step(now);
  }
  Scenario scenario;
  GnssTruth seen;
  ImuTruth felt;
  FakeCanSensor* on_can = nullptr;
  Time now{std::chrono::seconds(100)};
};

}  // namespace drover::sim
