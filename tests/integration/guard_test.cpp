// drover-guard as a process: what it does when everything around it breaks or is hostile.
#include <fcntl.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>

#include <array>
#include <cstring>
#include <thread>

#include "integration/guard_rig.h"

namespace drover::test {

namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

/// A pipe that nobody reads and that has room for nothing more.
int full_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return -1;
  ::fcntl(ends[1], F_SETFL, O_NONBLOCK);
  while (::write(ends[1], "x", 1) == 1) {
  }
  ::fcntl(ends[1], F_SETFL, 0);
  return ends[1];
}

class Guard : public GuardRig {
 protected:
  /// droverd drove a while, and is gone.
  void daemon_dies_after(std::chrono::milliseconds time) {
    beat(time);
    client().disconnect();
  }
  /// The guard sends to `link` again and again.
  bool is_stopped(const std::string& link, unsigned address) {
    (void)frames(link);
    int seen = 0;
    return wait_until([&] {
      for (const auto id : frames(link)) seen += id == address ? 1 : 0;
      return seen >= 5;
    });
  }
  /// Nothing comes for a while, with droverd's heartbeat going on.
  bool is_left_alone(const std::string& link) {
    beat(50ms);
    (void)frames(link);
    beat(100ms);
    return frames(link).empty();
  }
  bool hand_back() {
    beat(20ms);
    client().hand_back();
    return beat(1s, [this] { return shared().guard_holds == 0; });
  }
};

}  // namespace

TEST_F(Guard, SendsNothingWhileTheHeartbeatIsThere) {
  start();
  hand_over({});
  std::vector<runtime::GuardedLink> links;
  links.push_back(can_link("can0", {0x2D, 0x4D}));
  hand_over(std::move(links));
  beat(150ms);
  EXPECT_THAT(frames("can0"), IsEmpty());
  client().disconnect();
  EXPECT_TRUE(is_stopped("can0", 0x2D));
  EXPECT_TRUE(is_stopped("can0", 0x4D));
}

TEST_F(Guard, SendsAlthoughItsStandardErrorIsAFullPipe) {
  start({.standard_error = full_pipe()});
  hand_over_one_drive();
  daemon_dies_after(50ms);
  EXPECT_TRUE(is_stopped("can0", 0x2D));
}

TEST_F(Guard, GoesOnSendingWhenNobodyReadsItsNotifications) {
  ServiceManager manager(file("notify"));
  start({.manager = &manager});
  ASSERT_TRUE(wait_until([&] { return manager.heard("READY=1"); }));
  manager.stop_reading();
  hand_over_one_drive();
  daemon_dies_after(50ms);
  // Before, the library's call hung after 1.7 s of them.
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(is_stopped("can0", 0x2D));
    std::this_thread::sleep_for(200ms);
  }
  EXPECT_GT(shared().unsaid, 0U) << "what it could not say is counted";
}

TEST_F(Guard, StopsOneBusWhileAnotherTakesNothing) {
  start();
  std::vector<runtime::GuardedLink> links;
  links.push_back(can_link("can0", {0x2D}));  // its drives' end is not read
  links.push_back(can_link("can1", {0x4D}));
  hand_over(std::move(links));
  daemon_dies_after(50ms);
  ASSERT_TRUE(wait_until([&] { return shared().unsent > 0; })) << "can0 is full";
  EXPECT_TRUE(is_stopped("can1", 0x4D));
}

TEST_F(Guard, AnEmptySetDoesNotEndAHold) {
  start();
  hand_over_one_drive();
  daemon_dies_after(50ms);
  ASSERT_TRUE(is_stopped("can0", 0x2D));

  new_daemon();
  hand_over({});
  EXPECT_TRUE(beat(1s, [this] { return shared().set_refused == 1; }));
  EXPECT_FALSE(hand_back()) << "it could not stop what it moves";
  EXPECT_TRUE(is_stopped("can0", 0x2D));
}

