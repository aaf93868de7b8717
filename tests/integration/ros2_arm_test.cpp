// One arm, and two programs that command it at once: one over MQTT, one over ROS 2.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "integration/ros2_drive_rig.h"
#include "json/located_json.h"
#include "mission/wire_damiao.h"
#include "ros2/writer_names.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;

enum class Way : std::uint8_t { mqtt, ros2 };

constexpr const char* kCommandArray =
    "/channel/%2Fjoint_command/pb%3Aaimrt.protocols.sensor.JointCommandArray";
constexpr double kStiffness = 60;
constexpr double kDamping = 2;
constexpr double kNear_rad = 0.05;
/// Nothing of a step: what it may go in 400 ms, of the 1.2 rad between what the two ask.
constexpr double kStep_rad = 0.2;
/// Longer than the pause that whoever was stopped has to make.
constexpr Duration kPause = 1500ms;

constexpr double asks_rad(Way way) {
  return way == Way::mqtt ? 0.6 : -0.6;
}

/// A column that turns, as that of sim/robots/field_arm; wider in time, like the rest of the rig.
class ArmByBothWays : public MovedFromRos2, public testing::WithParamInterface<Way> {
 protected:
  ArmByBothWays() : MovedFromRos2(R"("joint_command": true)") {
    const auto before = [](const std::string& what, const std::string& more) {
      return more + ", " + what;
    };
    edit("sim.json", "worlds/field.xml", "worlds/field_arm.xml");
    edit("sim.json", R"("can0": {"kind")",
         before(R"("can0": {"kind")", R"("can1": {"kind": "unix"})"));
    const std::string wheel = R"({"joint": "front_left")";
    edit("sim.json", wheel,
         before(wheel, R"({"joint": "base_yaw", "driver": "damiao", "bus": "can1",
      "own_supply": true, "options": {"id": 1, "model": "DM4340"}})"));
    const std::string bus = R"("can0": {"can")";
    edit("drover.json", bus,
         before(bus, R"("can1": {"can": "unix:)" + folder().string() + R"(/sim/can1.sock"})"));
    const std::string devices = R"("devices": {)";
    edit("drover.json", devices, devices + R"("base_yaw": {"driver": "damiao", "link": "can1",
      "options": {"id": 1, "model": "DM4340", "timeout_ms": 1000, "stale_s": 1}},)");
    const std::string groups = R"("groups": {)";
    edit("drover.json", groups, groups + R"("arm": {"joints": {"base_yaw": {"min_rad": -2.5,
      "max_rad": 2.5, "max_velocity_radps": 0.5, "max_effort_Nm": 10, "stiffness_Nmprad": 60,
      "damping_Nmsprad": 2, "timeout_s": 1, "carries_weight": false}}},)");
    add_section(R"("aimrt": {"max_command_age_ms": 1000})");
  }

  void say(Way way) {
    if (way == Way::mqtt) {
      std::array<char, 200> text{};
      std::snprintf(text.data(), text.size(),
                    R"({"joints":[{"name":"base_yaw","position":%g,"stiffness":%g,"damping":%g}]})",
                    asks_rad(way), kStiffness, kDamping);
      client().publish(kCommandArray, std::string("\x04json\0", 6) + text.data());
      return;
    }
    aimrt_msgs_msg_dds__JointCommand_ joint{};
    joint.name_ = const_cast<char*>("base_yaw");
    joint.position_ = asks_rad(way);
    joint.stiffness_ = kStiffness;
    joint.damping_ = kDamping;
    aimrt_msgs_msg_dds__JointCommandArray_ message{};
    message.header_.frame_id_ = const_cast<char*>("");
    message.joints_._buffer = &joint;
    message.joints_._length = message.joints_._maximum = 1;
    dds_write(writer_, &message);
  }
  /// Each of them at 50 Hz and in turn. What is looked for takes a while: it is now and then.
  bool say_until(std::initializer_list<Way> ways, const std::function<bool()>& done) {
    constexpr int kBetweenLooks = 10;
    int round = 0;
    const auto say_all = [&] {
      for (const Way way : ways) say(way);
    };
    return repeat_until(say_all, 20ms, [&] { return ++round % kBetweenLooks == 0 && done(); });
  }
  /// As drover status --json tells it of the arm.
  std::string told(const char* what) {
    const auto document = json::parse(drover({"status", "--json"}).text);
    const auto* seen = document ? document->root.find("status") : nullptr;
    const auto* groups = seen == nullptr ? nullptr : seen->find("groups");
    const auto* all = groups == nullptr ? nullptr : groups->list();
    const auto* text = all == nullptr || all->empty() ? nullptr : all->front().find(what);
    return text == nullptr || text->text() == nullptr ? "" : *text->text();
  }
  double arm_rad() {
    const auto truth = json::parse(sim({"truth"}));
    const auto* arm = truth ? truth->root.find("arm_rad") : nullptr;
    const auto* at = arm == nullptr ? nullptr : arm->find("base_yaw");
    return at == nullptr ? NAN : at->number().value_or(NAN);
  }
  bool obeys(Way way) {
    return told("owner") == (way == Way::mqtt ? "broker" : "ros2") &&
           std::abs(arm_rad() - asks_rad(way)) < kNear_rad;
  }
  /// As what stands in the journal names him.
  std::string name(Way way) const {
    if (way == Way::mqtt) return "JointCommandArray (json)";
    dds_guid_t guid{};
    EXPECT_EQ(dds_get_guid(writer_, &guid), DDS_RETCODE_OK);
    return ros2::guid_text(guid);
  }
  bool is_told_that(Way owner, Way other) {
    return daemon().output().find(
               "joint command refused: two programs write joint commands: " + name(owner) +
               " has the joints, " + name(other) + " is refused") != std::string::npos;
  }
  /// Both for so long, and the arm stays where it is.
  void expect_no_motion_while_both_say(std::chrono::seconds time) {
    const double place = arm_rad();
    const double end_s = now_s() + std::chrono::duration<double>(time).count();
    double strayed = 0;
    (void)say_until({Way::mqtt, Way::ros2}, [&] {
      strayed = std::max(strayed, std::abs(arm_rad() - place));
      return now_s() > end_s;
    });
    EXPECT_LT(strayed, kNear_rad) << "from " << place;
  }
  /// Ends all and looks at what the motor was told.
  void expect_no_step_on_the_bus() {
    stop_daemon();
    (void)set_points_on_the_bus();  // ends the simulator
    std::ifstream file(folder() / "log" / "can.log");
    double last = NAN, lowest = 0, highest = 0, step = 0;
    for (std::string line; std::getline(file, line);) {
      double time_s = 0;
      CanFrame frame;
      std::array<unsigned, 8> data{};
      if (std::sscanf(line.c_str(), "(%lf) can1 %3x#%2x%2x%2x%2x%2x%2x%2x%2x", &time_s, &frame.id,
                      &data[0], &data[1], &data[2], &data[3], &data[4], &data[5], &data[6],
                      &data[7]) != 10)
        continue;
      frame.len = 8;
      std::copy(data.begin(), data.end(), frame.data.begin());
      const auto point = mission::damiao::set_point(frame);
      if (!point || point->joint != 0) continue;
      if (point->stiffness > 0 && std::isfinite(last))
        step = std::max(step, std::abs(point->position_rad - last));
      last = point->stiffness > 0 ? point->position_rad : NAN;
      lowest = std::min(lowest, point->position_rad);
      highest = std::max(highest, point->position_rad);
    }
    EXPECT_NEAR(lowest, asks_rad(Way::ros2), kNear_rad);
    EXPECT_NEAR(highest, asks_rad(Way::mqtt), kNear_rad);
    std::printf("  largest step of its set point: %.3f rad\n", step);
    EXPECT_LT(step, kStep_rad);
  }
};

