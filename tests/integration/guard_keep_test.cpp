// What outlives the guard: it is killed, and the one after it goes on from what the service manager
// kept.
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <array>
#include <thread>

#include "integration/guard_rig.h"

namespace drover::test {

namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class GuardKeeps : public GuardRig {
 protected:
  GuardKeeps() : manager_(file("notify")) { start({.manager = &manager_}); }

  void supply(const std::vector<std::string>& buses) {
    std::vector<runtime::GuardedLink> links;
    for (const auto& bus : buses) links.push_back(can_link(bus, {0x2D}));
    hand_over(std::move(links));
    ASSERT_TRUE(beat(10s, [&] { return keeps_a_set(); }));
  }
  /// An empty one is kept from the guard's beginning.
  bool keeps_a_set() {
    for (const auto& one : manager_.kept()) {
      struct stat info {};
      if (one.name.starts_with("recipe") && ::fstat(one.fd.get(), &info) == 0 &&
          info.st_size > static_cast<off_t>(sizeof(GuardMessage)))
        return true;
    }
    return false;
  }
  void start_again() { start({.manager = &manager_}); }
  bool is_stopped(const std::string& link) {
    (void)frames(link);
    return wait_until([&] { return !frames(link).empty(); });
  }
  ServiceManager& manager() { return manager_; }

 private:
  ServiceManager manager_;
};

}  // namespace

TEST_F(GuardKeeps, HoldingThroughItsOwnDeathWithoutDroverd) {
  supply({"can0", "can1"});
  client().disconnect();
  ASSERT_TRUE(is_stopped("can0"));
  for (int i = 0; i < 3; ++i) {
    kill();
    (void)frames("can0");
    (void)frames("can1");
    start_again();
    EXPECT_TRUE(is_stopped("can0"));
    EXPECT_TRUE(is_stopped("can1"));
  }
}

TEST_F(GuardKeeps, WatchingTheHeartbeatOfADroverdThatGoesOn) {
  supply({"can0"});
  beat(50ms);
  kill();
  (void)frames("can0");
  start({.manager = &manager(), .wait = false});
  const auto before = shared().guard_beats.load();
  beat(200ms);
  EXPECT_GT(shared().guard_beats, before) << "it has the memory of the one before it";
  EXPECT_THAT(frames("can0"), IsEmpty());
  // The heartbeat ends, with no word to this guard ever.
  EXPECT_TRUE(is_stopped("can0"));
}

TEST_F(GuardKeeps, TheDrivesOfADroverdThatDiedWithIt) {
  supply({"can0"});
  beat(50ms);
  kill();
  client().disconnect();
  start_again();
  EXPECT_TRUE(is_stopped("can0"));
}

TEST_F(GuardKeeps, AStopUntilItIsReset) {
  supply({"can0"});
  beat(20ms);
  ASSERT_THAT(at_stop_socket("stop"), HasSubstr("\"latched\":true"));
  kill();
  start_again();
  EXPECT_THAT(at_stop_socket("state"), HasSubstr("\"latched\":true"));
  beat(50ms);
  EXPECT_TRUE(is_stopped("can0"));
}

TEST_F(GuardKeeps, AStopThatCameBeforeAnySet) {
  ASSERT_THAT(at_stop_socket("stop"), HasSubstr("\"latched\":true"));
  ASSERT_TRUE(wait_until([this] { return manager().keeps("state"); }));
  kill();
  start_again();
  EXPECT_THAT(at_stop_socket("state"), HasSubstr("\"latched\":true"));
  EXPECT_THAT(output(), Not(HasSubstr("goes on with 0 axes")));
}

TEST_F(GuardKeeps, ThatAPersonReleasedTheDrives) {
  supply({"can0"});
  shared().may_hold = GuardMayHold::released;
  beat(50ms);
  client().disconnect();
  std::this_thread::sleep_for(30ms);
  kill();
  (void)frames("can0");
  start_again();
  std::this_thread::sleep_for(100ms);
  EXPECT_THAT(frames("can0"), IsEmpty());
}

