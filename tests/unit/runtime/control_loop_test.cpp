#include "runtime/control_loop.h"

#include <gtest/gtest.h>

#include <thread>

#include "config/load.h"
#include "runtime/clock.h"
#include "support/allocation_counter.h"
#include "support/small_robot.h"
#include "support/temp_folder.h"
#include "support/terminal_touches.h"
#include "support/wires.h"

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;

std::string replaced(std::string text, const std::string& was, const std::string& is) {
  return text.replace(text.find(was), was.size(), is);
}

/// The loop and the thread that opens its links, with wires that a test holds.
class ControlLoopTest : public testing::Test {
 protected:
  ~ControlLoopTest() override {
    stop_ = true;
    keeper_.wake();
    control_thread_.join();
    serial_thread_.join();
    keeper_thread_.join();
  }
  std::string configuration() const {
    const auto& folder = folder_.path();
    auto text = replaced(test::kSmallRobot, R"("can": "can0")",
                         R"("can": "unix:)" + folder + R"(/can0.sock")");
    text = replaced(text, "/dev/drover/gnss", receiver_.path());
    text = replaced(text, "/dev/drover/imu", folder + "/no_imu");
    return replaced(text, R"("mqtt")",
                    R"("guard": {"socket": ")" + folder + R"(/no_guard"}, "mqtt")");
  }
  template <class Done>
  bool wait_until(Done done) {
    for (int i = 0; i < 2000; ++i) {
      if (done()) return true;
      std::this_thread::sleep_for(5ms);
    }
    return false;
  }
  std::uint64_t cycles() const { return exchange_.beats.load(); }
  void wait_for_cycles(std::uint64_t count) {
    const auto end = cycles() + count;
    ASSERT_TRUE(wait_until([&] { return cycles() >= end; }));
  }

  test::TempFolder folder_;
  test::Bus bus_{folder_.path() + "/can0.sock"};
  test::Tty receiver_;
  config::Loaded loaded_ = config::load_text(configuration(), DROVER_SOURCE_DIR "/config/maps");
  Gateway gateway_{loaded_.config};
  GuardMemory guard_;
  LinkKeeper keeper_{loaded_.config, gateway_.wiring(), guard_, gateway_.duties()};
  std::unique_ptr<ControlExchange> exchange_owner_ = std::make_unique<ControlExchange>();
  ControlExchange& exchange_ = *exchange_owner_;
  std::unique_ptr<StorageExchange> storage_ = std::make_unique<StorageExchange>();
  std::vector<std::string> report_;
  RobotMemory memory_{folder_.path(), "a boot", loaded_.text, report_};
  SerialLoop serial_{gateway_.wiring()};
  ControlLoop control_{loaded_.config,      gateway_, keeper_, serial_, guard_, exchange_,
                       {memory_, *storage_}};
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> allocations_{0};
  std::atomic<std::uint64_t> touches_{0};
  SceneSight scene_;
  bool has_scene_ = (exchange_.scene = &scene_) != nullptr;  // before the thread begins
  std::thread keeper_thread_{[this] { keeper_.run(stop_); }};
  std::thread serial_thread_{[this] { serial_.run(stop_); }};
  std::thread control_thread_{[this] {
    const test::AllocationCounter counter;
    const test::TerminalTouches touches;
    control_.run(stop_);
    allocations_ = counter.count();
    touches_ = touches.count();
  }};
};

TEST_F(ControlLoopTest, AllocatesNothingWhateverComes) {
  ASSERT_TRUE(wait_until([this] { return bus_.connected(); }));
  CanFrame heartbeat;
  heartbeat.id = 0x21;
  heartbeat.len = 8;
  const std::string position =
      "$GNGGA,120000.00,2308.97914,N,11301.17998,E,4,20,0.6,20.0,M,0,M,1,1*";
  for (int i = 0; i < 50; ++i) {
    bus_.put(heartbeat);
    heartbeat.id ^= 0x40;  // the other drive, and the first again
    receiver_.say(position + "00\r\nnoise\xFF\n");
    const RequestId id{RequestId::Source::mqtt, static_cast<std::uint64_t>(i + 1)};
    (void)exchange_.commands.push(QueuedCommand{{id, monotonic_now(), ResetStop{}}, {}});
    (void)exchange_.commands.push(QueuedCommand{{id, monotonic_now(), ProposeOrigin{}}, {}});
    if (i % 10 == 0) exchange_.stops.ask_stop();
    if (i % 10 == 5) exchange_.stops.ask_cancel();
    scene_.clearance.back() = {static_cast<std::uint64_t>(i + 1), {}};
    scene_.clearance.back().clearance.t = monotonic_now();
    scene_.clearance.publish();
    wait_for_cycles(1);
  }
  EXPECT_GT(bus_.take(), 0) << "it asks the drives";
  // A bus that is lost and comes back is given away and taken without a new object.
  bus_.hang_up();
  ASSERT_TRUE(wait_until([this] { return bus_.connected(); }));
  wait_for_cycles(20);
  Event event;
  int events = 0;
  while (exchange_.events.pop(event)) ++events;
  EXPECT_GT(events, 0);
  stop_ = true;
  keeper_.wake();
  control_thread_.join();
  EXPECT_EQ(allocations_, 0U);
  control_thread_ = std::thread([] {});
}

/// In the kernel that would wait for a worker, which may wait for others.
TEST_F(ControlLoopTest, AsksNoTerminal) {
  const auto received = [this] {
    for (const auto& link : exchange_.snapshot.latest().links)
      if (link.name.view() == "gnss") return link.received;
    return std::uint64_t{0};
  };
  const test::TerminalTouches own;
  std::array<std::uint8_t, 1> byte{};
  std::size_t size = 0;
  (void)link::read_serial(receiver_.fd(), byte, size);
  EXPECT_EQ(own.count(), 1U) << "nothing is counted";
  EXPECT_TRUE(wait_until([&] {
    receiver_.say("$GNGGA,noise\r\n");
    return received() > 100;
  }));
  receiver_.hang_up();
  wait_for_cycles(20);
  stop_ = true;
  keeper_.wake();
  control_thread_.join();
  EXPECT_EQ(touches_, 0U);
  control_thread_ = std::thread([] {});
}

TEST_F(ControlLoopTest, ShowsTheSceneInEachCycleWhereTheRobotIs) {
  ASSERT_TRUE(wait_until([this] { return scene_.viewpoint.latest().t != kNever; }));
  const Time before = scene_.viewpoint.latest().t;
  EXPECT_TRUE(wait_until([&] { return scene_.viewpoint.latest().t > before; }));
}

}  // namespace
}  // namespace drover::runtime