TEST_P(ArmByBothWays, FollowsOneOfThemOnly) {
  const Way first = GetParam();
  const Way second = first == Way::mqtt ? Way::ros2 : Way::mqtt;
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::joint_command_kind()));
  ASSERT_TRUE(say_until({first}, [&] { return obeys(first); })) << status();
  // Who comes second is refused by name, however long he goes on.
  ASSERT_TRUE(say_until({first, second}, [&] { return is_told_that(first, second); }))
      << daemon().output();
  expect_no_motion_while_both_say(3s);
  EXPECT_TRUE(obeys(first)) << status();
  EXPECT_THAT(status(), testing::HasSubstr(name(second) + " is refused"));
  // He gets it from where it is when the first one is silent, who is then refused in his turn.
  ASSERT_TRUE(say_until({second}, [&] { return obeys(second); })) << status();
  ASSERT_TRUE(say_until({second, first}, [&] { return is_told_that(second, first); }))
      << daemon().output();
  expect_no_motion_while_both_say(2s);
  EXPECT_TRUE(obeys(second)) << status();
  // A stop ends both, and nobody is followed who does not pause.
  EXPECT_EQ(drover({"task", "cancel"}).code, 0);
  expect_no_motion_while_both_say(3s);
  EXPECT_EQ(told("owner"), "nobody");
  EXPECT_THAT(told("reason"), testing::HasSubstr("pause your commands for a second"));
  (void)wait_until([] { return false; }, kPause);
  ASSERT_TRUE(say_until({first}, [&] { return obeys(first); })) << status();
  expect_no_step_on_the_bus();
}

INSTANTIATE_TEST_SUITE_P(First, ArmByBothWays, testing::Values(Way::mqtt, Way::ros2),
                         [](const auto& one) { return one.param == Way::mqtt ? "Mqtt" : "Ros2"; });

}  // namespace
}  // namespace drover::test
