#include "runtime/scene_loop.h"

#include <gtest/gtest.h>

#include <thread>

#include "config/load.h"
#include "runtime/clock.h"

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;

TEST(ASceneLoop, LooksAgainAndAgainFromWhereTheRobotIs) {
  auto config = config::load_file(DROVER_SOURCE_DIR "/sim/robots/field_scene.drover.json").config;
  config.control.realtime = false;
  const auto exchange = std::make_unique<SceneExchange>();
  SceneLoop loop(config, *exchange, std::make_shared<const store::StoredScene>());
  std::atomic<bool> stop{false};
  std::thread thread([&] { loop.run(stop); });
  const auto wait_until = [](auto done) {
    for (int i = 0; i < 2000; ++i) {
      if (done()) return true;
      std::this_thread::sleep_for(5ms);
    }
    return false;
  };
  EXPECT_TRUE(wait_until([&] { return loop.turns() > 3; }));
  EXPECT_EQ(exchange->sight.clearance.latest().number, 0U) << "nobody said where it is";

  Viewpoint from;
  from.pose.position_sigma_m = from.pose.yaw_sigma_rad = 0.01;
  const auto is_seen = [&] {
    from.t = from.pose.time = monotonic_now();
    exchange->sight.viewpoint.back() = from;
    exchange->sight.viewpoint.publish();
    const auto& found = exchange->sight.clearance.latest();
    return found.number > 5 && found.clearance.t != kNever && found.clearance.unknown.empty();
  };
  EXPECT_TRUE(wait_until(is_seen));
  const Time first = exchange->sight.clearance.latest().clearance.t;
  EXPECT_TRUE(wait_until(
      [&] { return is_seen() && exchange->sight.clearance.latest().clearance.t > first; }));
  stop = true;
  thread.join();
}

}  // namespace
}  // namespace drover::runtime
