// The control loop of each robot of the simulator, over sockets and terminals: it allocates
// nothing.
#include <gtest/gtest.h>

#include <random>
#include <regex>
#include <thread>

#include "config/load.h"
#include "runtime/clock.h"
#include "runtime/control_loop.h"
#include "support/allocation_counter.h"
#include "support/simulated_robots.h"
#include "support/temp_folder.h"
#include "support/wires.h"

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;

/// The wires of a robot: its configuration with their near ends in place of its own.
struct Wires {
  explicit Wires(const std::string& robot) {
    std::ifstream in(test::robot_file(robot, ".drover.json"));
    std::stringstream all;
    all << in.rdbuf();
    text = all.str();
    const auto replace = [this](const char* pattern, const auto& with) {
      std::smatch found;
      std::string done;
      for (; std::regex_search(text, found, std::regex(pattern)); text = found.suffix())
        done += found.prefix().str() + with(found[1].str());
      text = done + text;
    };
    replace(R"re("can": "(\w+)")re", [this](const std::string& name) {
      buses.push_back(std::make_unique<test::Bus>(folder.path() + "/" + name));
      return R"("can": "unix:)" + folder.path() + "/" + name + '"';
    });
    replace(R"re("serial": "([^"]+)")re", [this](const std::string&) {
      lines.push_back(std::make_unique<test::Tty>());
      return R"("serial": ")" + lines.back()->path() + '"';
    });
    replace(R"re("socket": "([^"]+)")re",
            [this](const std::string&) { return R"("socket": ")" + folder.path() + "/none\""; });
  }
  bool connected() {
    bool all = true;
    for (auto& bus : buses) all = bus->connected() && all;
    return all;
  }
  test::TempFolder folder;
  std::vector<std::unique_ptr<test::Bus>> buses;
  std::vector<std::unique_ptr<test::Tty>> lines;
  std::string text;
};

class TheControlLoopOf : public testing::TestWithParam<std::string> {};

TEST_P(TheControlLoopOf, AllocatesNothingWhateverItsWiresSay) {
  Wires wires(GetParam());
  const auto loaded = config::load_text(wires.text, DROVER_SOURCE_DIR "/config/maps");
  ASSERT_TRUE(loaded.problems.empty()) << loaded.problems.front().text("robot");
  Gateway gateway(loaded.config);
  const GuardMemory guard;
  LinkKeeper keeper(loaded.config, gateway.wiring(), guard, gateway.duties());
  const auto exchange = std::make_unique<ControlExchange>();
  const auto storage = std::make_unique<StorageExchange>();
  std::vector<std::string> report;
  RobotMemory memory(wires.folder.path(), "a boot", loaded.text, report);
  SerialLoop serial(gateway.wiring());
  ControlLoop control(loaded.config, gateway, keeper, serial, guard, *exchange, {memory, *storage});
  std::atomic<bool> stop{false};
  std::uint64_t allocations = 1;
  std::thread keeps([&] { keeper.run(stop); });
  std::thread hears([&] { serial.run(stop); });
  std::thread controls([&] {
    const test::AllocationCounter counter;
    control.run(stop);
    allocations = counter.count();
  });

  std::minstd_rand random{1};
  const auto any = [&random] { return static_cast<std::uint32_t>(random()); };
  bool connected = false;
  for (int i = 0; i < 2000 && !connected; ++i, std::this_thread::sleep_for(5ms))
    connected = wires.connected();
  for (int i = 0; connected && i < 60; ++i) {
    for (const auto& slot : gateway.wiring().slots) {
      if (slot.made.frames == nullptr) continue;
      for (const FrameFilter& filter : slot.made.frames->listens()) {
        CanFrame frame;
        frame.extended = filter.extended;
        frame.id = filter.id;
        frame.len = 8;
        for (auto& byte : frame.data) byte = static_cast<std::uint8_t>(any() % 3 == 0 ? any() : 0);
        wires.buses.at(slot.link)->put(frame);
      }
    }
    std::string noise(64, '\0');
    for (auto& c : noise) c = static_cast<char>(any());
    for (const auto& line : wires.lines) line->say(noise);
    const RequestId id{RequestId::Source::cli, static_cast<std::uint64_t>(i + 1)};
    (void)exchange->commands.push(QueuedCommand{{id, monotonic_now(), ResetStop{}}, {}});
    (void)exchange->commands.push(QueuedCommand{{id, monotonic_now(), ArmHold{}}, {}});
    if (i % 10 == 0) exchange->stops.ask_stop();
    std::this_thread::sleep_for(5ms);
    for (const auto& bus : wires.buses) (void)bus->take();
  }
  stop = true;
  keeper.wake();
  controls.join();
  hears.join();
  keeps.join();
  EXPECT_TRUE(connected) << "its buses are not opened";
  EXPECT_EQ(allocations, 0U);
}
INSTANTIATE_TEST_SUITE_P(OfTheSimulator, TheControlLoopOf,
                         testing::ValuesIn(test::simulated_robots()),
                         [](const auto& robot) { return robot.param; });

}  // namespace
}  // namespace drover::runtime
