// What holds in every mission.

#include "mission/support.h"
#include "support/protoc.h"

namespace drover::mission {
namespace {

using testing::IsEmpty;

// The configured bound on the predicted error while driving (estimate.bound_run_m, default).
constexpr double kBoundRun_m = 0.25;

std::string bytes_of_hex(std::string_view digits) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes += static_cast<char>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16));
  return bytes;
}

/// In protoc's text: the member behind this opening; NaN when there is none.
double number_after(const std::string& text, const char* opening, const std::string& name) {
  const auto from = text.find(opening);
  const auto at = from == std::string::npos ? from : text.find(name, from);
  return at == std::string::npos ? NAN : std::stod(text.substr(at + name.size()));
}

class EveryMission : public testing::TestWithParam<const char*> {
 protected:
  const Record& log() const { return record(GetParam()); }
};

TEST_P(EveryMission, SendsNoFrameThatIsNotOnTheList) {
  EXPECT_THAT(check_frames(log()), IsEmpty());
}

TEST_P(EveryMission, MovesNothingOutsideOfATaskOrAStream) {
  const bool caught = std::string_view(GetParam()).ends_with("_on_ramp") &&
                      !std::string_view(GetParam()).ends_with("kill_on_ramp");
  EXPECT_THAT(check_motion(log(), caught ? Holding::caught : Holding::unmoved), IsEmpty());
}

TEST_P(EveryMission, NeverMovesFartherFromTheTruthThanTheBound) {
  const auto pose = pose_figures(log(), kNever, Time::max());
  std::printf("  pose error in motion: RMS %.1f, max %.1f mm; heading RMS %.2f, max %.2f degrees\n",
              1000 * pose.rms_m, 1000 * pose.max_m, pose.rms_deg, pose.max_deg);
  EXPECT_THAT(check_truth(log(), kBoundRun_m), IsEmpty());
}

TEST_P(EveryMission, TellsItsStatusInTheDocumentsWords) {
  EXPECT_THAT(check_form(log()), IsEmpty());
}

/// Nobody else is there: what is busy is with drover-guard, where it belongs.
TEST_P(EveryMission, WarnsOfNoLineThatTheGuardHas) {
  const std::string told = said(log(), "droverd.log");
  EXPECT_THAT(told, testing::Not(testing::ContainsRegex("(warning|error): [^\n]*resource busy")));
}

TEST_P(EveryMission, TellsItsStatusTenTimesASecond) {
  EXPECT_THAT(check_rate(log()), IsEmpty());
}

TEST_P(EveryMission, TellsPoseAndPositionOfOneInstant) {
  EXPECT_THAT(check_pose(log()), IsEmpty());
}

TEST_P(EveryMission, SendsAimrtPacketsThatProtocReads) {
  const auto newest = [this](std::string_view type, Time before = Time::max()) -> std::string {
    for (auto line = log().mqtt.rbegin(); line != log().mqtt.rend(); ++line)
      if (line->time < before && line->topic.ends_with("." + std::string(type)))
        return test::protoc_decoded(type, test::message_of_packet(bytes_of_hex(line->payload)));
    return "none";
  };
  // While it moved: a drive that lost its supply counts from zero again, and zeros are left out.
  const auto moving = log().moving();
  const auto joints = newest("JointState", moving.empty() ? Time::max() : moving.back().time);
  for (const auto& name : log().joints)
    EXPECT_THAT(joints, testing::HasSubstr("name: \"" + name + "\"\n  position: "));
  if (log().bumper) {
    EXPECT_THAT(newest("TouchState"), testing::HasSubstr("names: \"bumper\""));
  }
  const auto imu = newest("ImuState");
  EXPECT_THAT(imu, testing::HasSubstr("frame_id: \"base_link\""));
  for (const char* member : {"orientation", "angular_velocity", "linear_acceleration"})
    // Then any of its numbers: one that is zero is left out.
    EXPECT_THAT(imu, testing::HasSubstr("\n" + std::string(member) + " {\n  "));
  EXPECT_NEAR(number_after(imu, "\nlinear_acceleration {", "  z: "), 9.8, 0.5);
  EXPECT_NEAR(number_after(imu, "\nangular_velocity {", "  z: "), 0, 0.2) << "it is at rest";
}

