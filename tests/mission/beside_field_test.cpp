// Bases of every kind on one line: a straight, a U-turn of 1.5 m radius and the way back.
#include "mission/support.h"

namespace drover::mission {
namespace {

/// As near to the line of `straight_and_uturn` as the field robot comes at its speed, or nearly.
void expect_as_near_as_the_field_robot(const char* name) {
  const auto rms_m = [](const char* mission) {
    const Record& log = record(mission);
    const Time begin = log.answered("start_nav_success");
    const auto figures = drive_figures(log, begin, log.first_status("NAV_SUCCESS", begin).time);
    EXPECT_NEAR(figures.distance_m, 24.7, 0.2) << mission << " drives another line";
    return figures.rms_m;
  };
  const double ours_m = rms_m(name);
  const double field_m = rms_m("straight_and_uturn");
  std::printf("  cross-track RMS %.4f m, of the field robot %.4f m\n", ours_m, field_m);
  EXPECT_LE(ours_m, 1.3 * field_m);
}

TEST(Gt01, KeepsItsTrackAsTheFieldRobotDoes) {
  expect_as_near_as_the_field_robot("gt01");
}
TEST(AgilexV2, KeepsItsTrackAsTheFieldRobotDoes) {
  expect_as_near_as_the_field_robot("agilex_v2");
}
TEST(Zlac8015d, KeepsItsTrackAsTheFieldRobotDoes) {
  expect_as_near_as_the_field_robot("zlac8015d");
}
TEST(Cia402, KeepsItsTrackAsTheFieldRobotDoes) {
  expect_as_near_as_the_field_robot("cia402");
}
TEST(Hunter, KeepsItsTrackAsTheFieldRobotDoes) {
  expect_as_near_as_the_field_robot("hunter");
}
TEST(Robomaster, KeepsItsTrackAsTheFieldRobotDoes) {
  expect_as_near_as_the_field_robot("robomaster");
}
TEST(Mecanum, KeepsItsTrackAsTheFieldRobotDoes) {
  expect_as_near_as_the_field_robot("mecanum");
}

}  // namespace
}  // namespace drover::mission
