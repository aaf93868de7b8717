// The judge of frames lets through what the documented set-up needs, and nothing else.
#include "mission/wire.h"

#include <gtest/gtest.h>

#include "mission/log_lines.h"

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

}  // namespace
}  // namespace drover::mission
