// The serial half of the guard's protocol, on a pseudo-terminal: rounds in turn, whole packets, one
// flush, and the descriptor given back.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <thread>

#include "integration/guard_rig.h"

namespace drover::test {

namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::StartsWith;

std::vector<std::uint8_t> bytes(std::string_view text) {
  return {text.begin(), text.end()};
}

class GuardOnATty : public GuardRig {
 protected:
  GuardOnATty() {
    plug_in();
    start();
  }
  /// A terminal of its own.
  void plug_in() {
    device_ = link::UniqueFd(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    ::grantpt(device_.get());
    ::unlockpt(device_.get());
    open_line();
  }
  void open_line() {
    line_ = link::UniqueFd(
        ::open(::ptsname(device_.get()), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    termios raw{};
    ::tcgetattr(line_.get(), &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(line_.get(), TCSANOW, &raw);
  }
  /// Three rounds with a counter in them.
  void supply(std::size_t packet_size = 10, std::chrono::milliseconds period = 20ms) {
    std::vector<runtime::GuardedLink> links;
    links.push_back(tty_link(packet_size, period));
    take(std::move(links));
  }
  /// Both wires in one set, the terminal first or last.
  void supply_with_a_bus(bool tty_first) {
    std::vector<runtime::GuardedLink> links;
    if (tty_first) links.push_back(tty_link(100, 10ms));
    links.push_back(can_link("can0", {0x2D}));
    if (!tty_first) links.push_back(tty_link(100, 10ms));
    take(std::move(links));
  }
  /// Frames come there now, not only before.
  bool bus_is_stopped() {
    (void)frames("can0");
    std::size_t came = 0;
    return wait_until([&] {
      came += frames("can0").size();
      return came > 10;
    });
  }
  runtime::GuardedLink tty_link(std::size_t packet_size, std::chrono::milliseconds period) {
    runtime::GuardedLink link;
    link.name = "motors";
    link.kind = GuardLinkKind::tty;
    link.descriptor = link::UniqueFd(::fcntl(line_.get(), F_DUPFD_CLOEXEC, 0));
    runtime::GuardedAxis axis;
    axis.name = "motors 1";
    axis.period = period;
    for (const char* head : {"<stop:0", "<stop:1", "<stop:2"})
      axis.rounds.push_back({bytes(head + std::string(packet_size - 8, '-') + ">")});
    link.axes.push_back(axis);
    return link;
  }
  void take(std::vector<runtime::GuardedLink> links) {
    hand_over(std::move(links));
    EXPECT_FALSE(borrow("nothing")) << "an answer: all has arrived";
  }
  /// A droverd that lives, until it goes out of scope.
  std::jthread beating() {
    return std::jthread([this](const std::stop_token& ended) {
      while (!ended.stop_requested()) {
        shared().daemon_beats.fetch_add(1);
        std::this_thread::sleep_for(2ms);
      }
    });
  }
  /// More than a reader's buffer: the rest waits in the line, where a flush takes it.
  static constexpr std::size_t kMuch = 8000;
  void write_much() {
    const std::string much(kMuch, 's');
    ASSERT_EQ(::write(line().get(), much.data(), much.size()), static_cast<ssize_t>(much.size()));
  }
  /// Somebody has the drives' end open: else their end sees EIO.
  bool is_open() const {
    char byte = 0;
    return ::read(device(), &byte, 1) >= 0 || errno != EIO;
  }
  std::string read_some() {
    std::array<char, 32768> buffer{};
    const auto n = ::read(device_.get(), buffer.data(), buffer.size());
    return n <= 0 ? std::string() : std::string(buffer.data(), static_cast<std::size_t>(n));
  }
  std::string read_for(std::chrono::milliseconds time) {
    std::string all;
    const auto end = std::chrono::steady_clock::now() + time;
    while (std::chrono::steady_clock::now() < end) {
      all += read_some();
      std::this_thread::sleep_for(5ms);
    }
    return all;
  }
  void hang_up() { device_.reset(); }
  int device() const { return device_.get(); }
  link::UniqueFd& line() { return line_; }

 private:
  link::UniqueFd device_;
  link::UniqueFd line_;
};

}  // namespace

TEST_F(GuardOnATty, PlaysItsRoundsInTurn) {
  supply();
  client().disconnect();
  const auto heard = read_for(400ms);
  EXPECT_THAT(heard, StartsWith("<stop:0--><stop:1--><stop:2--><stop:0-->"));
  EXPECT_LT(heard.size(), 10 * 25U) << "one round each 20 ms, not each cycle";
}

TEST_F(GuardOnATty, ThrowsAwayOnceWhatTheDeadDaemonLeftInTheLine) {
  supply();
  const std::string old(200, 'm');
  ::ioctl(line().get(), TCXONC, TCOOFF);  // nothing leaves meanwhile
  const auto written = ::write(line().get(), old.data(), old.size());
  ::ioctl(line().get(), TCXONC, TCOON);
  client().disconnect();
  std::this_thread::sleep_for(100ms);
  // A pseudo-terminal's queue is the reader's: a flush of the output empties it there.
  const auto heard = read_for(200ms);
  EXPECT_THAT(heard, StartsWith("<stop:")) << written << " old bytes";
  EXPECT_THAT(heard, HasSubstr("<stop:0--><stop:1--><stop:2-->")) << "flushed once, not each time";
}

TEST_F(GuardOnATty, LeavesWhatALivingDaemonWroteInTheLineWhenASetIsOffered) {
  const std::jthread alive = beating();
  supply();
  write_much();
  supply();
  EXPECT_EQ(read_for(100ms).size(), kMuch);
}

TEST_F(GuardOnATty, LeavesItAlsoWhenTheOfferedSetIsRefused) {
  const std::jthread alive = beating();
  supply();
  std::vector<runtime::GuardedLink> other(1);
  other[0].name = "another";
  other[0].kind = GuardLinkKind::tty;
  other[0].descriptor = link::UniqueFd(::fcntl(line().get(), F_DUPFD_CLOEXEC, 0));
  ASSERT_TRUE(hand_over(std::move(other)));
  EXPECT_FALSE(borrow("nothing"));
  ASSERT_EQ(shared().set_refused, 1U);
  write_much();
  supply();
  EXPECT_EQ(read_for(100ms).size(), kMuch);
}

TEST_F(GuardOnATty, GoesOnWithAPacketThatItHasBegunWhenASetTakesThePlaceOfTheOther) {
  constexpr std::size_t kSize = 100;
  supply(kSize, 10ms);
  client().disconnect();
  ASSERT_TRUE(wait_until([&] { return shared().unsent > 3; })) << "full, in the middle of a packet";
  new_daemon();
  supply(kSize, 10ms);
  const std::string heard = read_for(300ms);
  ASSERT_GT(heard.size(), 2 * kSize);
  for (std::size_t at = 0; at + kSize <= heard.size(); at += kSize)
    ASSERT_THAT(heard.substr(at, kSize), testing::MatchesRegex("<stop:[012]-+>")) << "at " << at;
}

TEST_F(GuardOnATty, WritesWholePacketsOnlyWhenTheLineWasFull) {
  constexpr std::size_t kSize = 100;
  supply(kSize, 10ms);
  client().disconnect();
  // Nobody reads until it is full: 19674 bytes are no multiple of its packets.
  ASSERT_TRUE(wait_until([&] { return shared().unsent > 3; })) << "full";
  std::string heard = read_for(300ms);
  ASSERT_THAT(heard, StartsWith("<stop:"));
  for (std::size_t at = 0; at + kSize <= heard.size(); at += kSize) {
    const auto packet = heard.substr(at, kSize);
    ASSERT_THAT(packet, testing::MatchesRegex("<stop:[012]-+>")) << "at " << at;
    const int step = at == 0 ? 1 : (heard[at + 6] - heard[at + 6 - kSize] + 3) % 3;
    ASSERT_EQ(step, 1) << "the counter jumped at " << at;
  }
}

TEST_F(GuardOnATty, IsNotHeldUpWhenSomebodyMadeTheLineBlocking) {
  supply(100, 10ms);
  client().disconnect();
  ::fcntl(line().get(), F_SETFL, ::fcntl(line().get(), F_GETFL) & ~O_NONBLOCK);
  ASSERT_TRUE(wait_until([&] { return shared().unsent > 3; })) << "full, and it goes on";
}

TEST_F(GuardOnATty, IsStoppedTogetherWithTheBusOfTheSameSet) {
  for (const bool tty_first : {true, false}) {
    new_daemon();
    supply_with_a_bus(tty_first);
    client().disconnect();
    EXPECT_TRUE(bus_is_stopped());
    EXPECT_THAT(read_for(50ms), HasSubstr("<stop:"));
  }
}

TEST_F(GuardOnATty, DoesNotHoldUpTheBusWhenItTakesNothingMore) {
  for (const bool tty_first : {true, false}) {
    new_daemon();
    supply_with_a_bus(tty_first);
    const std::uint64_t before = shared().unsent;
    client().disconnect();
    ASSERT_TRUE(wait_until([&] {
      (void)frames("can0");
      return shared().unsent > before + 3;
    })) << "it is full, and the bus is not";
    EXPECT_TRUE(bus_is_stopped());
    EXPECT_THAT(read_for(50ms), HasSubstr("<stop:")) << "read again it goes on";
  }
}

TEST_F(GuardOnATty, LeavesTheBusStoppedWhenItsCableIsTorn) {
  for (const bool before_the_kill : {true, false}) {
    plug_in();
    new_daemon();
    supply_with_a_bus(true);
    if (before_the_kill) hang_up();
    client().disconnect();
    EXPECT_TRUE(bus_is_stopped());
    hang_up();
    EXPECT_TRUE(bus_is_stopped());
  }
}

TEST_F(GuardOnATty, IsStoppedWhileTheBusOfTheSameSetTakesNothing) {
  supply_with_a_bus(false);
  client().disconnect();
  std::string heard;
  // Nobody reads the bus: it is full.
  ASSERT_TRUE(wait_until([&] {
    heard += read_some();
    return shared().unsent > 3;
  }));
  EXPECT_THAT(read_for(200ms), HasSubstr("<stop:"));
}

TEST_F(GuardOnATty, LendsTheLineToTheNextDroverd) {
  supply();
  ::ioctl(line().get(), TIOCEXCL);
  client().disconnect();
  line().reset();
  new_daemon();
  hand_over({});
  auto lent = borrow("motors");
  ASSERT_TRUE(lent);
  EXPECT_TRUE(::isatty(lent.get()));
  EXPECT_EQ(::write(lent.get(), "x", 1), 1);
}

TEST_F(GuardOnATty, LetsGoOfALineWhenAskedSoThatItCanBeOpenedAnew) {
  supply();
  line().reset();
  EXPECT_TRUE(is_open());
  ASSERT_TRUE(client().let_go("motors"));
  EXPECT_FALSE(borrow("motors"));
  EXPECT_FALSE(is_open());
}

TEST_F(GuardOnATty, LetsGoOfALineOfASetThatItRefused) {
  hand_over_one_drive();
  supply();
  ASSERT_EQ(shared().set_refused, 1U);
  line().reset();
  EXPECT_TRUE(is_open());
  ASSERT_TRUE(client().let_go("motors"));
  EXPECT_FALSE(borrow("motors"));
  EXPECT_FALSE(is_open());
}

TEST_F(GuardOnATty, ClosesALineThatHungUp) {
  supply();
  client().disconnect();
  ASSERT_THAT(read_for(50ms), StartsWith("<stop:"));
  new_daemon();
  hand_over({});
  hang_up();
  EXPECT_TRUE(wait_until([this] { return !borrow("motors"); }));
}

}  // namespace drover::test