TEST_F(GuardKeeps, TheNewestSet) {
  supply({"can0"});
  supply({"can0", "can1"});
  ASSERT_TRUE(beat(10s, [&] { return manager().keeps("link.can1"); }));
  beat(200ms);  // its words come last
  client().disconnect();
  ASSERT_TRUE(is_stopped("can1"));
  kill();
  start_again();
  EXPECT_TRUE(is_stopped("can0"));
  EXPECT_TRUE(is_stopped("can1"));
}

TEST_F(GuardKeeps, AWholeSetAtEachMoment) {
  supply({"can0"});
  for (int i = 0; i < 10; ++i) {
    hand_over_one_drive();
    beat(std::chrono::milliseconds(5 * i));
    kill();
    client().disconnect();
    start_again();
    EXPECT_THAT(at_stop_socket("state"), HasSubstr("\"axes\":1")) << i;
  }
}

TEST_F(GuardKeeps, StoppingTheOtherBusWhenOneDescriptorWasLost) {
  supply({"can0", "can1"});
  client().disconnect();
  ASSERT_TRUE(is_stopped("can1"));
  kill();
  std::erase_if(manager().kept(), [](const auto& one) { return one.name == "link.can0"; });
  start_again();
  EXPECT_TRUE(is_stopped("can1"));
}

TEST_F(GuardKeeps, TheWayToALinkThatWasAbsentSince) {
  supply({"can0", "can1"});
  ASSERT_TRUE(beat(10s, [&] { return manager().keeps("link.can1"); }));
  new_daemon();
  std::vector<runtime::GuardedLink> links;
  links.push_back(can_link("can0", {0x2D}));
  links.push_back(absent_link("can1", {0x2D}));
  links.push_back(absent_link("can2", {0x2D}));
  hand_over(std::move(links));
  beat(300ms);  // all of it is there
  client().disconnect();
  kill();
  (void)frames("can1");
  start_again();
  EXPECT_TRUE(is_stopped("can0"));
  EXPECT_TRUE(is_stopped("can1"));
  EXPECT_THAT(at_stop_socket("state"), HasSubstr("\"axes\":2,\"axes_never_reached\":1"));

  new_daemon();
  std::vector<runtime::GuardedLink> again;
  again.push_back(absent_link("can0", {0x2D}));
  again.push_back(absent_link("can1", {0x2D}));
  again.push_back(absent_link("can2", {0x2D}));
  hand_over(std::move(again));
  EXPECT_TRUE(borrow("can0"));
  EXPECT_TRUE(borrow("can1"));
  EXPECT_FALSE(borrow("can2"));
  EXPECT_EQ(shared().set_refused, 0U);
  EXPECT_TRUE(is_stopped("can1"));
}

TEST_F(GuardKeeps, NothingOfALineThatIsLetGo) {
  supply({"can0", "can1"});
  ASSERT_TRUE(beat(10s, [&] { return manager().keeps("link.can1"); }));
  beat(200ms);  // all of it is there
  ASSERT_TRUE(client().let_go("can1"));
  EXPECT_TRUE(beat(10s, [&] { return !manager().keeps("link.can1"); }))
      << "kept open, its name would stay taken";
  EXPECT_TRUE(beat(10s, [&] { return manager().keeps("link.can0"); }));
}

TEST_F(GuardKeeps, NothingOfWhatIsNotWhole) {
  supply({"can0"});
  client().disconnect();
  ASSERT_TRUE(is_stopped("can0"));
  kill();
  std::erase_if(manager().kept(), [](const auto& one) { return one.name.starts_with("recipe"); });
  (void)frames("can0");
  start_again();
  std::this_thread::sleep_for(100ms);
  EXPECT_THAT(frames("can0"), IsEmpty());
  EXPECT_THAT(at_stop_socket("state"), HasSubstr("\"axes\":0"));
}

TEST_F(GuardKeeps, TryingToLeaveItsThingsUntilTheyAreTaken) {
  ASSERT_TRUE(wait_until([&] { return manager().heard("READY=1"); }));
  manager().stop_reading();
  hand_over_one_drive();
  ASSERT_TRUE(beat(5s, [&] { return shared().unsaid > 0; }));
  EXPECT_TRUE(beat(5s, [&] { return keeps_a_set(); })) << "now that it reads again";
}

}  // namespace drover::test
