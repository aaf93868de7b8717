// Computed from CiA 301's order; the same steps as christiansandberg/canopen, canopen/pdo/base.py.
#include "drivers/canopen/pdo.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/canopen/cia402.h"
#include "support/describe.h"

namespace drover::canopen {
namespace {

using testing::ElementsAre;

std::vector<std::string> frames(const PdoSteps& steps, std::uint8_t node) {
  std::vector<std::string> texts;
  for (const auto& step : steps)
    texts.push_back(test::describe(encode_sdo_write(node, step.object, step.value)));
  return texts;
}

TEST(CanopenPdo, IsSetUpForCommands) {
  Pdo pdo;
  ASSERT_TRUE(pdo.objects.push_back({{kControlword, 0}, 16}));
  ASSERT_TRUE(pdo.objects.push_back({{kTargetVelocity, 0}, 32}));
  EXPECT_THAT(frames(steps_of(pdo, 5), 5),
              ElementsAre("605#2300140105020080", "605#2F001402FF000000", "605#2F00160000000000",
                          "605#2300160110004060", "605#230016022000FF60", "605#2F00160002000000",
                          "605#2300140105020000"));
}

TEST(CanopenPdo, IsSetUpForFeedback) {
  Pdo pdo;
  pdo.direction = PdoDirection::transmits;
  pdo.inhibit_100us = 10;
  pdo.event_timer_ms = 10;
  ASSERT_TRUE(pdo.objects.push_back({{kStatusword, 0}, 16}));
  ASSERT_TRUE(pdo.objects.push_back({{kVelocityActual, 0}, 32}));
  EXPECT_THAT(frames(steps_of(pdo, 5), 5),
              ElementsAre("605#23001801850100C0", "605#2F001802FF000000", "605#2B0018030A000000",
                          "605#2B0018050A000000", "605#2F001A0000000000", "605#23001A0110004160",
                          "605#23001A0220006C60", "605#2F001A0002000000", "605#2300180185010040"));
}

TEST(CanopenPdo, HasAnIdByNumberAndNode) {
  Pdo pdo;
  pdo.number = 4;
  EXPECT_EQ(cob_id(pdo, 0x11), 0x511U);
  pdo.direction = PdoDirection::transmits;
  EXPECT_EQ(cob_id(pdo, 0x11), 0x491U);
}

TEST(CanopenPdo, OfTheMostObjectsHasRoomForItsSteps) {
  Pdo pdo;
  pdo.inhibit_100us = 1;
  pdo.event_timer_ms = 1;
  while (pdo.objects.push_back({{kStatusword, 0}, 8})) {
  }
  EXPECT_EQ(steps_of(pdo, 1).size(), 15U);
}

}  // namespace
}  // namespace drover::canopen