TEST_P(EveryMission, SendsAimrtStatesAtTheirRates) {
  EXPECT_THAT(check_aimrt_rates(log()), IsEmpty());
}

TEST_P(EveryMission, IsAtRestAtItsEnd) {
  const Time end = log().event("the end");
  EXPECT_THAT(log().moving(end - 100ms, Time::max()), IsEmpty());
  EXPECT_NEAR(log().truth.back().vx_mps, 0.0, 0.01);
}

INSTANTIATE_TEST_SUITE_P(
    Each, EveryMission,
    testing::Values(
        "straight_and_uturn", "three_point_turn", "figure8", "gnss_outage", "fix_float_fix",
        "estop", "estop_tap", "obstacle", "broker_restart", "kill_on_ramp", "hang", "long",
        "imu_faults", "battery_faults", "battery_empty", "outage_on_curve", "receiver_replugged",
        "receiver_renamed", "joint_commands", "bus_off", "can_replugged", "chip_replugged",
        "hang_without_bus", "heading_find", "battery_low", "runs_on", "carried", "gear_ratio_10",
        "gear_ratio_2", "sides_swapped", "axle_crossed", "wheel_reversed", "restart_on_ramp",
        "dip_on_ramp", "stop_and_kill", "brake_on_ramp", "worm_gear_on_ramp", "rolls_on_ramp",
        "runs_on_ramp", "rest_on_ramp", "stop_while_hung", "frozen_broker", "joint_obstacle",
        "joint_turns", "jump_over_restart", "long_dip_on_ramp", "dip_down_on_ramp",
        "cancel_under_zeros", "guard_dies_on_ramp", "zlac8015d", "zlac8015d_kill_on_ramp",
        "zlac8015d_over_current", "zlac8015d_torn_motor", "zlac8015d_dip_on_ramp",
        "zlac8015d_mute_on_ramp", "cia402", "cia402_kill_on_ramp", "cia402_dead",
        "cia402_mute_on_ramp", "unheard_on_ramp", "one_of_each_dies", "gt01", "gt01_can",
        "gt01_kill", "gt01_can_kill", "gt01_torn", "gt01_rest_on_ramp", "gt01_deaf_on_ramp",
        "zlac8015d_alone_on_ramp", "gt01_alone_on_ramp", "gt01_can_alone_on_ramp",
        "agilex_v2_faults", "agilex_v2_estop_on_ramp", "agilex_v2_alone_on_ramp",
        "gt01_pushed_over_restart", "agilex_v2", "agilex_v2_imu_silent", "agilex_v2_kill", "arm",
        "arm_faults", "arm_hung", "arm_restart", "arm_led", "arm_sinks", "arm_holds", "arm_steps",
        "arm_push", "arm_kill", "scout_arm", "scout_arm_kill", "scout_arm_bus",
        "scout_arm_bus_late", "scout_arm_estop", "cubemars_arm", "cubemars_arm_kill", "arm_trust",
        "arm_mirrored", "arm_release", "arm_presses", "arm_silence", "arm_unheard", "two_arms",
        "mecanum_torn_stuck", "mecanum_sideways_torn", "mecanum_turns_torn", "mecanum_loose",
        "mecanum_every_way", "mecanum_rows", "hunter", "hunter_kill", "hunter_stuck",
        "hunter_backs", "hunter_kill_in_bend", "hunter_unfed", "hunter_remote", "robomaster_stuck",
        "robomaster_mute", "robomaster", "robomaster_silent", "robomaster_kill", "mecanum",
        "mecanum_silent", "mecanum_kill", "both_hang", "mecanum_sideways", "mecanum_sideways_kill",
        "mecanum_unplug_kill", "mecanum_sideways_silent", "scene_backwards", "scene_box",
        "scene_near", "scene_pole", "scene_person", "scene_refused", "scene_keep_out",
        "scene_keep_in", "scene_beside", "scene_pivot", "scene_planes", "scene_mouth",
        "scene_wall_behind", "scene_stamps", "scene_origin", "scene_constraint", "scene_reverse",
        "scene_aside", "scene_edge", "scene_heading", "scene_worker", "scene_restart", "lidar_box",
        "lidar_covered", "lidar_sun", "lidar_frozen", "lidar_unplugged", "lidar_ramp",
        "lidar_pivot", "lidar_pivot_hidden"),
    [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace drover::mission
