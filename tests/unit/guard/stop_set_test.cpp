#include "guard/stop_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>

namespace drover::guard {
namespace {

using namespace std::chrono_literals;
constexpr Time kStart{std::chrono::seconds(100)};

GuardMessage named(GuardVerb verb, std::uint32_t index, const char* name) {
  GuardMessage message;
  message.verb = verb;
  message.index = index;
  std::strcpy(message.name.data(), name);
  return message;
}

GuardMessage axis(std::uint32_t index, const char* name, std::uint32_t rounds = 1,
                  std::uint32_t period_ms = 10) {
  auto message = named(GuardVerb::axis, index, name);
  message.rounds = rounds;
  message.period_ms = period_ms;
  return message;
}

GuardMessage stop(std::uint32_t index, std::uint32_t round, char byte) {
  GuardMessage message;
  message.verb = GuardVerb::stop_message;
  message.index = index;
  message.round = round;
  message.size = 1;
  message.bytes[0] = static_cast<std::uint8_t>(byte);
  return message;
}

class GuardStopSet : public testing::Test {
 protected:
  GuardStopSet() {
    std::array<int, 2> ends{};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, ends.data()), 0);
    drives_ = ends[0];
    link_ = ends[1];
  }
  ~GuardStopSet() override { ::close(drives_); }
  void add_link(StopSet& set) {
    EXPECT_TRUE(set.add_link(named(GuardVerb::link, 0, "can0"), link_));
  }
  /// A hold of a wheel, "w", and of an arm that only droverd can hold, "a", begins.
  void hold_wheel_and_arm(StopSet& set) {
    add_link(set);
    auto arm = axis(1, "can0 001");
    arm.held_by_daemon = 1;
    EXPECT_TRUE(set.add_axis(axis(0, "can0 02D")) && set.add_axis(arm));
    EXPECT_TRUE(set.add_message(stop(0, 0, 'w')) && set.add_message(stop(1, 0, 'a')));
    set.begin_hold();
  }
  /// What the drives got since the last look.
  std::string heard() const {
    std::string all;
    char byte = 0;
    while (::recv(drives_, &byte, 1, MSG_DONTWAIT) == 1) all += byte;
    return all;
  }
  void play(StopSet& set, Time from, int cycles) const {
    for (int i = 0; i < cycles; ++i) set.play(from + i * 10ms);
  }
  int link() const { return link_; }

 private:
  int drives_ = -1;
  int link_ = -1;
};

TEST_F(GuardStopSet, PlaysRoundsInTurnEachInItsPeriod) {
  StopSet set;
  add_link(set);
  ASSERT_TRUE(set.add_axis(axis(0, "can0 1", 3, 20)));
  for (std::uint32_t round = 0; round < 3; ++round)
    ASSERT_TRUE(set.add_message(stop(0, round, static_cast<char>('a' + round))));
  set.begin_hold();
  play(set, kStart, 10);
  EXPECT_EQ(heard(), "abcab");
}

/// Its line takes nothing: only its supply stops what goes on by its last message.
TEST_F(GuardStopSet, TellsOfADriveThatRunsOnWhileNothingReachesIt) {
  for (const bool runs_on : {true, false}) {
    std::array<int, 2> ends{};
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, ends.data()), 0);
    StopSet set;
    ASSERT_TRUE(set.add_link(named(GuardVerb::link, 0, "can0"), ends[1]));
    auto wheel = axis(0, "can0 200");
    wheel.runs_on = runs_on ? 1 : 0;
    ASSERT_TRUE(set.add_axis(wheel) && set.add_message(stop(0, 0, 'w')));
    set.begin_hold();
    play(set, kStart, 50);  // nobody reads, and there is room
    EXPECT_FALSE(set.runs_on(kStart + 490ms));
    ::close(ends[0]);
    play(set, kStart + 500ms, 10);
    EXPECT_FALSE(set.runs_on(kStart + 590ms)) << "it may be a moment";
    play(set, kStart + 600ms, 10);
    EXPECT_EQ(set.runs_on(kStart + 690ms), runs_on);
    set.begin_hold();
    EXPECT_FALSE(set.runs_on(kStart + 690ms));
  }
}

