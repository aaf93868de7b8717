// `drover stop` and `drover reset` against the real guard, with droverd gone or hung.
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <atomic>
#include <cstring>
#include <thread>

#include "integration/guard_rig.h"
#include "integration/process.h"

namespace drover::test {

namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

struct Outcome {
  int code = -1;
  std::string text;
  std::chrono::steady_clock::duration took{};
};

class GuardAndCommandLine : public GuardRig {
 protected:
  Outcome drover(const std::vector<std::string>& words) {
    std::vector<std::string> all{DROVER_PROGRAM, "--socket", file("drover.sock")};
    all.insert(all.end(), words.begin(), words.end());
    const auto begin = std::chrono::steady_clock::now();
    Process process(all, file(("drover" + std::to_string(++calls_)).c_str()));
    const auto code = process.wait(10s);
    return {code.value_or(-1), process.output(), std::chrono::steady_clock::now() - begin};
  }
  void supply() {
    hand_over_one_drive();
    beat(50ms);
  }
  /// Takes connections and answers nobody.
  link::UniqueFd hung_daemon() {
    link::UniqueFd fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, file("drover.sock").c_str());
    EXPECT_EQ(::bind(fd.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(fd.get(), 4), 0);
    return fd;
  }

  /// One that answers each question with the same line, until it is gone.
  class RefusingDaemon {
   public:
    RefusingDaemon(link::UniqueFd fd, std::string line)
        : fd_(std::move(fd)), line_(std::move(line)), thread_([this] { serve(); }) {}
    ~RefusingDaemon() {
      ends_ = true;
      ::shutdown(fd_.get(), SHUT_RDWR);
      thread_.join();
    }

   private:
    void serve() {
      while (!ends_) {
        const link::UniqueFd client(::accept(fd_.get(), nullptr, nullptr));
        std::array<char, 1024> question{};
        if (client.get() < 0 || ::recv(client.get(), question.data(), question.size(), 0) <= 0)
          continue;
        (void)::send(client.get(), line_.data(), line_.size(), MSG_NOSIGNAL);
      }
    }
    link::UniqueFd fd_;
    std::string line_;
    std::atomic<bool> ends_{false};
    std::thread thread_;
  };

 private:
  int calls_ = 0;
};

}  // namespace

TEST_F(GuardAndCommandLine, StopWorksWithoutDroverdAndSaysWhoObeyed) {
  start();
  supply();
  const auto stopped = drover({"stop"});
  EXPECT_EQ(stopped.code, 0) << stopped.text;
  EXPECT_THAT(stopped.text, HasSubstr("drover-guard stops the robot; droverd does not run"));
  EXPECT_THAT(frames("can0"), Not(IsEmpty()));
}

TEST_F(GuardAndCommandLine, StopSaysHowManyDrivesTheGuardNeverHadAWayTo) {
  start();
  std::vector<runtime::GuardedLink> links;
  links.push_back(can_link("can0", {0x2D}));
  links.push_back(absent_link("can1", {0x4D, 0x6D}));
  hand_over(std::move(links));
  beat(50ms);
  const auto stopped = drover({"stop"});
  EXPECT_EQ(stopped.code, 0) << stopped.text;
  EXPECT_THAT(stopped.text, HasSubstr("drives to which it never had a way: 2"));
}

TEST_F(GuardAndCommandLine, StopDoesNotWaitLongForADroverdThatHangs) {
  start();
  supply();
  const auto daemon = hung_daemon();
  const auto stopped = drover({"stop", "--json"});
  EXPECT_EQ(stopped.code, 0) << stopped.text;
  EXPECT_THAT(stopped.text, HasSubstr(R"({"ok":true,"guard":{"ok":true},"droverd":{"ok":false)"));
  EXPECT_LT(stopped.took, 3s) << "it used to be ten";
  EXPECT_EQ(shared().guard_latched, 1U);
}

TEST_F(GuardAndCommandLine, StopDoesNotClaimToHoldARobotThatWasReleased) {
  start();
  supply();
  shared().may_hold = GuardMayHold::released;
  beat(50ms);
  const auto stopped = drover({"stop"});
  EXPECT_EQ(stopped.code, 0) << stopped.text;
  EXPECT_THAT(stopped.text, HasSubstr("its drives were released or have no power and hold nothing: "
                                      "drover hold"));
}

TEST_F(GuardAndCommandLine, StopFailsWhenNobodyHears) {
  const auto stopped = drover({"stop"});
  EXPECT_EQ(stopped.code, 3);
  EXPECT_THAT(stopped.text, HasSubstr("nobody stops the robot: drover-guard does not run"));
}

TEST_F(GuardAndCommandLine, StopDoesNotClaimSuccessOfAGuardThatKnowsNoDrives) {
  start();
  const auto stopped = drover({"stop"});
  EXPECT_EQ(stopped.code, 1);
  EXPECT_THAT(stopped.text, HasSubstr("knows no drives"));
}

TEST_F(GuardAndCommandLine, ResetSaysThatOnlyTheGuardHeardIt) {
  start();
  supply();
  ASSERT_EQ(drover({"stop"}).code, 0);
  const auto reset = drover({"reset"});
  EXPECT_EQ(reset.code, 3);
  EXPECT_THAT(reset.text, HasSubstr("only drover-guard's stop is over: droverd does not run"));
  EXPECT_THAT(at_stop_socket("state"), HasSubstr("\"latched\":false"));
}

/// It may have been done: nobody refused.
TEST_F(GuardAndCommandLine, ResetThatDroverdDoesNotAnswerIsNotToldAsRefused) {
  start();
  supply();
  ASSERT_EQ(drover({"stop"}).code, 0);
  const RefusingDaemon daemon(hung_daemon(), "");
  const auto reset = drover({"reset"});
  EXPECT_EQ(reset.code, 3) << reset.text;
  EXPECT_THAT(reset.text, HasSubstr("not known: drover-guard's stop is over; droverd closed the "
                                    "connection before it answered: it may have done it"));
  EXPECT_THAT(reset.text, Not(HasSubstr("refused")));
}

/// droverd refuses while what stopped the robot persists: then nothing of the stop is over.
TEST_F(GuardAndCommandLine, ResetThatDroverdRefusesLeavesTheGuardsStopAsItWas) {
  start();
  supply();
  ASSERT_EQ(drover({"stop"}).code, 0);
  const RefusingDaemon daemon(hung_daemon(), "{\"ok\":false,\"reason\":\"the e-stop is lost\"}\n");
  const auto reset = drover({"reset"});
  EXPECT_EQ(reset.code, 1) << reset.text;
  EXPECT_THAT(reset.text, HasSubstr("refused: the e-stop is lost"));
  EXPECT_THAT(at_stop_socket("state"), HasSubstr("\"latched\":true"));
  EXPECT_THAT(output(), Not(HasSubstr("reset"))) << "not even for a moment";
}

}  // namespace drover::test
