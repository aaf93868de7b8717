// When the robot waited, by what it tells itself.
#include "sim/scenario/waits.h"

#include <gtest/gtest.h>

namespace drover::sim {
namespace {

using namespace std::chrono_literals;

std::string status(const char* nav, bool obstacle, const char* why) {
  return std::string(R"({"pose": {"x": 0, "y": 0, "yaw": 0},
    "rtk": {"latitude": 0, "longitude": 0, "status": 4}, "robot": {"vx": 0, "vz": 0},
    "nav": {"locate": "LOCATE_TRUE", "status": ")") +
         nav + R"(", "obstacle": )" + (obstacle ? "true" : "false") + R"(, "why": [)" + why + "]}}";
}

class Told {
 public:
  std::string at(Duration time, const char* nav, bool obstacle, const char* why = "") {
    (void)report_.on_base_status(status(nav, obstacle, why));
    return waits.look(Time{} + time, report_);
  }
  Waits waits;

 private:
  RobotReport report_;
};

TEST(Waits, AreToldWithTheirReasonAndTheirLength) {
  Told told;
  EXPECT_EQ(told.at(1s, "NAV_RUN", false), "");
  EXPECT_EQ(told.at(2s, "NAV_RUN", true, R"("person is in the way, 0.05 m ahead")"),
            "the robot waits: person is in the way, 0.05 m ahead");
  EXPECT_EQ(told.at(3s, "NAV_RUN", true, R"("person is in the way, 0.30 m ahead")"), "");
  EXPECT_EQ(told.at(4500ms, "NAV_RUN", false), "the robot goes on after 2.5 s");
  EXPECT_EQ(told.at(5s, "NAV_RUN", false), "");
  ASSERT_EQ(told.waits.all().size(), 1U);
  EXPECT_EQ(told.waits.all()[0].end - told.waits.all()[0].begin, 2500ms);
  EXPECT_EQ(told.waits.all()[0].why, "person is in the way, 0.05 m ahead") << "why it stopped";
}

TEST(Waits, AreOnlyThoseOfARobotThatHasATask) {
  Told told;
  EXPECT_EQ(told.at(1s, "NAV_FREE", true, R"("box is in the way, 0.05 m ahead")"), "");
  EXPECT_TRUE(told.waits.all().empty());
}

TEST(Waits, MayEndInAnError) {
  Told told;
  (void)told.at(1s, "NAV_RUN", true, R"("box is in the way, 0.05 m ahead")");
  EXPECT_EQ(told.waits.all().back().end, kNever);
  EXPECT_EQ(told.at(61s, "NAV_ERROR", true), "the robot waits no more after 60.0 s");
}

}  // namespace
}  // namespace drover::sim