/// It holds by what it was told, on a slope maybe: without its supply it would roll.
TEST_F(GuardStopSet, LeavesADriveItsSupplyThatWasToldItsStop) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, ends.data()), 0);
  StopSet set;
  ASSERT_TRUE(set.add_link(named(GuardVerb::link, 0, "can0"), ends[1]));
  auto wheel = axis(0, "can0 200");
  wheel.runs_on = 1;
  ASSERT_TRUE(set.add_axis(wheel) && set.add_message(stop(0, 0, 'w')));
  set.begin_hold();
  std::array<char, 64> read{};
  for (int i = 0; i < 510; ++i) {
    play(set, kStart + i * 10ms, 1);
    while (::recv(ends[0], read.data(), read.size(), 0) > 0) continue;
  }
  ::close(ends[0]);
  play(set, kStart + 5100ms, 40);
  EXPECT_FALSE(set.runs_on(kStart + 5490ms));
  set.begin_hold();
  play(set, kStart + 5500ms, 20);
  EXPECT_TRUE(set.runs_on(kStart + 5690ms)) << "of a new hold it was told nothing";
}

TEST_F(GuardStopSet, EachAxisHasItsOwnPeriod) {
  StopSet set;
  add_link(set);
  ASSERT_TRUE(set.add_axis(axis(0, "can0 1", 1, 10)));
  ASSERT_TRUE(set.add_axis(axis(1, "can0 2", 1, 50)));
  ASSERT_TRUE(set.add_message(stop(0, 0, '1')));
  ASSERT_TRUE(set.add_message(stop(1, 0, '2')));
  set.begin_hold();
  play(set, kStart, 10);
  EXPECT_EQ(heard(), "121111121111");
}

TEST_F(GuardStopSet, BeginsAHoldWithTheFirstRoundAtOnce) {
  StopSet set;
  add_link(set);
  ASSERT_TRUE(set.add_axis(axis(0, "can0 1", 2, 100)));
  ASSERT_TRUE(set.add_message(stop(0, 0, 'a')));
  ASSERT_TRUE(set.add_message(stop(0, 1, 'b')));
  set.begin_hold();
  play(set, kStart, 1);
  EXPECT_EQ(heard(), "a");
  set.begin_hold();
  play(set, kStart + 20ms, 1);
  EXPECT_EQ(heard(), "a");
}

TEST_F(GuardStopSet, LeavesToTheDaemonWhatOnlyThatCanHold) {
  StopSet set;
  hold_wheel_and_arm(set);
  set.play(kStart, StopSet::Whose::not_daemons);
  EXPECT_EQ(heard(), "w");
  EXPECT_TRUE(set.in_command(kStart));
  set.play(kStart + 10ms, StopSet::Whose::not_daemons);
  EXPECT_EQ(heard(), "w");
  set.play(kStart + 20ms);  // it is late
  EXPECT_EQ(heard(), "wa");
}

/// A person released the base; nobody let go of the arm.
TEST_F(GuardStopSet, PlaysWhatOnlyTheDaemonCanHoldThoughTheOthersWereReleased) {
  StopSet set;
  hold_wheel_and_arm(set);
  set.play(kStart, StopSet::Whose::daemons);
  EXPECT_EQ(heard(), "a");
  EXPECT_TRUE(set.in_command(kStart));
  set.play(kStart + 10ms);  // held again
  EXPECT_EQ(heard(), "wa");
}

TEST_F(GuardStopSet, IsNotInCommandOfWhatItCannotReach) {
  StopSet set;
  add_link(set);
  ASSERT_TRUE(set.add_axis(axis(0, "can0 1")));
  ASSERT_TRUE(set.add_message(stop(0, 0, '1')));
  set.begin_hold();
  set.play(kStart);
  EXPECT_TRUE(set.in_command(kStart + 40ms));
  EXPECT_FALSE(set.in_command(kStart + 60ms));
  ASSERT_TRUE(set.let_go("can0"));
  set.play(kStart + 70ms);
  EXPECT_EQ(set.unsent(), 1U);
  EXPECT_FALSE(set.in_command(kStart + 70ms));
}

