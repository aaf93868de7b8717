// A robot that was stopped and should be at rest, and may be pushed, carried or drive on.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <random>

#include "engine_fixture.h"

namespace drover::engine {

using ::testing::HasSubstr;

inline constexpr WheelSpeeds kStraight{3, 3};  // about 0.5 m/s
inline constexpr WheelSpeeds kCircle{1, 4};
inline constexpr WheelSpeeds kRollsBack{-1.5, -1.5};
inline constexpr WheelSpeeds kRollsFast{-10, -10};  // 1.65 m/s

class ARobotThatShouldRest : public AnEngine {
 protected:
  ARobotThatShouldRest() {
    rig.imu = true;
    rig.tells_speed = true;
  }
  void freeze_encoders() {
    for (auto& drive : rig.drives) drive.stuck = true;
  }
  bool relay() const { return rig.out.outputs[static_cast<std::size_t>(Output::enable_relay)]; }
  bool lets_go() const { return rig.out.axes[0].request == AxisRequest::idle; }
  /// Whether the power was cut meanwhile.
  bool cut_within_s(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) {
      rig.tick();
      if (lets_go()) return true;
    }
    return false;
  }
  void drive_again() {
    rig.start(path, 40, 0.5);
    rig.run_s(3);
    EXPECT_GT(rig.fastest_command_radps(), 1) << rig.why();
  }
  void rest_s(double seconds) {
    rig.run_s(seconds);
    ASSERT_FALSE(lets_go());
    ASSERT_TRUE(relay());
  }
  std::string told() const {
    std::string all;
    for (const Notice& notice : rig.said<Notice>()) all += std::string(notice.text.view()) + "\n";
    return all;
  }
};

/// How many robots of a kind; more by DROVER_SEEDS.
inline int seeds() {
  const char* asked = std::getenv("DROVER_SEEDS");
  return asked == nullptr ? 4 : std::max(1, std::atoi(asked));
}

/// A number between two; the same for the same seed.
class Any {
 public:
  explicit Any(int seed) : random_(static_cast<unsigned>(seed)) {}
  double operator()(double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<>()(random_);
  }

 private:
  std::mt19937 random_;
};

}  // namespace drover::engine
