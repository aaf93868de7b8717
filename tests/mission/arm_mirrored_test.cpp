// A motor of the arm that is configured mirrored presses its joint onto the wrong stop.
#include "mission/arm_motion.h"
#include "mission/arm_wire.h"

namespace drover::mission {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

struct ArmMirrored : testing::Test {
  const Record& log = record("arm_mirrored");
  const Time lifts = log.event("event lifts#1");

  /// Since when the motor of the shoulder gives less than a quarter of its 20 Nm.
  Time eased() const {
    Time last = lifts;
    for (const TruthLine& line : log.truth)
      if (line.time > lifts && std::abs(line.arm_Nm.at(kShoulder)) > 5) last = line.time;
    return last;
  }
};

TEST_F(ArmMirrored, IsNotPressedOntoItsStopForEver) {
  double hardest_Nm = 0;
  for (const TruthLine& line : log.truth)
    if (line.time > lifts) hardest_Nm = std::max(hardest_Nm, std::abs(line.arm_Nm.at(kShoulder)));
  figure("pressed with", hardest_Nm, "Nm");
  EXPECT_GT(hardest_Nm, 16) << "it was not pressed at all";
  figure("until", eased() - lifts);
  EXPECT_LT(eased() - lifts, 4s);
  EXPECT_LT(strayed(log, kShoulder, lifts, log.truth.back().time), 0.15);
}

TEST_F(ArmMirrored, IsToldByItsNameAndTheOthersHold) {
  const auto arm = asked_status(log).at("groups").at(0);
  EXPECT_THAT(arm.at("reason").get<std::string>(), HasSubstr("shoulder: it presses with"));
  EXPECT_THAT(arm.at("reason").get<std::string>(),
              EndsWith("comes no nearer: blocked, pushed, or mirrored"));
  const Time end = lifts + 10s;
  expect_stiff(log, kBaseYaw, eased() + 100ms, end);
  expect_stiff(log, kElbow, eased() + 100ms, end);
  EXPECT_LT(strayed(log, kElbow, eased() + 500ms, end), 0.03);
}

TEST_F(ArmMirrored, DoesNotConcernTheBase) {
  expect_good_drive(log, 1);
}

}  // namespace
}  // namespace drover::mission
