// A receiver that takes another place while droverd is started again: a person has to look.
#include <algorithm>
#include <string>
#include <vector>

#include "mission/support.h"

namespace drover::mission {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(JumpOverRestart, IsToldAndOneStartIsRefused) {
  const Record& log = record("jump_over_restart");
  const Time restarted = log.event("event restarted#1");
  const Time again = log.event("event started_again#1");
  EXPECT_THAT(log.moving(restarted, again), IsEmpty());

  std::vector<std::string> reasons;
  for (const auto& one : log.feedback)
    if (one.time > restarted && one.time < again && one.cmd == "start_task_failse")
      reasons.push_back(one.reason);
  ASSERT_EQ(reasons.size(), 2U);
  EXPECT_THAT(reasons[0], HasSubstr("m while droverd was not running: look where it stands"));
  EXPECT_THAT(reasons[1], HasSubstr("m though no wheel turned: look where it stands"));
  EXPECT_FALSE(log.moving(again, Time::max()).empty());
}

}  // namespace
}  // namespace drover::mission
