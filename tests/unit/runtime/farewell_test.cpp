#include "runtime/farewell.h"

#include <gmock/gmock.h>

namespace drover::runtime {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

engine::EngineConfig with_arm() {
  engine::EngineConfig config;
  engine::GroupConfig arm;
  arm.name = "arm";
  for (const char* const name : {"left", "right", "shoulder", "elbow", "wrist"}) {
    engine::JointRules rules;
    rules.axis = static_cast<AxisId>(config.joints.size());
    rules.carries_weight = rules.axis == 2 || rules.axis == 3;
    (void)config.joints.push_back(name);
    if (rules.axis >= 2) (void)arm.joints.push_back(rules);
  }
  (void)config.groups.push_back(arm);
  return config;
}

TEST(Farewell, NamesWhatSinks) {
  EXPECT_THAT(what_sinks(with_arm()),
              ElementsAre("arm: drover-guard only damps its drives until droverd runs again: what "
                          "is up sinks (shoulder, elbow), and falls where drover-guard is stopped, "
                          "too"));
}

TEST(Farewell, SaysNothingOfWhatCarriesNothing) {
  EXPECT_THAT(what_sinks({}), IsEmpty());
  engine::EngineConfig config = with_arm();
  for (engine::JointRules& joint : config.groups[0].joints) joint.carries_weight = false;
  EXPECT_THAT(what_sinks(config), IsEmpty());
}

}  // namespace
}  // namespace drover::runtime
