#include "gateway/slots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "recorded_run.h"

namespace drover::gateway {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Wiring, HasTheBusesFirstAndAPlaceForEachDevice) {
  engine::Environment environment;
  const Wiring wiring = wire_up(load_robot().config, environment);
  std::vector<std::string> links;
  for (const Link& link : wiring.links) links.emplace_back(link.name);
  EXPECT_THAT(links, ElementsAre("can0", "gnss", "imu", "battery", "lines"));
  std::vector<std::string> slots;
  for (const Slot& slot : wiring.slots) slots.emplace_back(slot.name);
  EXPECT_THAT(slots, ElementsAre("left", "right", "gnss", "imu", "battery", "a", "b"));
  EXPECT_THAT(wiring.links[0].slots, ElementsAre(0, 1));
  EXPECT_THAT(wiring.links[4].slots, ElementsAre(5, 6));
  EXPECT_EQ(wiring.link_of(SlotKind::imu), 2);
  EXPECT_EQ(wiring.first(SlotKind::battery), 4);
}

TEST(Wiring, TellsEachDevicesHealthWhereTheEngineLooks) {
  engine::Environment environment;
  const Wiring wiring = wire_up(load_robot().config, environment);
  EXPECT_EQ(wiring.slots[1].health, &environment.axes[1]);
  EXPECT_EQ(wiring.slots[wiring.first(SlotKind::gnss)].health, &environment.gnss);
  EXPECT_EQ(wiring.slots[wiring.first(SlotKind::imu)].health, &environment.imu);
  EXPECT_EQ(wiring.slots[wiring.first(SlotKind::battery)].health, &environment.battery);
  EXPECT_EQ(wiring.slots[6].health, &environment.lines[static_cast<std::size_t>(Line::bumper)]);
}

TEST(Wiring, GivesTheSlowThreadWhatIsPolled) {
  engine::Environment environment;
  const Wiring wiring = wire_up(load_robot().config, environment);
  for (const Slot& slot : wiring.slots)
    EXPECT_EQ(slot.thread == Slot::Thread::slow, slot.kind == SlotKind::battery);
}

TEST(Wiring, SaysWhenThereIsNoSuchDevice) {
  auto config = load_robot().config;
  config.imu.configured = false;
  engine::Environment environment;
  const Wiring wiring = wire_up(config, environment);
  EXPECT_EQ(wiring.first(SlotKind::imu), kNowhere);
  EXPECT_EQ(wiring.link_of(SlotKind::imu), kNowhere);
  EXPECT_EQ(wiring.link_of(SlotKind::line), 3) << "the others close up";
}

TEST(Wiring, RefusesADriverOfAnotherKindNamingItsPlace) {
  auto config = load_robot().config;
  config.drives[1].driver = "nmea0183";
  engine::Environment environment;
  try {
    wire_up(config, environment);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("drives: right: no driver \"nmea0183\" of this kind"));
  }
}

}  // namespace
}  // namespace drover::gateway