TEST_F(GuardStopSet, IsCoveredOnlyByEachOfItsAxesWithADescriptorAndAMessage) {
  StopSet old;
  add_link(old);
  ASSERT_TRUE(old.add_axis(axis(0, "can0 1")));
  ASSERT_TRUE(old.add_message(stop(0, 0, '1')));
  StopSet other;
  EXPECT_FALSE(other.covers(old));
  EXPECT_EQ(other.lacks(old), "can0 1");
  EXPECT_TRUE(old.covers(other)) << "an empty one is covered by all";
  ASSERT_TRUE(other.add_link(named(GuardVerb::link, 0, "can0"), ::dup(link())));
  ASSERT_TRUE(other.add_axis(axis(0, "can0 1")));
  EXPECT_FALSE(other.covers(old)) << "it would say nothing to it";
  ASSERT_TRUE(other.add_message(stop(0, 0, '1')));
  EXPECT_TRUE(other.covers(old));
  other.let_go("can0");
  EXPECT_FALSE(other.covers(old)) << "it could not reach it";
}

/// A set of two buses with a drive each, with these descriptors; without one it is absent.
void fill(StopSet& set, int can0, int can1) {
  const auto verb = [](int fd) { return fd < 0 ? GuardVerb::absent : GuardVerb::link; };
  ASSERT_TRUE(set.add_link(named(verb(can0), 0, "can0"), can0));
  ASSERT_TRUE(set.add_link(named(verb(can1), 1, "can1"), can1));
  ASSERT_TRUE(set.add_axis(axis(0, "can0 1")));
  auto arm = axis(1, "can1 2");
  arm.link = 1;
  ASSERT_TRUE(set.add_axis(arm));
  ASSERT_TRUE(set.add_message(stop(0, 0, '1')));
  ASSERT_TRUE(set.add_message(stop(1, 0, '2')));
}

TEST_F(GuardStopSet, AnAbsentLinkHasTheWayOfTheSetBefore) {
  StopSet held;
  fill(held, ::dup(link()), link());
  StopSet next;
  fill(next, ::dup(link()), -1);
  EXPECT_TRUE(next.covers(held));
  EXPECT_EQ(next.axes(), 1U) << "before it inherits";
  next.inherit(held);
  EXPECT_EQ(next.descriptor("can1"), link()) << "its own, not another one";
  EXPECT_EQ(next.axes(), 2U);
  EXPECT_THAT(next.links_never_there(), testing::IsEmpty());
  held.clear();
  next.begin_hold();
  next.play(kStart);
  EXPECT_EQ(heard(), "12");
}

TEST_F(GuardStopSet, AFreshDescriptorIsTakenInPlaceOfTheOldOne) {
  StopSet held;
  fill(held, -1, ::dup(link()));
  StopSet next;
  fill(next, -1, link());
  next.inherit(held);
  EXPECT_EQ(next.descriptor("can1"), link());
}

TEST_F(GuardStopSet, WhatTwoSetsHaveNoWayToIsCovered) {
  StopSet held;
  fill(held, ::dup(link()), -1);
  StopSet next;
  fill(next, link(), -1);
  EXPECT_TRUE(next.covers(held));
  next.inherit(held);
  EXPECT_THAT(next.links_never_there(), testing::ElementsAre("can1"));
  EXPECT_EQ(next.axes_never_reached(), 1U);
  StopSet silent;
  ASSERT_TRUE(silent.add_link(named(GuardVerb::link, 0, "can0"), ::dup(link())));
  ASSERT_TRUE(silent.add_axis(axis(0, "can0 1")));
  ASSERT_TRUE(silent.add_message(stop(0, 0, '1')));
  EXPECT_EQ(silent.lacks(held), "can1 2") << "it has to be named, though nobody reaches it";
}

TEST_F(GuardStopSet, AnotherLineOfTheSameNameIsNotInherited) {
  StopSet held;
  fill(held, ::dup(link()), link());
  StopSet next;
  ASSERT_TRUE(next.add_link(named(GuardVerb::absent, 0, "can0"), -1));
  auto line = named(GuardVerb::absent, 1, "can1");
  line.kind = GuardLinkKind::tty;
  ASSERT_TRUE(next.add_link(line, -1));
  ASSERT_TRUE(next.add_axis(axis(0, "can0 1")));
  auto arm = axis(1, "can1 2");
  arm.link = 1;
  ASSERT_TRUE(next.add_axis(arm));
  ASSERT_TRUE(next.add_message(stop(0, 0, '1')) && next.add_message(stop(1, 0, '2')));
  EXPECT_EQ(next.lacks(held), "can1 2");
}

