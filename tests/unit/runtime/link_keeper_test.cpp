// What the keeper tells the guard of links that are there, are not, are lost and come back.
#include "runtime/link_keeper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "config/load.h"
#include "support/temp_folder.h"

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

/// A base on one bus and an arm on another.
enum class Relay : std::uint8_t { none, of_a_chip_that_is_not_there };

std::string base_and_arm(const std::string& folder, Relay relay) {
  const bool has_relay = relay != Relay::none;
  return R"({
  "links": {)" +
         std::string(has_relay ? R"("panel": {"gpio": "no_such_chip"}, )" : "") +
         R"("can0": {"can": "unix:)" + folder + R"(/can0"}, "can1": {"can": "unix:)" + folder +
         R"(/can1"}},
  "devices": {
    "chassis": {"driver": "agilex_v2", "link": "can0"},
    "turret": {"driver": "damiao", "link": "can1", "options": {"id": 1, "model": "DM4340"}}},
  "groups": {
    "base": {"kind": "twist", "device": "chassis", "track_m": 0.44, "hold": "level_ground_only"},
    "arm": {"joints": {"turret": {"min_rad": -1, "max_rad": 1, "max_velocity_radps": 1,
      "max_effort_Nm": 10, "stiffness_Nmprad": 80, "damping_Nmsprad": 3}}}},
  "guard": {"socket": ")" +
         folder + R"(/guard"},
  "mqtt": {"enabled": false},)" +
         (has_relay
              ? R"("outputs": {"link": "panel", "enable_relay": {"line": "relay"}}, "accept": [)"
              : R"("accept": ["no_relay", )") +
         R"("no_estop"]
})";
}

/// A bus that takes as many connections as come.
struct BusOfMany {
  explicit BusOfMany(const std::string& path)
      : listener(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    (void)::bind(listener.get(), reinterpret_cast<sockaddr*>(&address), sizeof address);
    (void)::listen(listener.get(), 200);
  }
  link::UniqueFd listener;
};

/// What a set that was offered says.
struct Offered {
  std::set<std::string> there;
  std::set<std::string> absent;
  std::vector<std::string> axes;
};

/// Takes each set that it is offered, and keeps its way to what is absent.
class GuardDouble final {
 public:
  explicit GuardDouble(const std::string& path)
      : listener_(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    (void)::bind(listener_.get(), reinterpret_cast<sockaddr*>(&address), sizeof address);
    (void)::listen(listener_.get(), 2);
    thread_ = std::thread([this] { serve(); });
  }
  ~GuardDouble() {
    stop_ = true;
    thread_.join();
  }
  GuardDouble(const GuardDouble&) = delete;
  GuardDouble& operator=(const GuardDouble&) = delete;

  std::vector<Offered> offered() {
    const std::lock_guard lock(mutex_);
    return sets_;
  }
  /// From now on it forgets its way to this link at each set.
  void lose(const std::string& link) {
    const std::lock_guard lock(mutex_);
    lost_ = link;
  }
  /// As if another one began in its place.
  void hang_up() { hangs_up_ = true; }
  /// While true it takes sets and answers nothing.
  std::atomic<bool> thinks{false};
  /// What it had to say when nobody waited for it any more.
  std::atomic<int> answers_lost{0};

 private:
  void serve() {
    while (!stop_) {
      std::array<pollfd, 2> fds{{{listener_.get(), POLLIN, 0}, {daemon_.get(), POLLIN, 0}}};
      const bool nothing = ::poll(fds.data(), daemon_ ? 2 : 1, 10) <= 0;
      if (hangs_up_.exchange(false)) daemon_.reset();
      if (nothing || (fds[0].revents == 0 && !daemon_)) continue;
      if (fds[0].revents != 0)
        daemon_ = link::UniqueFd(::accept(listener_.get(), nullptr, nullptr));
      else
        hear();
    }
  }
  void hear() {
    GuardMessage message;
    iovec vector{&message, sizeof message};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    msghdr header{};
    header.msg_iov = &vector;
    header.msg_iovlen = 1;
    header.msg_control = control.data();
    header.msg_controllen = control.size();
    if (::recvmsg(daemon_.get(), &header, MSG_CMSG_CLOEXEC) <= 0) return daemon_.reset();
    link::UniqueFd fd;
    if (const auto* c = CMSG_FIRSTHDR(&header); c != nullptr) {
      int passed = -1;
      std::memcpy(&passed, CMSG_DATA(c), sizeof passed);
      fd = link::UniqueFd(passed);
    }
    while (thinks && message.verb == GuardVerb::lend && !stop_) std::this_thread::sleep_for(1ms);
    const std::lock_guard lock(mutex_);
    const std::string name = message.name.data();
    switch (message.verb) {
      case GuardVerb::hello: next_ = {}; break;
      case GuardVerb::link: next_.there.insert(name); break;
      case GuardVerb::absent: next_.absent.insert(name); break;
      case GuardVerb::axis: next_.axes.push_back(name); break;
      case GuardVerb::watch:
        reached_.insert(next_.there.begin(), next_.there.end());
        reached_.erase(lost_);
        sets_.push_back(next_);
        break;
      case GuardVerb::lend: lend(message); break;
      default: break;
    }
  }
  void lend(GuardMessage answer) {
    iovec vector{&answer, sizeof answer};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    msghdr header{};
    header.msg_iov = &vector;
    header.msg_iovlen = 1;
    if (reached_.count(answer.name.data()) > 0) {
      header.msg_control = control.data();
      header.msg_controllen = control.size();
      auto* c = CMSG_FIRSTHDR(&header);
      c->cmsg_level = SOL_SOCKET;
      c->cmsg_type = SCM_RIGHTS;
      c->cmsg_len = CMSG_LEN(sizeof(int));
      const int any = listener_.get();
      std::memcpy(CMSG_DATA(c), &any, sizeof any);
    }
    if (::sendmsg(daemon_.get(), &header, MSG_NOSIGNAL) < 0) ++answers_lost;
  }

