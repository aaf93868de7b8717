// Joints outside the base: what the configuration says of them, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "unit/config/config_text.h"

namespace drover::config {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const std::string kFolder = DROVER_SOURCE_DIR "/config/examples";

std::string example(const std::string& name = "arm.json") {
  std::ifstream file(kFolder + "/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The example with an arm, and this piece of it replaced.
std::string arm_with(const std::string& piece, const std::string& replacement) {
  auto text = example();
  const auto at = text.find(piece);
  EXPECT_NE(at, std::string::npos) << piece;
  return at == std::string::npos ? text : text.replace(at, piece.size(), replacement);
}

std::string arm_problems(const std::string& piece, const std::string& replacement) {
  return problems(arm_with(piece, replacement), kFolder);
}

TEST(Groups, OfTheExampleAreAnArmOfThreeJoints) {
  const auto loaded = load_text(example(), kFolder);
  ASSERT_THAT(loaded.problems, IsEmpty());
  EXPECT_THAT(loaded.warnings, IsEmpty());
  const auto& engine = loaded.config.engine;
  ASSERT_EQ(engine.groups.size(), 1u);
  EXPECT_EQ(engine.groups[0].name, "arm");
  ASSERT_EQ(engine.groups[0].joints.size(), 3u);
  const auto& turret = engine.groups[0].joints[0];
  EXPECT_EQ(engine.joints[turret.axis], "turret");
  EXPECT_EQ(turret.follows, JointFollows::position);
  EXPECT_EQ(turret.max_effort_Nm, 10);
  const auto& shoulder = engine.groups[0].joints[1];
  EXPECT_EQ(shoulder.follows, JointFollows::impedance);
  EXPECT_TRUE(shoulder.carries_weight);
  EXPECT_EQ(shoulder.on_silence, engine::OnSilence::hold);
}

TEST(Groups, HaveTheirAxesBehindThoseOfTheBase) {
  // Written before the wheels.
  auto text = example();
  const std::string wheel =
      "\"left\": {\"driver\": \"odrive\", \"link\": \"can0\", \"options\": "
      "{\"node\": 0, \"watchdog_timeout_s\": 0.1}},";
  const auto at = text.find(wheel);
  ASSERT_NE(at, std::string::npos);
  text.erase(at, wheel.size());
  text.insert(text.find("\"gnss\": {\"driver\""), wheel + "\n    ");
  const auto loaded = load_text(text, kFolder);
  ASSERT_THAT(loaded.problems, IsEmpty());
  const auto& engine = loaded.config.engine;
  EXPECT_EQ(engine.joints[engine.base.left[0]], "left");
  EXPECT_EQ(engine.joints[engine.base.right[0]], "right");
  EXPECT_LT(engine.base.left[0], 2);
  for (const auto& joint : engine.groups[0].joints) EXPECT_GE(joint.axis, 2);
}

TEST(Groups, AreAllTheJointsBesideABaseThatTakesATwist) {
  const auto loaded = load_text(example("scout_arm.json"), kFolder);
  ASSERT_THAT(loaded.problems, IsEmpty());
  EXPECT_THAT(loaded.warnings, IsEmpty());
  const auto& engine = loaded.config.engine;
  ASSERT_EQ(engine.joints.size(), 3u);
  ASSERT_EQ(engine.groups.size(), 1u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(engine.groups[0].joints[i].axis, i);
  for (const auto& device : loaded.config.devices)
    if (device.name == "chassis") {
      ASSERT_EQ(context_of(device).axes.size(), 1u);
      EXPECT_EQ(context_of(device).axis(0), kBaseAxis);
    }
}

TEST(Groups, AJointOfNoneIsToldBesideATwistToo) {
  auto text = example("scout_arm.json");
  const std::string elbow = "\"elbow\": {\"driver\"";
  text.insert(text.find(elbow),
              "\"spare\": {\"driver\": \"damiao\", \"link\": \"can1\", \"options\": {\"id\": 9, "
              "\"model\": \"DM4310\"}},\n    ");
  EXPECT_THAT(problems(text, kFolder), HasSubstr("\"spare\" is of no group (give it a group of "
                                                 "its own: groups.arm.joints)"));
}

TEST(Groups, RefuseAJointThatIsNone) {
  EXPECT_THAT(arm_problems("\"elbow\": {\"follows\"", "\"elbov\": {\"follows\""),
              HasSubstr("groups.arm.joints.elbov: no device has this joint (did you mean "
                        "\"elbow\"?)"));
  EXPECT_THAT(arm_problems("\"elbow\": {\"follows\"", "\"elbov\": {\"follows\""),
              HasSubstr("\"elbow\" is of no group"));
}

/// Its device is there, under a driver that is not.
TEST(Groups, SayNothingOfAJointWhoseDriverIsUnknown) {
  const auto said =
      arm_problems("\"elbow\": {\"driver\": \"damiao\"", "\"elbow\": {\"driver\": \"damio\"");
  EXPECT_THAT(said, HasSubstr("devices.elbow.driver: \"damio\" is not one of"));
  EXPECT_THAT(said, testing::Not(HasSubstr("no device has this joint")));
}

TEST(Groups, RefuseAWheelAndADriveThatOnlyTurns) {
  EXPECT_THAT(arm_problems("\"turret\": {\"follows\"", "\"left\": {\"follows\""),
              HasSubstr("\"left\" is used by groups.base.left already"));
  EXPECT_THAT(arm_problems("\"turret\": {\"follows\"", "\"left\": {\"follows\""),
              HasSubstr("its drive (odrive) follows a velocity alone"));
  EXPECT_THAT(arm_problems("\"left\": [\"left\"]", "\"left\": [\"elbow\"]"),
              HasSubstr("the drive of \"elbow\" (damiao) is for joints outside the base"));
}

TEST(Groups, RefuseLimitsWithoutRoom) {
  EXPECT_THAT(arm_problems("\"min_rad\": -2.5", "\"min_rad\": 2.5"),
              HasSubstr("groups.arm.joints.turret.max_rad: is 2.5, and min_rad is 2.5"));
  EXPECT_THAT(arm_problems("\"max_effort_Nm\": 10,", ""),
              HasSubstr("groups.arm.joints.turret.max_effort_Nm: is missing"));
  EXPECT_THAT(arm_problems("\"follows\": \"position\"", "\"follows\": \"torque\""),
              HasSubstr("\"torque\" is not one of: impedance, position, velocity, effort"));
}

TEST(Groups, RefuseLimitsThatTheDriveCannotBeTold) {
  EXPECT_THAT(arm_problems("\"min_rad\": -2.5", "\"min_rad\": -143"),
              HasSubstr("groups.arm.joints.turret.min_rad: is -143 rad, and its drive can be told "
                        "-12.5 to 12.5 (are these degrees? One is 0.01745 rad)\n"));
  EXPECT_THAT(arm_problems("\"max_effort_Nm\": 10,", "\"max_effort_Nm\": 1000,"),
              HasSubstr("max_effort_Nm: is 1000 Nm, and its drive can be told 0 to "));
}

TEST(Groups, KnowWhatTheirDrivesCanBeTold) {
  const auto loaded = load_text(example(), kFolder);
  ASSERT_THAT(loaded.problems, IsEmpty());
  for (const auto& joint : loaded.config.engine.groups[0].joints) {
    EXPECT_EQ(joint.drive.stiffness_Nmprad, 500);
    EXPECT_EQ(joint.drive.damping_Nmsprad, 5);
  }
}

TEST(Groups, TellOfAWeightUntilItIsAccepted) {
  const auto loaded = load_text(arm_with("\"falls\"", ""), kFolder);
  ASSERT_THAT(loaded.problems, IsEmpty());
  ASSERT_EQ(loaded.warnings.size(), 2u);
  EXPECT_THAT(loaded.warnings[0].text("f"),
              HasSubstr("groups.arm.joints.shoulder: carries a weight: without power nothing holds "
                        "it; when its line is cut its drive goes limp after 0.100 s"));
  // By what drover-guard has, which is the device's, not the joint's.
  EXPECT_THAT(loaded.warnings[0].text("f"),
              HasSubstr("when droverd dies drover-guard only damps it: it comes down at 0.2 rad/s "
                        "for each Nm of its weight, so with max_effort_Nm at 4.1 rad/s "
                        "(devices.shoulder.options.damping_Nmsprad is 4.9)"));
}

const std::string kShoulder = R"("options": {"id": 2, "model": "DM4340", )"
                              R"("damping_Nmsprad": 4.9})";

/// Of its shoulder, and what stands behind its options.
std::string with_time_out(const std::string& timeout_ms, const std::string& more = "") {
  return arm_with(kShoulder + "}", kShoulder.substr(0, kShoulder.size() - 1) +
                                       ", \"timeout_ms\": " + timeout_ms + "}" + more + "}");
}

TEST(Groups, RefuseAMotorWithoutATimeOutUntilThatIsAccepted) {
  const auto refused = problems(with_time_out("0"), kFolder);
  EXPECT_THAT(refused,
              HasSubstr("devices.shoulder.options: follows its last command for ever: the motor's "
                        "TIMEOUT is 0 (set its watchdog, or \"accept\": [\"no_watchdog\"] when "
                        "that is meant)"));
  EXPECT_EQ(refused.find("elbow"), std::string::npos) << refused;
  EXPECT_THAT(problems(with_time_out("0", ", \"accept\": [\"no_watchdog\"]"), kFolder), IsEmpty());
  EXPECT_THAT(problems(with_time_out("100"), kFolder), IsEmpty());
}

TEST(Groups, TellWhatAWeightDoesWhoseMotorHasNoTimeOut) {
  auto text = with_time_out("0", ", \"accept\": [\"no_watchdog\"]");
  const auto falls = text.find("\"falls\"");
  ASSERT_NE(falls, std::string::npos);
  const auto loaded = load_text(text.replace(falls, 7, ""), kFolder);
  ASSERT_THAT(loaded.problems, IsEmpty());
  ASSERT_EQ(loaded.warnings.size(), 3u);
  EXPECT_THAT(loaded.warnings[0].text("f"),
              HasSubstr("groups.arm.joints.shoulder: carries a weight: without power nothing holds "
                        "it; when its line is cut its drive follows its last command for ever: the "
                        "motor's TIMEOUT is 0; when droverd dies drover-guard only damps it"));
  EXPECT_THAT(loaded.warnings[1].text("f"), HasSubstr("elbow: carries a weight: without power "
                                                      "nothing holds it; when its line is cut its "
                                                      "drive goes limp after 0.100 s"));
  EXPECT_THAT(loaded.warnings[2].text("f"),
              HasSubstr("devices.shoulder.accept: it goes on for ever when its line is cut; there "
                        "is no outputs.enable_relay"));
}

TEST(Groups, RefuseToLetAWeightFallUntilItIsAccepted) {
  const std::string elbow = "\"on_silence\": \"hold\"";
  EXPECT_THAT(arm_problems(elbow, "\"on_silence\": \"release\""),
              HasSubstr("groups.arm.joints.elbow.on_silence: is release, and the joint carries a "
                        "weight, which falls when its commands cease (hold, or damp, or "
                        "\"accept\": [\"lets_fall\"] at the top of the file when that is meant)"));
  EXPECT_EQ(arm_problems(elbow, "\"on_silence\": \"damp\""), "");
  auto accepted = arm_with(elbow, "\"on_silence\": \"release\"");
  accepted.replace(accepted.find("\"falls\""), 7, "\"falls\", \"lets_fall\"");
  EXPECT_EQ(problems(accepted, kFolder), "");
  EXPECT_EQ(arm_problems("\"follows\": \"position\", ",
                         "\"follows\": \"position\", \"on_silence\": \"release\", "),
            "");  // the turret carries none
}

TEST(Groups, AreFourAtTheMost) {
  std::string more;
  for (const char* name : {"b", "c", "d", "e"})
    more += std::string("\"") + name + "\": {\"joints\": {}}, ";
  EXPECT_THAT(arm_problems("\"arm\": {\"joints\"", more + "\"arm\": {\"joints\""),
              HasSubstr("groups.arm: is one too many: there may be 4 beside base"));
}

TEST(Groups, RefuseMotorsThatAnswerAlike) {
  EXPECT_THAT(arm_problems("\"id\": 3", "\"id\": 2"),
              HasSubstr("two devices have one address (can1, damiao id 2)"));
  EXPECT_THAT(
      arm_problems("{\"id\": 3", "{\"id\": 3, \"master_id\": 18"),
      HasSubstr("devices.elbow.options.master_id: devices.elbow (damiao) and devices.shoulder "
                "(damiao) both use the id 0x012 on \"can1\""));
}

TEST(Groups, TellAMotorWithoutANumberThatItNeedsOne) {
  for (const char* bad : {"{", "{\"id\": 17, ", "{\"id\": 300, ", "{\"id\": \"2\", "})
    EXPECT_THAT(arm_problems("{\"id\": 3, ", bad), HasSubstr("devices.elbow.options")) << bad;
}

TEST(Groups, TellAMotorWhoseModelIsNotToldWhichOnesThereAre) {
  const auto told = arm_problems("{\"id\": 3, \"model\": \"DM4310\"", "{\"id\": 3");
  EXPECT_THAT(told, HasSubstr("devices.elbow.options.model: is missing"));
  EXPECT_THAT(told, HasSubstr("one of: DM4310, DM4310_48V, DM4340, "));
}

TEST(Groups, FollowAllFiveValuesAndHoldWhereNothingIsSaid) {
  const auto loaded = load_text(arm_with("\"follows\": \"position\", ", ""), kFolder);
  ASSERT_THAT(loaded.problems, IsEmpty());
  const auto& turret = loaded.config.engine.groups[0].joints[0];
  EXPECT_EQ(turret.follows, JointFollows::impedance);
  EXPECT_EQ(turret.on_silence, engine::OnSilence::hold);
}

std::string arm_warnings(const std::string& piece, const std::string& replacement) {
  std::string all;
  const auto loaded = load_text(arm_with(piece, replacement), kFolder);
  for (const auto& warning : loaded.warnings) all += warning.text("f") + "\n";
  return all;
}

TEST(Groups, TellHowFastAWeightComesDownThatIsHardlyDamped) {
  auto text = arm_with("\"model\": \"DM4310\", \"damping_Nmsprad\": 3",
                       "\"model\": \"DM4310\", \"damping_Nmsprad\": 0.01");
  const auto loaded = load_text(text.replace(text.find("\"falls\""), 7, ""), kFolder);
  ASSERT_EQ(loaded.warnings.size(), 2u);
  EXPECT_THAT(loaded.warnings[1].text("f"), HasSubstr("it comes down at 100 rad/s for each Nm"));
}

TEST(Groups, RefuseAJointThatNothingHolds) {
  const auto elbow = [](const std::string& gains) {
    return arm_problems("\"stiffness_Nmprad\": 60, \"damping_Nmsprad\": 2", gains);
  };
  EXPECT_THAT(elbow(R"("stiffness_Nmprad": 0, "damping_Nmsprad": 2)"),
              HasSubstr("groups.arm.joints.elbow.stiffness_Nmprad: is 0, so nothing keeps the "
                        "joint in its place when it is held: at every stop, and when its commands "
                        "cease (on_silence is hold)"));
  EXPECT_THAT(elbow(R"("stiffness_Nmprad": 60, "damping_Nmsprad": 0)"),
              HasSubstr("groups.arm.joints.elbow.damping_Nmsprad: is 0: held, the joint swings"));
  EXPECT_EQ(elbow(R"("stiffness_Nmprad": 60, "damping_Nmsprad": 0.5)"), "");
}

TEST(Groups, RefuseAWeightWithoutStiffnessWhateverItDoesInSilence) {
  const std::string gains = "\"stiffness_Nmprad\": 60, \"damping_Nmsprad\": 2, ";
  const auto told = arm_problems(gains + "\"on_silence\": \"hold\"",
                                 "\"stiffness_Nmprad\": 0, \"damping_Nmsprad\": 2, "
                                 "\"on_silence\": \"damp\"");
  EXPECT_THAT(told, HasSubstr("elbow.stiffness_Nmprad: is 0, so nothing keeps the joint in its "
                              "place when it is held: at every stop ("));
}

/// It is damped then, which is what was written.
TEST(Groups, LetAJointWithoutAWeightHaveNoStiffnessWhereItIsToDamp) {
  EXPECT_EQ(arm_problems("\"stiffness_Nmprad\": 80, \"damping_Nmsprad\": 3",
                         "\"stiffness_Nmprad\": 0, \"damping_Nmsprad\": 3, "
                         "\"on_silence\": \"damp\""),
            "");
}

TEST(Groups, TellOfAJointThatSwingsWhereItIsHeldUntilItIsAccepted) {
  const std::string gains = "\"stiffness_Nmprad\": 60, \"damping_Nmsprad\": 2";
  const std::string weak = "\"stiffness_Nmprad\": 500, \"damping_Nmsprad\": 0.01";
  EXPECT_THAT(arm_warnings(gains, weak),
              HasSubstr("groups.arm.joints.elbow.damping_Nmsprad: is 0.01, with a stiffness of 500 "
                        "Nm/rad: held, the joint swings for long (1 or more, or \"accept\": "
                        "[\"swings\"]"));
  auto accepted = arm_with(gains, weak);
  accepted.replace(accepted.find("\"falls\""), 7, "\"falls\", \"swings\"");
  EXPECT_THAT(load_text(accepted, kFolder).warnings, IsEmpty());
}

TEST(Groups, AskOfEachJointWhetherItCarriesAWeight) {
  EXPECT_THAT(arm_warnings(", \"carries_weight\": true},", "},"),
              HasSubstr("groups.arm.joints.shoulder: does not say whether it carries a weight, "
                        "which falls without power, and sags where it is held unless this is told "
                        "(\"carries_weight\": true, or false when nothing pulls at it)"));
  EXPECT_EQ(arm_warnings(", \"carries_weight\": false},", ", \"carries_weight\": false },"), "");
}

TEST(Groups, TellOfAnArmThatNobodyCanMove) {
  const auto with_section = [](const std::string& section) {
    return arm_warnings("\"groups\": {", section + ", \"groups\": {");
  };
  EXPECT_THAT(with_section(R"("aimrt": {"commands": false})"),
              HasSubstr("groups.arm: nobody can move it: aimrt.commands is false, and "
                        "ros2.inputs.joint_command is closed"));
  EXPECT_THAT(with_section(R"("aimrt": {"enabled": false})"), HasSubstr("aimrt.enabled is false"));
  EXPECT_EQ(with_section(R"("aimrt": {"commands": false}, "ros2": {"inputs":)"
                         R"( {"joint_command": true}})"),
            "");
  EXPECT_EQ(with_section(R"("aimrt": {"commands": true})"), "");
}

TEST(Groups, TellWhatAMasterIdOf0Means) {
  EXPECT_THAT(arm_warnings("{\"id\": 3, ", "{\"id\": 3, \"master_id\": 0, "),
              HasSubstr("devices.elbow.options.master_id: is 0, which means 16 more than id: a "
                        "motor that answers under 0, as it may be delivered, is not heard"));
  EXPECT_EQ(arm_warnings("{\"id\": 3, ", "{\"id\": 3, \"master_id\": 19, "), "");
}

/// The example with its wheels' drives speaking CANopen, and its elbow on their bus.
std::string beside_canopen(const std::string& master_id, const std::string& accept = "") {
  auto text = arm_with(
      "\"elbow\": {\"driver\": \"damiao\", \"link\": \"can1\",\n      "
      "\"options\": {\"id\": 3, ",
      "\"elbow\": {\"driver\": \"damiao\", \"link\": \"can0\",\n      "
      "\"options\": {\"id\": 3, " +
          master_id);
  for (const char* node : {"0", "1"}) {
    const auto wheel =
        "\"driver\": \"odrive\", \"link\": \"can0\", \"options\": {\"node\": " + std::string(node) +
        ", \"watchdog_timeout_s\": 0.1}";
    const auto at = text.find(wheel);
    EXPECT_NE(at, std::string::npos);
    text.replace(at, wheel.size(),
                 "\"driver\": \"cia402\", \"link\": \"can0\", \"options\": {\"node\": 1" +
                     std::string(node) + "}");
  }
  return text.replace(text.find("\"falls\""), 7, "\"falls\"" + accept);
}

TEST(Groups, TellOfMotorsOnABusWithCanopenDrivesUntilThatIsAccepted) {
  const auto told = [](const std::string& text) {
    std::string all;
    for (const auto& warning : load_text(text, kFolder).warnings) all += warning.text("f") + "\n";
    return all;
  };
  EXPECT_THAT(told(beside_canopen("")),
              HasSubstr("devices.elbow.link: shares \"can0\" with devices.left (cia402): a motor "
                        "that answers under 0, as it may be delivered, sends by this id commands "
                        "that start and reset CANopen nodes"));
  EXPECT_EQ(told(beside_canopen("", ", \"mixed_bus\"")).find("shares"), std::string::npos);
  EXPECT_THAT(problems(beside_canopen("\"master_id\": 0, "), kFolder),
              HasSubstr("devices.elbow.link: a damiao shares no bus with a cia402 when it answers "
                        "under the master id 0"));
  EXPECT_THAT(problems(beside_canopen("\"master_id\": 19, "), kFolder),
              testing::Not(HasSubstr("shares no bus")));
}

TEST(Groups, TellWhereAKeyBelongsThatStandsInTheWrongPlace) {
  EXPECT_THAT(arm_problems("\"link\": \"can1\", \"options\": {\"id\": 1, ",
                           "\"link\": \"can1\", \"id\": 1, \"options\": {"),
              HasSubstr("devices.turret.id: is no known key (it belongs into \"options\")"));
  EXPECT_THAT(
      arm_problems("\"link\": \"can1\", \"options\": {\"id\": 1, ",
                   "\"link\": \"can1\", \"options\": {\"carries_weight\": true, \"id\": 1, "),
      HasSubstr("carries_weight: is no known key (it belongs into groups.NAME.joints)"));
  EXPECT_THAT(
      arm_problems("\"on_silence\": \"hold\"", "\"reversed\": true"),
      HasSubstr("elbow.reversed: is no known key (it belongs into the options of the device)"));
  EXPECT_THAT(arm_problems("\"on_silence\": \"hold\"", "\"accept\": [\"falls\"]"),
              HasSubstr("(it belongs into the device, or to the top of the file)"));
}

TEST(Groups, TellHowJointsAreWrittenThatStandInAList) {
  EXPECT_THAT(
      arm_problems("\"arm\": {\"joints\"", "\"mast\": {\"joints\": []}, \"arm\": {\"joints\""),
      HasSubstr("groups.mast.joints: is a list, but an object is expected (each entry by its "
                "name: {\"NAME\": {...}})"));
}

TEST(Groups, TellWhatAKeyOfOthersIsHere) {
  EXPECT_THAT(arm_problems("\"min_rad\": -2.5", "\"min_deg\": -90"),
              HasSubstr("turret.min_deg: is no known key (\"min_rad\" is in radians: one degree is "
                        "0.01745)"));
  EXPECT_THAT(arm_problems("\"stiffness_Nmprad\": 80", "\"kp\": 80"),
              HasSubstr("turret.kp: is no known key (did you mean \"stiffness_Nmprad\"?)"));
}

TEST(Groups, RefuseMotorsOnABusWithDrivesThatTheyWouldReprogram) {
  EXPECT_THAT(arm_problems("\"elbow\": {\"driver\": \"damiao\", \"link\": \"can1\"",
                           "\"elbow\": {\"driver\": \"damiao\", \"link\": \"can0\""),
              HasSubstr("devices.elbow.link: a damiao shares no bus with an odrive"));
}

}  // namespace
}  // namespace drover::config
