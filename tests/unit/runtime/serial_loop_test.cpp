#include "runtime/serial_loop.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "link/serial_link.h"
#include "runtime/clock.h"
#include "support/wires.h"

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;

TEST(FirstByte, CameInBeforeTheLastOneByWhatTheWireTakes) {
  const Time now{100s};
  EXPECT_EQ(first_came_in(now, 1, 100us), now);
  EXPECT_EQ(first_came_in(now, 21, 100us), now - 2ms);
  EXPECT_EQ(first_came_in(now, 0, 100us), now) << "the line is dead";
}

class SerialLoopTest : public testing::Test {
 protected:
  SerialLoopTest() {
    wiring_.links.resize(2);
    wiring_.links[0].wire = Wire::can;
    wiring_.links[1].wire = Wire::bytes;
    loop_.emplace(wiring_);
    thread_ = std::thread([this] { loop_->run(stop_); });
    open_ = link::open_serial({device_.path(), 115200}).link;
  }
  ~SerialLoopTest() override { end(); }
  void end() {
    stop_ = true;
    loop_->wake();
    if (thread_.joinable()) thread_.join();
  }
  static constexpr std::size_t kLink = 1;

  template <class Done>
  static bool wait_until(Done done) {
    for (int i = 0; i < 2000; ++i) {
      if (done()) return true;
      std::this_thread::sleep_for(5ms);
    }
    return false;
  }
  void listen() { loop_->listen(kLink, open_->fd(), 115200); }
  bool leaves() {
    return wait_until([this] { return loop_->leave(kLink); });
  }
  /// What is heard until it is `size` bytes, or the line's error.
  std::string hear(std::size_t size) {
    std::string all;
    wait_until([&] {
      while (loop_->take(kLink, heard_)) {
        const auto bytes = heard_.view();
        all.append(bytes.begin(), bytes.end());
      }
      return all.size() >= size || heard_.error != 0;
    });
    return all;
  }
  bool told_ready() const {
    pollfd fd{loop_->ready_fd(), POLLIN, 0};
    return ::poll(&fd, 1, 10000) == 1;
  }

  gateway::Wiring wiring_;
  std::optional<SerialLoop> loop_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
  test::Tty device_;
  std::unique_ptr<link::SerialLink> open_;
  HeardBytes heard_;
};

TEST_F(SerialLoopTest, TellsWhatCameAndWhen) {
  listen();
  const Time before = monotonic_now();
  device_.say("$GNGGA,");
  EXPECT_TRUE(told_ready());
  EXPECT_EQ(hear(7), "$GNGGA,");
  EXPECT_EQ(heard_.error, 0);
  EXPECT_GT(heard_.first, before - 100ms);
  EXPECT_LE(heard_.first, monotonic_now());
  loop_->clear_ready();
  device_.say("once more");
  EXPECT_TRUE(told_ready());
  EXPECT_EQ(hear(9), "once more");
}

TEST_F(SerialLoopTest, TellsThatALineHungUpAfterItsLastWords) {
  listen();
  device_.say("the last words");
  EXPECT_EQ(hear(14), "the last words");
  device_.hang_up();
  EXPECT_EQ(hear(1), "");
  EXPECT_EQ(heard_.error, EIO);
  const auto turns = loop_->turns().load();
  std::this_thread::sleep_for(100ms);
  EXPECT_LT(loop_->turns() - turns, 100U) << "it spins about the dead line";
  EXPECT_TRUE(leaves());
}

TEST_F(SerialLoopTest, ReadsNothingOfALineThatItLeft) {
  listen();
  device_.say("x");
  EXPECT_EQ(hear(1), "x");
  EXPECT_TRUE(leaves());
  device_.say("for somebody else");
  std::array<std::uint8_t, 64> buffer{};
  std::size_t size = 0;
  EXPECT_TRUE(wait_until([&] { return open_->read(buffer, size) && size > 0; }));
  EXPECT_EQ(size, 17U);
}

TEST_F(SerialLoopTest, ForgetsWhatAnEarlierOpeningSaid) {
  listen();
  device_.say("of before");
  EXPECT_TRUE(told_ready());
  EXPECT_TRUE(leaves());
  listen();
  device_.say("new");
  EXPECT_EQ(hear(3), "new");
}

TEST_F(SerialLoopTest, LosesNothingWhileNobodyTakes) {
  listen();
  std::string said;
  for (int i = 0; i < 40; ++i) {
    const std::string line = "line " + std::to_string(i) + "\n";
    device_.say(line);
    said += line;
    std::this_thread::sleep_for(2ms);  // each its own read: more than there is room for
  }
  EXPECT_EQ(hear(said.size()), said);
}

TEST_F(SerialLoopTest, GoesOnAndTellsOfTheRestWhenThereIsRoomAgain) {
  listen();
  for (std::size_t i = 0; i < SerialLoop::kRoom; ++i) {
    device_.say("x");
    ASSERT_TRUE(told_ready());
    loop_->clear_ready();
  }
  device_.say("y");
  std::this_thread::sleep_for(100ms);  // it is read, and there is no room for it
  for (std::size_t i = 0; i < SerialLoop::kRoom; ++i) ASSERT_TRUE(loop_->take(kLink, heard_));
  const auto is_ready = [this] {
    pollfd fd{loop_->ready_fd(), POLLIN, 0};
    return ::poll(&fd, 1, 0) == 1;
  };
  loop_->clear_ready();
  loop_->go_on();
  EXPECT_TRUE(is_ready());
  EXPECT_EQ(hear(1), "y");
}

TEST_F(SerialLoopTest, LivesWithoutALineAndTouchesNoneOnceItEnded) {
  const auto turns = loop_->turns().load();
  EXPECT_TRUE(wait_until([&] { return loop_->turns() > turns + 2; }));
  listen();
  end();
  EXPECT_TRUE(loop_->leave(kLink));
}

}  // namespace
}  // namespace drover::runtime