  link::UniqueFd listener_;
  link::UniqueFd daemon_;
  std::mutex mutex_;
  std::string lost_;
  std::set<std::string> reached_;
  Offered next_;
  std::vector<Offered> sets_;
  std::atomic<bool> hangs_up_{false};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

class LinkKeeperTest : public testing::Test {
 protected:
  explicit LinkKeeperTest(Relay relay = Relay::none) : relay_(relay) {
    EXPECT_THAT(loaded_.problems, IsEmpty());
    plug("can0");
    plug("can1");
  }
  ~LinkKeeperTest() override {
    stop_ = true;
    keeper_.wake();
    if (thread_.joinable()) thread_.join();
  }
  void plug(const std::string& bus) {
    buses_[bus] = std::make_unique<BusOfMany>(folder_.path() + "/" + bus);
  }
  void unplug(const std::string& bus) {
    buses_.erase(bus);
    std::filesystem::remove(folder_.path() + "/" + bus);
  }
  void start() {
    thread_ = std::thread([this] { keeper_.run(stop_); });
  }
  template <class Done>
  bool wait_until(Done done) {
    for (int i = 0; i < 2000; ++i) {
      take();
      if (done()) return true;
      std::this_thread::sleep_for(5ms);
    }
    return false;
  }
  /// As the control thread does.
  void take() {
    LinkHandover arrived;
    while (keeper_.take(arrived)) {
      if (!arrived.opened())
        problems_[arrived.slot] = std::string(arrived.problem.view());
      else
        open_[arrived.slot] = std::move(arrived);
    }
  }
  bool is_open(std::size_t bus) const { return open_.count(bus) > 0; }
  /// The adapter is pulled, and the control thread notices.
  void lose(std::size_t bus, const std::string& name) {
    unplug(name);
    auto dead = std::move(open_.at(bus));
    open_.erase(bus);
    dead.problem = "lost";
    ASSERT_TRUE(keeper_.give_back(dead));
  }
  std::size_t sets() { return guard_.offered().size(); }
  /// Nothing new was said to the guard for a while.
  bool guard_hears_nothing() {
    const auto before = sets();
    for (int i = 0; i < 60; ++i, std::this_thread::sleep_for(5ms)) take();
    return sets() == before;
  }

