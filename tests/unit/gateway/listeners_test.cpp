#include "gateway/listeners.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/allocation_counter.h"

namespace drover::gateway {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<int> who_hears(const Listeners& listeners, const CanFrame& frame) {
  std::vector<int> slots;
  listeners.each(frame, [&](Listener listener) { slots.push_back(listener.slot); });
  return slots;
}

CanFrame extended(std::uint32_t id) {
  CanFrame frame = make_frame(id, {});
  frame.extended = true;
  return frame;
}

TEST(Listeners, GiveAFrameToThoseWhoListenToIt) {
  Listeners listeners;
  const FrameFilter one{0x020, 0x7E0, false};
  const FrameFilter two{0x040, 0x7E0, false};
  listeners.add(3, {&one, 1});
  listeners.add(5, {&two, 1});
  EXPECT_THAT(who_hears(listeners, make_frame(0x029, {})), ElementsAre(3));
  EXPECT_THAT(who_hears(listeners, make_frame(0x05F, {})), ElementsAre(5));
  EXPECT_THAT(who_hears(listeners, make_frame(0x060, {})), IsEmpty());
  EXPECT_THAT(who_hears(listeners, make_frame(0x7FF, {})), IsEmpty());
  EXPECT_THAT(who_hears(listeners, extended(0x029)), IsEmpty());
}

TEST(Listeners, GiveASharedFrameToEachOnceInTheirOrder) {
  Listeners listeners;
  const FrameFilter nmt_and_own[] = {{0x000}, {0x180, 0x7F0}, {0x181}};
  const FrameFilter nmt[] = {{0x000}};
  listeners.add(1, nmt_and_own);
  listeners.add(2, nmt);
  EXPECT_THAT(who_hears(listeners, make_frame(0x000, {})), ElementsAre(1, 2));
  EXPECT_THAT(who_hears(listeners, make_frame(0x181, {})), ElementsAre(1));
}

TEST(Listeners, KnowLongIdsFromShortOnes) {
  Listeners listeners;
  const FrameFilter both[] = {{0x18FF0000, 0x1FFF0000, true}, {0x18FF0012, 0x1FFFFFFF, true}};
  const FrameFilter short_id{0x012};
  listeners.add(1, both);
  listeners.add(2, {&short_id, 1});
  EXPECT_THAT(who_hears(listeners, extended(0x18FF0012)), ElementsAre(1));
  EXPECT_THAT(who_hears(listeners, extended(0x18FE0012)), IsEmpty());
  EXPECT_THAT(who_hears(listeners, extended(0x012)), IsEmpty());
  EXPECT_THAT(who_hears(listeners, make_frame(0x012, {})), ElementsAre(2));
}

TEST(Listeners, HearNothingUnderAnIdThatNoFrameHas) {
  Listeners listeners;
  const FrameFilter all{0, 0, false};
  listeners.add(1, {&all, 1});
  EXPECT_THAT(who_hears(listeners, make_frame(0x7FF, {})), ElementsAre(1));
  EXPECT_THAT(who_hears(listeners, make_frame(0x800, {})), IsEmpty());
  EXPECT_THAT(who_hears(listeners, make_frame(0xFFFFFFFF, {})), IsEmpty());
}

TEST(Listeners, KnowWhichFramesTheyAreToldThemselves) {
  Listeners listeners;
  const FrameFilter node{0x020, 0x7E0, false};
  const FrameFilter long_node{0x18FF0000, 0x1FFF0000, true};
  const FrameRule told[] = {{.id = 0x02D}, {.id = 0x02E, .extended = true}};
  listeners.add(1, {&node, 1}, told);
  listeners.add(2, {&long_node, 1}, told);
  listeners.add(3, {&long_node, 1}, {told, 1});
  const auto who_sends = [&](const CanFrame& frame) {
    std::vector<int> slots;
    listeners.each(frame, [&](Listener l) {
      if (l.sends) slots.push_back(l.slot);
    });
    return slots;
  };
  EXPECT_THAT(who_sends(make_frame(0x02D, {})), ElementsAre(1));
  EXPECT_THAT(who_sends(make_frame(0x029, {})), IsEmpty());
  EXPECT_THAT(who_sends(make_frame(0x02E, {})), IsEmpty()) << "told to it with a long id only";
  EXPECT_THAT(who_sends(extended(0x18FF0012)), ElementsAre(2)) << "which of its ids is looked at";
}

TEST(Listeners, AllocateNothingForAFrame) {
  Listeners listeners;
  const FrameFilter one{0x020, 0x7E0, false};
  listeners.add(3, {&one, 1});
  const CanFrame frame = make_frame(0x029, {});
  int told = 0;
  const test::AllocationCounter counter;
  listeners.each(frame, [&](Listener) { ++told; });
  EXPECT_EQ(counter.count(), 0U);
  EXPECT_EQ(told, 1);
}

}  // namespace
}  // namespace drover::gateway