TEST_F(Guard, ASmallerSetDoesNotEndAHoldUntilAPersonResetsIt) {
  start();
  std::vector<runtime::GuardedLink> links;
  links.push_back(can_link("can0", {0x2D}));
  links.push_back(can_link("can1", {0x4D}));
  hand_over(std::move(links));
  daemon_dies_after(50ms);
  ASSERT_TRUE(is_stopped("can1", 0x4D));

  new_daemon();
  hand_over_one_drive();
  EXPECT_TRUE(is_stopped("can1", 0x4D));
  EXPECT_THAT(output(), HasSubstr("can1 04D"));

  at_stop_socket("reset");
  EXPECT_TRUE(hand_back());
  EXPECT_TRUE(is_left_alone("can1"));
}

TEST_F(Guard, AnAbsentLinkOfANewDaemonIsStoppedOnTheGuardsOwnWay) {
  start();
  std::vector<runtime::GuardedLink> links;
  links.push_back(can_link("can0", {0x2D}));
  links.push_back(can_link("can1", {0x4D}));
  hand_over(std::move(links));
  daemon_dies_after(50ms);
  ASSERT_TRUE(is_stopped("can1", 0x4D));

  new_daemon();
  std::vector<runtime::GuardedLink> without;
  without.push_back(can_link("can0", {0x2D}));
  without.push_back(absent_link("can1", {0x4D}));
  hand_over(std::move(without));
  EXPECT_TRUE(is_stopped("can0", 0x2D)) << "with the new descriptor";
  EXPECT_TRUE(is_stopped("can1", 0x4D)) << "with the old one";
  EXPECT_TRUE(hand_back());
  EXPECT_EQ(shared().set_refused, 0U);
  EXPECT_TRUE(is_left_alone("can1"));

  client().disconnect();
  EXPECT_TRUE(is_stopped("can1", 0x4D));
  new_daemon();
  std::vector<runtime::GuardedLink> fresh;  // its adapter is back, as another interface
  fresh.push_back(can_link("can0", {0x2D}));
  fresh.push_back(can_link("can1", {0x4D}));
  hand_over(std::move(fresh));
  EXPECT_TRUE(is_stopped("can1", 0x4D)) << "at the drives' new end";
}

TEST_F(Guard, ALinkThatNeverWasThereIsToldAndHindersNobody) {
  start();
  std::vector<runtime::GuardedLink> links;
  links.push_back(can_link("can0", {0x2D}));
  links.push_back(absent_link("can1", {0x4D, 0x6D}));
  hand_over(std::move(links));
  EXPECT_FALSE(borrow("can1"));
  EXPECT_TRUE(wait_until([this] {
    return output().find("can1 is not there and never was") != std::string::npos;
  })) << output();
  EXPECT_THAT(at_stop_socket("state"), AllOf(HasSubstr("\"axes\":1,\"axes_never_reached\":2"),
                                             HasSubstr("\"set_refused\":false")));
  EXPECT_TRUE(hand_back());
  client().disconnect();
  EXPECT_TRUE(is_stopped("can0", 0x2D));
  EXPECT_THAT(at_stop_socket("state"), HasSubstr("\"in_command\":true"));

  new_daemon();
  hand_over_one_drive();
  EXPECT_TRUE(wait_until([this] { return output().find("lacks can1 04D") != std::string::npos; }))
      << "once named it stays, until a person resets it: " << output();
}

TEST_F(Guard, SaysThatItRefusedASetBeforeItAnswersAnythingElse) {
  start();
  std::vector<runtime::GuardedLink> links;
  links.push_back(can_link("can0", {0x2D}));
  links.push_back(can_link("can1", {0x4D}));
  hand_over(std::move(links));
  for (int i = 0; i < 20; ++i) {
    new_daemon();
    hand_over_one_drive();
    ASSERT_TRUE(borrow("can0"));
    EXPECT_EQ(shared().set_refused, 1U) << i;
  }
}

