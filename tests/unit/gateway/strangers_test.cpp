#include "gateway/strangers.h"

#include <gtest/gtest.h>

#include "support/allocation_counter.h"

namespace drover::gateway {
namespace {

using namespace std::chrono_literals;

CanFrame extended(std::uint32_t id) {
  CanFrame frame = make_frame(id, {});
  frame.extended = true;
  return frame;
}

struct Bus {
  /// Each 10 ms one of these.
  void speak(Duration time, std::initializer_list<CanFrame> frames) {
    for (const Time end = now + time; now < end;) {
      now += 10ms;
      for (const CanFrame& frame : frames) strangers.on_frame(frame, now);
    }
  }
  std::string told(Time last_good = kNever, bool others_heard = false) const {
    return std::string(strangers.text("can0", last_good, others_heard, now).view());
  }
  Strangers strangers;
  Time now{100s};
};

TEST(Strangers, AreToldInsteadOfADeviceThatWasNeverHeard) {
  Bus bus;
  EXPECT_EQ(bus.told(), "");
  bus.speak(2900ms, {make_frame(0x029, {}), make_frame(0x7FF, {})});
  EXPECT_EQ(bus.told(), "") << "it may still come up";
  bus.speak(200ms, {make_frame(0x029, {})});
  EXPECT_EQ(bus.told(),
            "never heard; frames of other devices come on can0 (0x029, 0x7FF): are the buses "
            "swapped, or its id wrong?");
  EXPECT_EQ(bus.told(kNever, true),
            "never heard; frames of other devices come on can0 (0x029, 0x7FF): is its id another "
            "one?");
}

TEST(Strangers, AreToldOfADeviceThatIsSilentForAWhile) {
  Bus bus;
  bus.speak(10s, {make_frame(0x029, {})});
  EXPECT_EQ(bus.told(bus.now - 2900ms), "");
  EXPECT_EQ(bus.told(bus.now - 3s).substr(0, 7), "silent;");
}

TEST(Strangers, AreNamedByAFewIdsAndStandStill) {
  Bus bus;
  bus.speak(4s, {extended(0x18FF1234), make_frame(1, {}), make_frame(2, {})});
  const std::string before = bus.told();
  EXPECT_NE(before.find("(0x18FF1234, 0x001, 0x002)"), std::string::npos) << before;
  bus.speak(1s, {make_frame(3, {}), make_frame(4, {}), make_frame(5, {})});
  const std::string more = bus.told();
  EXPECT_NE(more.find("(0x18FF1234, 0x001, 0x002, …)"), std::string::npos) << more;
  bus.speak(10s, {make_frame(6, {}), make_frame(1, {})});
  EXPECT_EQ(bus.told(), more);
}

TEST(Strangers, AreForgottenWhenTheyCease) {
  Bus bus;
  bus.speak(5s, {make_frame(0x029, {})});
  bus.now += 1100ms;
  EXPECT_EQ(bus.told(), "");
  bus.speak(1s, {make_frame(0x030, {})});
  EXPECT_EQ(bus.told(), "") << "another story";
  bus.speak(3s, {make_frame(0x030, {})});
  EXPECT_NE(bus.told().find("(0x030)"), std::string::npos) << bus.told();
  bus.strangers.clear();
  EXPECT_EQ(bus.told(), "");
}

TEST(Strangers, FitIntoAReasonWhateverTheirIdsAre) {
  Strangers strangers;
  for (int i = 0; i < 500; ++i)
    for (const std::uint32_t id : {0x1FFFFFFFU, 0x1FFFFFFEU, 0x1FFFFFFDU, 0x1FFFFFFCU})
      strangers.on_frame(extended(id), Time{} + i * 10ms);
  const test::AllocationCounter counter;
  const Reason told = strangers.text("can_of_the_arm", kNever, false, Time{} + 5s);
  EXPECT_EQ(counter.count(), 0U);
  EXPECT_TRUE(told.view().ends_with("wrong?")) << told.view();
}

}  // namespace
}  // namespace drover::gateway
