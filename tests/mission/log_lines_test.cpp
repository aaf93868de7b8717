// The logs' parsers refuse what another reader would understand differently.
#include "mission/log_lines.h"

#include <gtest/gtest.h>

namespace drover::mission {
namespace {

template <typename Parse>
void expect_refused(const Parse& parse, std::initializer_list<const char*> lines) {
  for (const char* line : lines)
    EXPECT_THROW((void)parse(line), std::runtime_error) << "'" << line << "'";
}

TEST(MissionCanLine, IsRefusedWhenItIsNotAsCandumpWritesIt) {
  expect_refused(
      parse_can_line,
      {"", "(1.000000000)", "(1.000000000) can0", "(1.000000000) can0 ", "1.000000000 can0 00D#",
       "(1.0) can0 00D#", "(x.000000000) can0 00D#", "(1.00000000x) can0 00D#",
       "(1.000000000) can0 00D", "(1.000000000) can0 0D#", "(1.000000000) can0 00D#0",
       "(1.000000000) can0 00D#0G", "(1.000000000) can0 00D#112233445566778899",
       "(1.000000000) can0 00D#R9", "(1.000000000) can0 00D##"});
}

TEST(MissionCanLine, GivesStampBusAndFrame) {
  const auto line = parse_can_line("(12.345678901) can0 02D#0000803F00000000");
  EXPECT_EQ(line.time.time_since_epoch().count(), 12'345'678'901);
  EXPECT_EQ(line.bus, "can0");
  EXPECT_EQ(line.frame, make_frame(0x02D, {0, 0, 0x80, 0x3F, 0, 0, 0, 0}));
}

TEST(MissionCanLine, TellsPollsErrorsAndOtherKindsOfFrameApart) {
  EXPECT_TRUE(parse_can_line("(1.000000000) can0 023#R").frame.remote);
  EXPECT_TRUE(parse_can_line("(1.000000000) can0 20000004#0011").frame.error);
  EXPECT_TRUE(parse_can_line("(1.000000000) can0 0000002D#").frame.extended);
  const auto fd = parse_can_line("(1.000000000) can0 02D##0112233445566778899").frame;
  EXPECT_TRUE(fd.fd);
  EXPECT_EQ(fd.len, 9);
}

TEST(MissionMqttLine, IsRefusedWithoutTopicOrRetained) {
  expect_refused(parse_mqtt_line,
                 {"", "(1.000000000) ", "(1.000000000) feedback", "(1.000000000) feedback {}",
                  "(1.000000000) feedback 2 {}", "(1.000000000)  0 {}"});
}

TEST(MissionMqttLine, KeepsBlanksOfThePayload) {
  const auto line = parse_mqtt_line("(1.000000002) base_status 1 {\"a\": 1} ");
  EXPECT_EQ(line.time.time_since_epoch().count(), 1'000'000'002);
  EXPECT_EQ(line.topic, "base_status");
  EXPECT_TRUE(line.retained);
  EXPECT_EQ(line.payload, "{\"a\": 1} ");
}

TEST(MissionEventLine, IsRefusedWithoutText) {
  expect_refused(parse_event_line, {"", "(1.000000000) ", "start droverd"});
}

TEST(MissionEventLine, KeepsItsText) {
  EXPECT_EQ(parse_event_line("(1.000000000) signal 9 to droverd").text, "signal 9 to droverd");
}

TEST(MissionLevelLine, IsRefusedWithoutALevel) {
  expect_refused(parse_level_line, {"", "(1.000000000) lamp", "(1.000000000) lamp ",
                                    "(1.000000000) lamp 2", "(1.000000000) lamp 10"});
}

TEST(MissionLevelLine, GivesNameAndLevelOrThatThereIsNone) {
  const auto line = parse_level_line("(1.005000000) lamp 1");
  EXPECT_EQ(line.time.time_since_epoch().count(), 1'005'000'000);
  EXPECT_EQ(line.name, "lamp");
  EXPECT_EQ(line.high, true);
  EXPECT_EQ(parse_level_line("(1.005000000) lamp 0").high, false);
  EXPECT_EQ(parse_level_line("(1.005000000) lamp -").high, std::nullopt);
}

TEST(MissionTruth, IsRefusedWithoutItsColumns) {
  EXPECT_THROW(TruthColumns("time_s,x_m,y_m"), std::runtime_error);
}

TEST(MissionTruth, RefusesLinesThatAreNotNumbersOfTheHeadersCount) {
  const TruthColumns columns("free_ahead_m,wz_radps,time_s,x_m,y_m,z_m,yaw_rad,vx_mps");
  expect_refused([&columns](std::string_view line) { return columns.parse(line); },
                 {"", "1,2,3,4,5,6,7", "1,2,3,4,5,6,7,8,9", "1,2,3,4,5,6,7,x", "1,2,3,4,5,6,7,nan",
                  "1,2,3,4,5,6,7,"});
}

TEST(MissionTruth, FindsItsColumnsByName) {
  const TruthColumns columns("free_ahead_m,wz_radps,time_s,x_m,y_m,z_m,yaw_rad,vx_mps");
  const auto line = columns.parse("999,0.25,1.5,2,3,4,5,-6");
  EXPECT_EQ(line.time.time_since_epoch().count(), 1'500'000'000);
  EXPECT_EQ(line.x_m, 2);
  EXPECT_EQ(line.vx_mps, -6);
  EXPECT_EQ(line.free_ahead_m, 999);
  EXPECT_EQ(line.wz_radps, 0.25);
}

}  // namespace
}  // namespace drover::mission
