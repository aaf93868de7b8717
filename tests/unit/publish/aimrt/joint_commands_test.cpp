// Messages that name joints of more than one group: each group has an owner of its own.
#include "publish/aimrt/joint_commands.h"

#include <gmock/gmock.h>

#include <limits>

namespace drover::publish::aimrt {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class JointsOfTwoGroups : public testing::Test {
 protected:
  static JointCommandsConfig rules() {
    JointCommandsConfig config;
    config.rules.joints = {{"left"},
                           {"right"},
                           {"elbow", JointFollows::impedance, 1},
                           {"wrist", JointFollows::impedance, 1}};
    config.rules.joints[3].timeout = 1s;
    return config;
  }
  static JointCommandEntry at(const char* joint, double position_rad) {
    JointCommandEntry entry;
    entry.name = joint;
    entry.position_rad = position_rad;
    return entry;
  }
  /// Why it is not followed; empty: it is.
  std::string say(const std::string& frame, std::vector<JointCommandEntry> joints) {
    JointCommandHeard heard{{0, 0, frame, std::move(joints)}, {}};
    heard.writer.frame_id = frame;
    Actions out;
    commands_.take(
        RequestId::Source::aimrt, [&] { return heard; }, now_, 0s, out);
    const auto& body = std::get<Command>(out.back()).body;
    const auto* refused = std::get_if<JointTargetsRefused>(&body);
    return refused == nullptr ? "" : std::string(refused->reason.view());
  }
  JointCommands commands_{rules()};
  Time now_{100s};
};

TEST_F(JointsOfTwoGroups, HaveNoNewOwnerInOneByAMessageThatTheOtherRefuses) {
  std::string last;
  for (int i = 0; i < 20; ++i, now_ += 10ms) last = say("arm", {at("elbow", i % 2 == 0 ? 0 : 1)});
  ASSERT_THAT(last, HasSubstr("jump to and fro"));
  EXPECT_THAT(say("arm", {at("left", 0), at("elbow", 0)}), HasSubstr("jump to and fro"));
  EXPECT_THAT(say("base", {at("left", 0)}), IsEmpty()) << "nobody was followed there";
  EXPECT_THAT(say("arm", {at("left", 0)}), HasSubstr("two programs write joint commands"));
}

/// What a message does not name is left as it is, and was not told to go to 0.
TEST_F(JointsOfTwoGroups, ThatOneProgramNamesInTurnAreFollowed) {
  for (int i = 0; i < 50; ++i, now_ += 10ms) {
    EXPECT_THAT(say("", {at("elbow", 0.8)}), IsEmpty()) << i;
    EXPECT_THAT(say("", {at("wrist", -1)}), IsEmpty()) << i;
  }
}

/// And a second program that names the others in turn is no owner of them.
TEST_F(JointsOfTwoGroups, OfAnArmHaveOneOwnerWhicheverOfThemHeNames) {
  for (int i = 0; i < 50; ++i, now_ += 10ms) {
    EXPECT_THAT(say("arm", {at("elbow", 0.8)}), IsEmpty()) << i;
    EXPECT_THAT(say("hand", {at("wrist", -1)}),
                HasSubstr("frame_id 'arm') has the joints, JointCommand (pb, frame_id 'hand') is"));
  }
  EXPECT_THAT(std::string(commands_.rivals(now_)), HasSubstr("'hand') is refused"));
}

/// Between two messages of a slow stream it is not silent.
TEST_F(JointsOfTwoGroups, KeepTheirOwnerForAsLongAsHisCommandsMayBeApart) {
  for (int i = 0; i < 8; ++i) {
    EXPECT_THAT(say("slow", {at("elbow", 0.5)}), IsEmpty()) << i;
    now_ += 200ms;
    EXPECT_THAT(say("rival", {at("elbow", -0.5)}), HasSubstr("'rival') is refused")) << i;
    EXPECT_THAT(say("wheels", {at("left", 0)}), IsEmpty()) << i;
    now_ += 200ms;
  }
  EXPECT_THAT(say("rival", {at("left", 0)}), IsEmpty()) << "a wheel's commands cease sooner";
  now_ += 601ms;
  EXPECT_THAT(say("rival", {at("elbow", -0.5)}), IsEmpty()) << "he is silent";
}

/// Its wheels are no business of the arm's, which it names more often.
TEST_F(JointsOfTwoGroups, ThatOneProgramNamesUnlikeOftenAreFollowed) {
  auto left = at("left", 0);
  EXPECT_THAT(say("", {left}), IsEmpty());
  left.velocity_radps = 3;
  for (int i = 0; i < 50; ++i, now_ += 10ms) {
    EXPECT_THAT(say("", {left, at("elbow", 0.8)}), IsEmpty()) << i;
    EXPECT_THAT(say("", {at("elbow", 0.8)}), IsEmpty()) << i;
  }
}

/// Who has to begin with velocity 0 is told first what he can never ask for.
TEST_F(JointsOfTwoGroups, AreRefusedWhatCannotBeAsThatBeforeANewProgramBegins) {
  EXPECT_THAT(say("first", {at("left", 0)}), IsEmpty());
  now_ += 1s;
  auto left = at("left", 0);
  left.velocity_radps = 1e6;
  EXPECT_EQ(say("second", {left}), "joint 'left': velocity 1e+06 is beyond the limit of 100000");
  left.velocity_radps = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(say("second", {left}), "joint 'left': velocity is NaN");
  left.velocity_radps = 1;
  EXPECT_EQ(say("second", {left}), "a stream of joint commands begins with velocity 0");
  EXPECT_THAT(say("second", {at("left", 0)}), IsEmpty());
}

/// Wheels that a message does not name come to rest: who names one alone stops the other.
TEST_F(JointsOfTwoGroups, OfTheBaseThatAreNotNamedAreToldToRest) {
  const auto turns = [](const char* joint) {
    JointCommandEntry entry;
    entry.name = joint;
    entry.velocity_radps = 3;
    return entry;
  };
  std::string last = say("", {at("left", 0)});
  for (int i = 0; i < 20; ++i, now_ += 10ms) last = say("", {turns(i % 2 == 0 ? "left" : "right")});
  EXPECT_THAT(last, HasSubstr("jump to and fro"));
}

}  // namespace
}  // namespace drover::publish::aimrt
