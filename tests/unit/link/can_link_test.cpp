#include "link/can_link.h"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include "link/can_open.h"
#include "link/can_wire.h"

namespace drover::link {
namespace {

using namespace std::chrono_literals;

constexpr Time kNow{std::chrono::seconds(100)};
const StampWindow kWindow{kNow - 5ms, kNow, {}};

/// A link whose other end the test holds.
struct Pair {
  Pair() {
    int fds[2];
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, fds) == 0) {
      link = std::make_unique<CanLink>(UniqueFd(fds[0]));
      peer = UniqueFd(fds[1]);
    }
  }
  void put(const CanFrame& frame) const {
    canfd_frame wire;
    const auto size = to_wire(frame, wire);
    ASSERT_EQ(::send(peer.get(), &wire, size, 0), static_cast<ssize_t>(size));
  }
  std::unique_ptr<CanLink> link;
  UniqueFd peer;
};

TEST(CanLink, SaysWhenItsOtherEndIsGone) {
  Pair pair;
  FrameBatch batch;
  pair.peer.reset();
  EXPECT_FALSE(pair.link->receive(kWindow, batch));
  EXPECT_NE(pair.link->error(), 0);
  EXPECT_FALSE(pair.link->send(std::vector{make_frame(1)}));
}

TEST(CanLink, CountsADatagramThatIsNoFrame) {
  Pair pair;
  ASSERT_EQ(::send(pair.peer.get(), "12345", 5, 0), 5);
  pair.put(make_frame(0x123, {1}));
  FrameBatch batch;
  ASSERT_TRUE(pair.link->receive(kWindow, batch));
  ASSERT_EQ(batch.size(), 1U);
  EXPECT_EQ(batch[0].frame.id, 0x123U);
  EXPECT_EQ(pair.link->counters().malformed, 1U);
}

TEST(CanLink, HasNothingWhenNothingCame) {
  Pair pair;
  FrameBatch batch;
  EXPECT_TRUE(pair.link->receive(kWindow, batch));
  EXPECT_TRUE(batch.empty());
}

TEST(CanLink, GivesAtMostABatchAndKeepsTheRestInOrder) {
  Pair pair;
  for (std::uint32_t i = 0; i < 70; ++i) pair.put(make_frame(i));
  FrameBatch batch;
  ASSERT_TRUE(pair.link->receive(kWindow, batch));
  ASSERT_EQ(batch.size(), 64U);
  EXPECT_EQ(batch[63].frame.id, 63U);
  ASSERT_TRUE(pair.link->receive(kWindow, batch));
  ASSERT_EQ(batch.size(), 6U);
  EXPECT_EQ(batch[0].frame.id, 64U);
  EXPECT_EQ(batch[0].received, kNow) << "without a kernel stamp the drain's time counts";
}

TEST(CanLink, DropsAndCountsWhatTheOtherEndDoesNotTake) {
  Pair pair;
  const std::vector<CanFrame> frames(64, make_frame(7));
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(pair.link->send(frames));
  const auto& counters = pair.link->counters();
  EXPECT_GT(counters.send_refused, 0U);
  EXPECT_EQ(counters.sent + counters.send_refused, 6400U);
}

TEST(OpenCan, NamesWhatIsMissing) {
  const auto absent = open_can({.interface = "nocan7"});
  EXPECT_EQ(absent.link, nullptr);
  EXPECT_NE(absent.problem.find("nocan7"), std::string::npos) << absent.problem;
  const auto socket = open_can({.interface = "unix:/nowhere/can.sock"});
  EXPECT_EQ(socket.link, nullptr);
  EXPECT_NE(socket.problem.find("/nowhere/can.sock"), std::string::npos) << socket.problem;
}

}  // namespace
}  // namespace drover::link