TEST_F(GuardStopSet, IsInCommandBesideALinkThatNeverWasThere) {
  StopSet set;
  fill(set, link(), -1);
  set.begin_hold();
  set.play(kStart);
  EXPECT_EQ(heard(), "1");
  EXPECT_TRUE(set.in_command(kStart)) << "nobody moved what nobody reached";
  EXPECT_EQ(set.unsent(), 0U);
}

TEST_F(GuardStopSet, IsNotInCommandOfALinkThatWasThere) {
  StopSet held;
  fill(held, ::dup(link()), ::dup(link()));
  ASSERT_TRUE(held.let_go("can1"));
  StopSet next;
  fill(next, link(), -1);
  EXPECT_TRUE(next.covers(held)) << "as it was before";
  next.inherit(held);
  next.begin_hold();
  next.play(kStart);
  EXPECT_EQ(heard(), "1");
  EXPECT_FALSE(next.in_command(kStart)) << "it may move still";
  EXPECT_EQ(next.axes(), 2U);
}

TEST_F(GuardStopSet, RefusesWhatContradictsItself) {
  StopSet set;
  add_link(set);
  EXPECT_FALSE(set.add_link(named(GuardVerb::absent, 1, "can1"), link())) << "absent, and there";
  auto endless = named(GuardVerb::link, 1, "x");
  endless.name.fill('x');
  EXPECT_FALSE(set.add_link(endless, -1)) << "a name without an end";
  EXPECT_FALSE(set.add_link(named(GuardVerb::link, 0, "again"), -1));
  EXPECT_FALSE(set.add_link(named(GuardVerb::link, kGuardMaxLinks, "x"), -1));
  EXPECT_FALSE(set.add_axis(axis(1, "can0 1"))) << "the first is 0";
  EXPECT_FALSE(set.add_axis(axis(0, "")));
  EXPECT_FALSE(set.add_axis(axis(0, "can0 1", 0)));
  EXPECT_FALSE(set.add_axis(axis(0, "can0 1", 1, 0))) << "it would flood the bus";
  EXPECT_FALSE(set.add_message(stop(0, 0, '1'))) << "no axis";
  ASSERT_TRUE(set.add_axis(axis(0, "can0 1")));
  EXPECT_FALSE(set.add_message(stop(0, 1, '1'))) << "no such round";
  auto long_one = stop(0, 0, '1');
  long_one.size = kGuardMaxBytes + 1;
  EXPECT_FALSE(set.add_message(long_one));
}

TEST_F(GuardStopSet, TellsWhichLinksNeverWereThere) {
  StopSet set;
  fill(set, link(), -1);
  ASSERT_TRUE(set.let_go("can0"));
  std::vector<GuardMessage> words;
  set.tell(words);
  EXPECT_EQ(words[0].verb, GuardVerb::link) << "it was there";
  EXPECT_EQ(words[1].verb, GuardVerb::absent);
}

TEST_F(GuardStopSet, ReadsBackWhatItTells) {
  StopSet set;
  add_link(set);
  ASSERT_TRUE(set.add_axis(axis(0, "can0 1", 2, 30)));
  ASSERT_TRUE(set.add_message(stop(0, 0, 'a')));
  ASSERT_TRUE(set.add_message(stop(0, 1, 'b')));
  std::vector<GuardMessage> words;
  set.tell(words);
  StopSet copy;
  for (const auto& word : words) {
    if (word.verb == GuardVerb::link) {
      ASSERT_TRUE(copy.add_link(word, ::dup(link())));
    }
    if (word.verb == GuardVerb::axis) {
      ASSERT_TRUE(copy.add_axis(word));
    }
    if (word.verb == GuardVerb::stop_message) {
      ASSERT_TRUE(copy.add_message(word));
    }
  }
  EXPECT_TRUE(copy.covers(set));
  copy.begin_hold();
  play(copy, kStart, 6);
  EXPECT_EQ(heard(), "ab");
}

}  // namespace
}  // namespace drover::guard