  Relay relay_;
  test::TempFolder folder_;
  std::map<std::string, std::unique_ptr<BusOfMany>> buses_;
  GuardDouble guard_{folder_.path() + "/guard"};
  config::Loaded loaded_ =
      config::load_text(base_and_arm(folder_.path(), relay_), DROVER_SOURCE_DIR "/config/maps");
  Gateway gateway_{loaded_.config};
  GuardMemory memory_;
  LinkKeeper keeper_{loaded_.config, gateway_.wiring(), memory_, gateway_.duties()};
  std::map<std::size_t, LinkHandover> open_;
  std::map<std::size_t, std::string> problems_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

TEST_F(LinkKeeperTest, AGuardedLinkThatIsLostStaysInTheGuardsSet) {
  start();
  ASSERT_TRUE(wait_until([this] { return is_open(0) && is_open(1); }));
  EXPECT_THAT(guard_.offered().back().there, ElementsAre("can0", "can1"));
  lose(1, "can1");
  EXPECT_TRUE(guard_hears_nothing()) << "a smaller set";
  EXPECT_TRUE(keeper_.guard_equipped());
}

TEST_F(LinkKeeperTest, OfTwoLostLinksTheOneThatComesBackFirstIsOfferedBesideTheNameOfTheOther) {
  start();
  ASSERT_TRUE(wait_until([this] { return is_open(0) && is_open(1); }));
  const auto axes = guard_.offered().back().axes;
  EXPECT_EQ(axes.size(), 2U);
  lose(0, "can0");
  lose(1, "can1");
  EXPECT_TRUE(guard_hears_nothing());
  plug("can0");
  ASSERT_TRUE(wait_until([this] { return is_open(0); }));
  EXPECT_THAT(guard_.offered().back().there, ElementsAre("can0"));
  EXPECT_THAT(guard_.offered().back().absent, ElementsAre("can1"));
  EXPECT_EQ(guard_.offered().back().axes, axes) << "each axis, always";
  EXPECT_TRUE(keeper_.guard_equipped());
  plug("can1");
  ASSERT_TRUE(wait_until([this] { return is_open(1); }));
  EXPECT_THAT(guard_.offered().back().there, ElementsAre("can0", "can1")) << "a fresh one";
  EXPECT_THAT(guard_.offered().back().absent, IsEmpty());
}

TEST_F(LinkKeeperTest, ALinkThatIsNotThereFromTheBeginningIsNamedAndTold) {
  unplug("can1");
  start();
  ASSERT_TRUE(wait_until([this] { return is_open(0); }));
  EXPECT_THAT(guard_.offered().back().absent, ElementsAre("can1"));
  EXPECT_EQ(guard_.offered().back().axes.size(), 2U);
  EXPECT_TRUE(keeper_.guard_equipped()) << "the base may drive";
  EXPECT_TRUE(wait_until([this] {
    return problems_[1].find("drover-guard has no way there either") != std::string::npos;
  })) << problems_[1];
}

TEST_F(LinkKeeperTest, WhatTheGuardHasNotAnsweredForMayNotBeMoved) {
  guard_.thinks = true;
  start();
  ASSERT_TRUE(wait_until([this] { return is_open(0) && is_open(1); }));
  EXPECT_FALSE(keeper_.guard_equipped());
  guard_.thinks = false;
  EXPECT_TRUE(wait_until([this] { return keeper_.guard_equipped(); }));
}

TEST_F(LinkKeeperTest, ALinkThatTheGuardDidNotGetIsNotHandedOnAndTheOtherDrives) {
  guard_.lose("can1");
  start();
  ASSERT_TRUE(wait_until([this] {
    return problems_[1].find("drover-guard did not take its way to can1") != std::string::npos;
  }));
  EXPECT_TRUE(is_open(0));
  EXPECT_FALSE(is_open(1));
  EXPECT_TRUE(keeper_.guard_equipped());
  guard_.lose("");
  EXPECT_TRUE(wait_until([this] { return is_open(1); })) << "it is offered again";
  EXPECT_TRUE(keeper_.guard_equipped());
}

TEST_F(LinkKeeperTest, ANewGuardThatDoesNotGetALinkOfTheControlThreadKeepsAllFromMoving) {
  start();
  ASSERT_TRUE(wait_until([this] { return is_open(0) && is_open(1); }));
  guard_.lose("can1");
  guard_.hang_up();
  EXPECT_TRUE(wait_until([this] { return !keeper_.guard_equipped(); }));
  guard_.lose("");
  EXPECT_TRUE(wait_until([this] { return keeper_.guard_equipped(); }));
}

class LinkKeeperWithARelay : public LinkKeeperTest {
 protected:
  LinkKeeperWithARelay() : LinkKeeperTest(Relay::of_a_chip_that_is_not_there) {}
};

/// Whoever looks for the relay's line connects as well.
TEST_F(LinkKeeperWithARelay, AGuardThatHungIsGivenTheSetOnTheNextConnection) {
  start();
  ASSERT_TRUE(wait_until([this] { return is_open(0) && is_open(1) && sets() > 0; }));
  const auto before = sets();
  guard_.thinks = true;
  for (int i = 0; i < 400; ++i, std::this_thread::sleep_for(5ms)) take();  // until it is given up
  guard_.thinks = false;
  EXPECT_TRUE(wait_until([&] { return sets() > before && keeper_.guard_equipped(); }));
}

/// Motors wait for 100 ms, and who only damps, or holds at rest, needs no guard.
TEST_F(LinkKeeperWithARelay, ABusIsThereWhileAGuardThatHangsIsStillWaitedFor) {
  guard_.thinks = true;
  start();
  ASSERT_TRUE(wait_until([this] { return is_open(0) && is_open(1); }));
  EXPECT_FALSE(keeper_.guard_equipped()) << "nothing on it may be moved";
  guard_.thinks = false;
  ASSERT_TRUE(wait_until([this] { return keeper_.guard_equipped(); }));
  EXPECT_EQ(guard_.answers_lost, 0) << "it was given up before";
}

TEST_F(LinkKeeperTest, ALinkThatOpensWhileTheGuardIsAwayMayNotBeMoved) {
  std::filesystem::remove(folder_.path() + "/guard");
  start();
  ASSERT_TRUE(wait_until([this] { return is_open(0) && is_open(1); }));
  EXPECT_FALSE(keeper_.guard_equipped());
}

}  // namespace
}  // namespace drover::runtime
