// The judge of frames lets through what the documented set-up needs, and nothing else.
#include "mission/wire.h"

#include <gtest/gtest.h>

#include "mission/log_lines.h"
#include "mission/wire_cia402.h"
#include "mission/wire_damiao.h"
#include "mission/wire_robomaster.h"
#include "mission/wire_twist.h"
#include "mission/wire_zlac8015d.h"

namespace drover::mission {
namespace {

CanFrame frame(const std::string& text) {
  return parse_can_line("(1.000000000) can0 " + text).frame;
}

TEST(MissionWire, RefusesFramesThatCalibrateMoveByTorqueOrChangeTheDrive) {
  for (const char* text : {
           "027#03000000",          // full calibration
           "027#0800000000",        // a state of another length
           "02B#0300000001000000",  // position control
           "02C#0000000000000000",  // a position
           "02E#00000000",          // a torque
           "02D#0000803F0000803F",  // a torque beside a velocity
           "02D#0000C07F00000000",  // a velocity that is no number
           "02D#0000803F",          // a velocity of another length
           "036#",                  // reboot
           "022#",                  // the drive's own e-stop
           "024#0100000000",        // a parameter
           "026#0000000000000000",  // a node id
           "038#01",                // clear errors with an identify request
           "029#R",
           "023#R8",                // polls off the list
           "00D#0000000000000000",  // a node of no wheel
           "0AD#0000000000000000",
           "0000002D#0000000000000000",
           "20000004#0000000000000000",
       })
    EXPECT_FALSE(forbidden(frame(text)).empty()) << text;
}

TEST(MissionWire, LetsThroughWhatADriveSendsAndWhatItNeeds) {
  for (const char* text :
       {"021#0000000001000000", "029#000080B813820AA1", "023#0000000000000000", "023#R", "03C#R",
        "035#R", "037#R", "037#0000C0410000803F", "027#08000000", "027#01000000",
        "02B#0200000001000000", "02D#0000803F00000000", "08D#0000000000000000", "038#00"})
    EXPECT_EQ(forbidden(frame(text)), "") << text;
}

TEST(MissionWire, CountsAnythingButZerosAsMotion) {
  EXPECT_FALSE(wheel_command(frame("02D#0000000000000000"))->moves());
  EXPECT_FALSE(wheel_command(frame("02D#0000008000000000"))->moves()) << "minus zero";
  EXPECT_TRUE(wheel_command(frame("02D#0100000000000000"))->moves()) << "the smallest number";
  EXPECT_TRUE(wheel_command(frame("02D#0000000001000000"))->moves()) << "a torque";
  EXPECT_TRUE(wheel_command(frame("02D#0000C07F00000000"))->moves()) << "no number";
}

TEST(MissionWire, ReadsNodeAndVelocity) {
  const auto wheel = wheel_command(frame("06D#000000C000000000"));
  ASSERT_TRUE(wheel);
  EXPECT_EQ(wheel->node, 3);
  EXPECT_EQ(wheel->velocity_turnps, -2.0F);
  EXPECT_FALSE(wheel_command(frame("06D#R")));
  EXPECT_FALSE(wheel_command(frame("069#000000C000000000")));
}

TEST(MissionWire, RefusesWhatAZlac8015dMustNeverBeTold) {
  for (const char* text : {
           "000#8101",              // a reset of the node
           "000#0100",              // a start of all nodes
           "201#1F00",              // a bit that means nothing here
           "201#0F",                // half a word
           "302#0000000000000000",  // another node
           "301#00000000",          // one wheel only
           "601#2B10200001000000",  // a save to flash
           "601#2B0A200002000000",  // a node id
           "601#23FF600164000000",  // a target that moves, past the gate of process data
           "601#2B40600000000000",  // a controlword beside the process data
           "281#R",
       })
    EXPECT_FALSE(zlac8015d::forbidden(frame(text)).empty()) << text;
}

TEST(MissionWire, LetsThroughWhatAZlac8015dSaysAndNeeds) {
  for (const char* text :
       {"000#0101", "201#0F00", "301#6400000064000000", "601#4041600000000000",
        "601#2B002000C8000000", "601#23FF600100000000", "601#230116022002FF60",
        "581#6000200000000000", "701#05", "181#2700270000000000", "281#1AFCFFFFEA030000"})
    EXPECT_EQ(zlac8015d::forbidden(frame(text)), "") << text;
}

TEST(MissionWire, ReadsBothWheelsOfAZlac8015dAsTheyDriveAhead) {
  const auto ahead = zlac8015d::targets_turnps(frame("301#58020000A8FDFFFF"));
  ASSERT_TRUE(ahead);
  EXPECT_EQ((*ahead)[0], 1.0F);
  EXPECT_EQ((*ahead)[1], 1.0F);
  const auto zero = zlac8015d::targets_turnps(frame("301#0000000000000000"));
  EXPECT_FALSE((WheelCommand{1, (*zero)[1], 0}.moves()));
  EXPECT_TRUE(zlac8015d::is_zero_by_service(frame("601#23FF600200000000")));
  EXPECT_FALSE(zlac8015d::is_zero_by_service(frame("601#23FF600201000000")));
}

TEST(MissionWire, RefusesWhatADriveOfCia402MustNeverBeTold) {
  for (const char* text : {
           "000#8101",              // a reset of a node
           "000#0100",              // a start of all nodes
           "000#0103",              // of a node that is none of this robot's
           "201#1F0000000000",      // a bit that means nothing here
           "201#060064000000",      // a target for a drive that is off
           "201#0F0064000000FF",    // something behind the target
           "203#0F0064000000",      // another node
           "601#2310100173617665",  // a save to flash
           "601#23FF600064000000",  // a target that moves, past the gate of process data
           "601#2B4060000F000000",  // a controlword beside the process data
           "601#23A9600000000000",  // what the drive counts
           "701#0500",
           "77F#04",  // a gateway that stands
           "281#R",
       })
    EXPECT_FALSE(cia402::forbidden(frame(text)).empty()) << text;
}

TEST(MissionWire, LetsThroughWhatADriveOfCia402SaysAndNeeds) {
  for (const char* text : {"000#0102", "201#0F0064000000", "202#060000000000",
                           "601#4041600000000000", "602#2B17100064000000", "601#23FF600000000000",
                           "601#23001A0110004160", "582#6000200000000000", "702#7F", "77F#05",
                           "181#370200000000", "281#1AFCFFFF", "082#1042010000000000"})
    EXPECT_EQ(cia402::forbidden(frame(text)), "") << text;
}

TEST(MissionWire, ReadsBothWheelsOfCia402AsTheyDriveAhead) {
  EXPECT_EQ(cia402::wheel_command(frame("201#0F003C000000"))->velocity_turnps, 1.0F);
  EXPECT_EQ(cia402::wheel_command(frame("202#0F00C4FFFFFF"))->velocity_turnps, 1.0F);
  EXPECT_FALSE(cia402::wheel_command(frame("202#0F0000000000"))->moves());
  EXPECT_FALSE(cia402::wheel_command(frame("301#0F003C000000")));
  EXPECT_TRUE(cia402::is_zero_by_service(frame("602#23FF600000000000")));
  EXPECT_FALSE(cia402::is_zero_by_service(frame("602#23FF600001000000")));
}

TEST(MissionWire, RefusesWhatAGt01OnCanMustNeverBeTold) {
  for (const char* text : {
           "001#0102000000000000",  // speeds of its wheels
           "001#0201000000000000",  // another command
           "001#0101F40100000001",  // something behind the twist
           "001#0101F401",
           "002#0101000000000000",
           "00000001#0101000000000000",
           "001#R",
       })
    EXPECT_FALSE(gt01::forbidden(frame(text)).empty()) << text;
  for (const char* text : {"001#0101F40107000000", "020#0239FE0108000000", "010#0000000000000000"})
    EXPECT_EQ(gt01::forbidden(frame(text)), "") << text;
}

TEST(MissionWire, ReadsTheTwistsOfAGt01OnCan) {
  const auto twist = gt01::twist_command(frame("001#010101F4FFF80000"));
  ASSERT_TRUE(twist);
  EXPECT_EQ(twist->vx_mps, 0.5);
  EXPECT_EQ(twist->wz_radps, -0.008);
  EXPECT_FALSE(gt01::twist_command(frame("001#0101000000000000"))->moves());
  EXPECT_FALSE(gt01::twist_command(frame("010#010101F4FFF80000")));
}

TEST(MissionWire, RefusesWhatAnAgilexMustNeverBeTold) {
  for (const char* text : {
           "111#01F4000500000001",  // a steering angle
           "111#01F40005",
           "421#02",       // a mode that is none of ours
           "431#00",       // the zero of a steering
           "441#00",       // clear errors
           "131#01",       // a brake
           "0CFF1000#00",  // another sensor
           "411#01",
       })
    EXPECT_FALSE(agilex_v2::forbidden(frame(text)).empty()) << text;
  for (const char* text : {"111#01F4000500000000", "421#01", "421#00", "221#01F4000500000000",
                           "0CFF3408#0C000300EE070000"})
    EXPECT_EQ(agilex_v2::forbidden(frame(text)), "") << text;
}

TEST(MissionWire, ReadsTheTwistsOfAnAgilex) {
  const auto twist = agilex_v2::twist_command(frame("111#FE0C000500000000"));
  ASSERT_TRUE(twist);
  EXPECT_EQ(twist->vx_mps, -0.5);
  EXPECT_EQ(twist->wz_radps, 0.005);
  EXPECT_FALSE(agilex_v2::twist_command(frame("111#0000000000000000"))->moves());
}

TEST(MissionWire, KnowsWhatAHunterMayBeTold) {
  for (const char* text : {"111#01F4000500000000", "111#01F40000000102BC", "131#02", "131#0000",
                           "111#01F4000000000300", "441#FF", "431#AA"})
    EXPECT_FALSE(hunter::forbidden(frame(text)).empty()) << text;
  for (const char* text : {"111#01F4000000000240", "111#000000000000FDC0", "131#00", "131#01",
                           "421#01", "221#01F4000000000000"})
    EXPECT_EQ(hunter::forbidden(frame(text)), "") << text;
}

TEST(MissionWire, ReadsTheCurveOfAHunter) {
  const auto left = hunter::twist_command(frame("111#01F40000000000C8"));
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->wz_radps, 0.1425, 1e-4);
  const auto back = hunter::twist_command(frame("111#FE0C0000000000C8"));
  EXPECT_NEAR(back->wz_radps, -0.1425, 1e-4);
  EXPECT_FALSE(hunter::twist_command(frame("111#00000000000000C8"))->moves());
}

TEST(MissionWire, KnowsWhatRobomasterMotorsMayBeTold) {
  for (const char* text : {"700#0000000000000000", "1FF#0000000000000000", "200#00000000",
                           "200#4001000000000000", "200#BFFF000000000000", "205#0000000000000000"})
    EXPECT_FALSE(robomaster::forbidden(frame(text)).empty()) << text;
  for (const char* text : {"200#0666F99A00000000", "200#4000C00000000000", "204#1000FE0C01F42A00"})
    EXPECT_EQ(robomaster::forbidden(frame(text)), "") << text;
  EXPECT_TRUE(robomaster::is_zero(frame("200#0000000000000000")));
  EXPECT_FALSE(robomaster::is_zero(frame("200#0000000000000001")));
}

TEST(MissionWire, TellsACurrentThatDrivesAMotorFromOneThatBrakesIt) {
  robomaster::Bus bus;
  EXPECT_FALSE(bus.drives_A(frame("201#000001F400001900")));  // ahead
  EXPECT_FALSE(bus.drives_A(frame("202#0000FE0C00001900")));  // back
  // Along and against; at rest less than begins to turn it, and more.
  const auto drives_A = bus.drives_A(frame("200#0666066601600400"));
  ASSERT_TRUE(drives_A);
  EXPECT_NEAR((*drives_A)[0], 2.0, 0.01);
  EXPECT_EQ((*drives_A)[1], 0);
  EXPECT_EQ((*drives_A)[2], 0);
  EXPECT_NEAR((*drives_A)[3], 1.25, 0.01);
}

/// One wheel, of which others push: -0.9 A hold it while it gives way and while it comes back.
TEST(MissionWire, TellsACurrentThatHoldsAMotorWhereItStoodFromOneThatDrivesItAway) {
  robomaster::Bus bus;
  const auto drives = [&bus](const char* told, const char* command) {
    EXPECT_FALSE(bus.drives_A(frame(told)));
    return (*bus.drives_A(frame(command)))[0] != 0;
  };
  const char* back = "200#FD1F000000000000";   // -0.9 A
  const char* ahead = "200#02E1000000000000";  // 0.9 A
  EXPECT_TRUE(drives("201#1FF0000000001900", back)) << "it stands";
  EXPECT_FALSE(drives("201#00500002FD1F1900", back)) << "it is pushed, over the turn's end";
  EXPECT_FALSE(drives("201#00600000FD1F1900", back)) << "it stands against it";
  EXPECT_FALSE(drives("201#0058FFFEFD1F1900", back)) << "it is let back";
  EXPECT_TRUE(drives("201#0050FFE0FD1F1900", back)) << "it is driven back";
  EXPECT_TRUE(drives("201#1FF5FFFEFD1F1900", back)) << "it is where it stood, and goes on";
  EXPECT_TRUE(drives("201#1F80FFFEFD1F1900", back)) << "beyond";
  EXPECT_TRUE(drives("201#1F900002FD1F1900", ahead)) << "driven ahead";
  EXPECT_TRUE(drives("201#1FD00000FD1F1900", back)) << "another current: it stands anew";
  EXPECT_TRUE(drives("201#1FC0FFFEFD1F1900", back));
}

TEST(MissionWire, ReadsWhatADamiaoIsToldAndTells) {
  const auto told = damiao::set_point(frame("003#8A3C7FF0A31997FF"));
  ASSERT_TRUE(told);
  EXPECT_EQ(told->joint, 2U);
  EXPECT_NEAR(told->position_rad, 1, damiao::kLeast_rad);
  EXPECT_EQ(told->velocity_radps, 0);
  EXPECT_NEAR(told->stiffness, 20, damiao::kLeast_Nmprad);
  EXPECT_NEAR(told->damping, 0.5, 0.002);
  EXPECT_EQ(told->torque_Nm, 0);
  EXPECT_FALSE(told->only_damps());
  EXPECT_NEAR(damiao::set_point(frame("003#7FFF8CC0003337FF"))->velocity_radps, 3, 0.015);
  const auto most = damiao::set_point(frame("001#FFFFFFF000000FFF"));
  EXPECT_NEAR(most->velocity_radps, 10, 1e-9);
  EXPECT_NEAR(most->torque_Nm, 28, 1e-9);
  const auto answer = damiao::answer(frame("013#138A3C8886CC231E"));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 1);
  EXPECT_NEAR(answer->position_rad, 0.99966, 1e-5);
  EXPECT_NEAR(answer->velocity_radps, 2, 1e-3);
  EXPECT_NEAR(answer->torque_Nm, -1.5018, 1e-4);
}

TEST(MissionWire, TakesNoWordToADamiaoForASetPointNorARegisterForAnAnswer) {
  EXPECT_TRUE(damiao::set_point(frame("001#7FFF7FF0003337FF"))->only_damps());
  EXPECT_FALSE(damiao::set_point(frame("001#7FFF7FF0000007FF"))->only_damps()) << "it is limp";
  EXPECT_FALSE(damiao::set_point(frame("001#7FFF7FF000333800"))->only_damps()) << "a torque";
  for (const char* text : {"001#FFFFFFFFFFFFFFFC", "004#7FFF7FF0003337FF", "001#7FFF7FF0"})
    EXPECT_FALSE(damiao::set_point(frame(text))) << text;
  for (const char* text : {"011#0100331500004841", "014#117FFF7FF7FF1E1C"})
    EXPECT_FALSE(damiao::answer(frame(text))) << text;
}

}  // namespace
}  // namespace drover::mission