TEST_F(Guard, HearsANewDaemonBeforeItHasReadTheLastWordsOfTheOld) {
  start();
  ASSERT_EQ(::kill(pid(), SIGSTOP), 0);
  std::vector<runtime::GuardedLink> links;
  links.push_back(can_link("can0", {0x2D}));
  links.push_back(can_link("can1", {0x4D}));
  hand_over(std::move(links));
  new_daemon();
  hand_over_one_drive();
  ASSERT_EQ(::kill(pid(), SIGCONT), 0);
  EXPECT_TRUE(borrow("can0"));
  EXPECT_EQ(shared().set_refused, 1U) << "the old one's set counts, though he is gone";
}

TEST_F(Guard, ASetThatIsOfferedAgainAndAgainIsNoHeartbeat) {
  start();
  hand_over_one_drive();
  ASSERT_TRUE(beat(10s, [this] { return shared().guard_beats > 0; }));
  EXPECT_TRUE(wait_until([this] {
    std::vector<runtime::GuardedLink> same;
    same.push_back(can_link("can0", {0x2D}));
    (void)hand_over(std::move(same));
    return shared().guard_holds == 1;
  }));
}

TEST_F(Guard, AStopBeforeTheFirstSetEndsWhenDroverdAsksForTheBusAfterTheReset) {
  start();
  ASSERT_THAT(at_stop_socket("stop"), HasSubstr("\"latched\":true"));
  hand_over_one_drive();
  ASSERT_TRUE(beat(10s, [this] { return shared().guard_holds == 1; }));
  ASSERT_THAT(at_stop_socket("reset"), HasSubstr("\"latched\":false"));
  (void)frames("can0");
  beat(50ms);
  EXPECT_EQ(shared().guard_holds, 1U);
  EXPECT_TRUE(client().hand_back());
  EXPECT_TRUE(beat(10s, [this] { return shared().guard_holds == 0; }));
}

TEST_F(Guard, TellsWhoSpeaksAnotherVersion) {
  start();
  const link::UniqueFd other(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strcpy(address.sun_path, file("guard.sock").c_str());
  ASSERT_EQ(::connect(other.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  GuardMessage message;
  message.version = kGuardVersion + 1;
  ASSERT_GT(::send(other.get(), &message, sizeof message, MSG_NOSIGNAL), 0);
  EXPECT_TRUE(wait_until([this] {
    return output().find("droverd speaks version " + std::to_string(kGuardVersion + 1)) !=
           std::string::npos;
  })) << output();
  EXPECT_THAT(output(), HasSubstr("restart both"));
}

TEST_F(Guard, ASetThatCoversTheHeldOneReplacesItWithoutAGap) {
  start();
  hand_over_one_drive();
  daemon_dies_after(50ms);
  ASSERT_TRUE(is_stopped("can0", 0x2D));

  new_daemon();
  std::vector<runtime::GuardedLink> same;
  same.push_back(can_link("can0", {0x2D, 0x4D}));
  hand_over(std::move(same));
  EXPECT_TRUE(is_stopped("can0", 0x4D)) << "it holds on, with the new descriptor";
  EXPECT_TRUE(hand_back());
  EXPECT_TRUE(is_left_alone("can0"));
}

TEST_F(Guard, HearsNobodyButTheUserOfDroverd) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can be two users";
  start({.user = "4321"});
  ::chmod(std::filesystem::path(file("guard.sock")).parent_path().c_str(), 0755);
  ::chmod(file("guard.sock").c_str(), 0666);
  const auto is_heard_as = [this](uid_t uid) {
    const pid_t child = ::fork();
    if (child == 0) {
      sockaddr_un address{};
      address.sun_family = AF_UNIX;
      std::strcpy(address.sun_path, file("guard.sock").c_str());
      const int fd = ::socket(AF_UNIX, SOCK_SEQPACKET, 0);
      char byte = 0;
      const timeval patience{0, 200'000};
      ::setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
      if (::setuid(uid) != 0 ||
          ::connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
        ::_exit(3);
      ::_exit(::recv(fd, &byte, 1, 0) == 0 ? 1 : 0);  // 0 bytes: it was closed
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WEXITSTATUS(status);
  };
  EXPECT_EQ(is_heard_as(4322), 1);
  EXPECT_EQ(is_heard_as(4321), 0);
}

TEST_F(Guard, ASecondGuardLeavesTheFirstOnesSocketAlone) {
  start();
  const pid_t second = ::fork();
  if (second == 0) {
    ::close(STDERR_FILENO);
    ::execl(DROVER_GUARD_PROGRAM, "drover-guard", "--socket", file("guard.sock").c_str(), nullptr);
    ::_exit(127);
  }
  int status = 0;
  ::waitpid(second, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 2);
  hand_over_one_drive();
  daemon_dies_after(50ms);
  EXPECT_TRUE(is_stopped("can0", 0x2D));
}

TEST_F(Guard, StopsAtItsStopSocketWhateverDroverdDoesUntilItIsReset) {
  start();
  hand_over_one_drive();
  beat(50ms);
  EXPECT_THAT(at_stop_socket("stop"),
              AllOf(HasSubstr("\"latched\":true"), HasSubstr("\"axes\":1")));
  EXPECT_THAT(frames("can0"), Not(IsEmpty())) << "before the answer";
  EXPECT_EQ(shared().guard_latched, 1U);
  EXPECT_EQ(shared().latched_by_uid, ::getuid());

  EXPECT_FALSE(hand_back()) << "droverd does not get it by asking";
  EXPECT_TRUE(is_stopped("can0", 0x2D));

  EXPECT_THAT(at_stop_socket("reset"), HasSubstr("\"latched\":false"));
  EXPECT_FALSE(is_left_alone("can0")) << "the reset alone moves nothing";
  EXPECT_TRUE(hand_back());
  EXPECT_TRUE(is_left_alone("can0"));
}

TEST_F(Guard, ItsStopSocketCanDoNothingElse) {
  start();
  hand_over_one_drive();
  beat(50ms);
  GuardMessage hand_over_nothing;
  hand_over_nothing.verb = GuardVerb::watch;
  const std::string bytes(reinterpret_cast<const char*>(&hand_over_nothing),
                          sizeof hand_over_nothing);
  for (const std::string& word : {std::string("release"), std::string("stop now please, will you"),
                                  bytes, std::string("stop\n")})
    EXPECT_EQ(at_stop_socket(word), "no answer") << word.substr(0, 20);
  EXPECT_TRUE(is_left_alone("can0"));
  EXPECT_THAT(at_stop_socket("state"), HasSubstr("\"latched\":false"));
}

TEST_F(Guard, WhoConnectsAndSaysNothingKeepsNobodyFromStopping) {
  start();
  std::vector<link::UniqueFd> silent;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strcpy(address.sun_path, file("stop.sock").c_str());
  for (int i = 0; i < 40; ++i) {
    auto& fd = silent.emplace_back(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
    ::connect(fd.get(), reinterpret_cast<sockaddr*>(&address), sizeof address);
  }
  EXPECT_THAT(at_stop_socket("stop"), HasSubstr("\"latched\":true"));
}

TEST_F(Guard, SendsNothingToDrivesThatAPersonReleased) {
  start();
  hand_over_one_drive();
  shared().may_hold = GuardMayHold::released;
  daemon_dies_after(50ms);
  ASSERT_TRUE(wait_until([&] { return shared().guard_holds == 1; }));
  std::this_thread::sleep_for(50ms);
  EXPECT_THAT(frames("can0"), IsEmpty());

  // A new daemon that has not said anything yet changes nothing.
  new_daemon();
  hand_over_one_drive();
  std::this_thread::sleep_for(50ms);
  EXPECT_THAT(frames("can0"), IsEmpty());
}

/// An arm was not let go with the base: it would fall on who pushes.
TEST_F(Guard, DampsWhatOnlyTheDaemonHeldThoughAPersonReleasedTheBase) {
  for (const auto word : {GuardMayHold::released, GuardMayHold::cut}) {
    kill();
    new_daemon();
    start();
    std::vector<runtime::GuardedLink> links;
    links.push_back(can_link("can0", {0x2D}));
    links.push_back(can_link("can1", {0x01}));
    links.back().axes[0].held_by_daemon = true;
    hand_over(std::move(links));
    shared().may_hold = word;
    daemon_dies_after(50ms);
    EXPECT_TRUE(wait_until([&] { return !frames("can1").empty(); }));
    EXPECT_THAT(frames("can0"), IsEmpty());
  }
}

TEST_F(Guard, SendsNothingToDrivesWhosePowerTheDaemonCut) {
  start();
  hand_over_one_drive();
  shared().may_hold = GuardMayHold::cut;
  daemon_dies_after(50ms);
  ASSERT_TRUE(wait_until([&] { return shared().guard_holds == 1; }));
  std::this_thread::sleep_for(50ms);
  EXPECT_THAT(frames("can0"), IsEmpty());
  shared().may_hold = GuardMayHold::hold;
  EXPECT_TRUE(wait_until([&] { return !frames("can0").empty(); })) << "it was that word";
}

TEST_F(Guard, TheRelaysLineFallsWhenTheLastOfBothIsGone) {
  ServiceManager manager(file("notify"));
  start({.manager = &manager});
  // Stands in for the line's handle: when nobody has it, the other end sees that.
  std::array<int, 2> line{};
  ASSERT_EQ(::pipe2(line.data(), O_CLOEXEC | O_NONBLOCK), 0);
  const link::UniqueFd relay(line[0]);
  const auto fallen = [&] {
    char byte = 0;
    return ::read(relay.get(), &byte, 1) == 0;
  };
  hand_over_one_drive();
  ASSERT_TRUE(client().give_relay_line("gpio17", line[1]));
  EXPECT_FALSE(borrow("gpio16")) << "an answer, so that the line has arrived";
  ::close(line[1]);
  daemon_dies_after(20ms);
  ASSERT_TRUE(is_stopped("can0", 0x2D));
  EXPECT_FALSE(fallen()) << "the guard has it";

  new_daemon();
  hand_over({});
  auto lent = borrow("gpio17");
  EXPECT_TRUE(lent);
  for (const auto& one : manager.kept()) EXPECT_THAT(one.name, Not(HasSubstr("gpio")));
  kill();
  EXPECT_FALSE(fallen()) << "droverd has it";
  lent.reset();
  EXPECT_TRUE(fallen());
}

/// Of drives without a time-out of their own: the guard's zeros do not arrive, and the last word
/// that did was to drive.
TEST_F(Guard, TheRelaysLineFallsWhereADriveThatRunsOnIsNotReached) {
  for (const bool runs_on : {true, false}) {
    kill();
    new_daemon();
    start();
    std::array<int, 2> line{};
    ASSERT_EQ(::pipe2(line.data(), O_CLOEXEC | O_NONBLOCK), 0);
    const link::UniqueFd relay(line[0]);
    const auto fallen = [&] {
      char byte = 0;
      return ::read(relay.get(), &byte, 1) == 0;
    };
    std::vector<runtime::GuardedLink> links;
    links.push_back(can_link("can0", {0x200}));  // its drives' end is not read
    links.back().axes[0].runs_on = runs_on;
    hand_over(std::move(links));
    ASSERT_TRUE(client().give_relay_line("gpio17", line[1]));
    EXPECT_FALSE(borrow("gpio16")) << "an answer, so that the line has arrived";
    ::close(line[1]);
    daemon_dies_after(20ms);
    ASSERT_TRUE(wait_until([&] { return shared().unsent > 50; })) << "can0 is full";
    EXPECT_EQ(fallen(), runs_on);
    if (runs_on) EXPECT_THAT(output(), HasSubstr("the enable relay is opened"));
  }
}

}  // namespace drover::test
