// The real droverd and the real drover-guard with a chassis on a pseudo-terminal: one open file
// for both, which outlives each of them, and which both let go of when the line is pulled.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <stdlib.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <optional>
#include <thread>

#include "drivers/gt01/serial/codec.h"
#include "drover/registry.h"
#include "integration/guard_rig.h"
#include "integration/process.h"
#include "runtime/clock.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;

/// What a chassis hears: motions by their sequence numbers.
struct Heard {
  std::chrono::steady_clock::time_point at;
  std::uint16_t sequence = 0;
  Twist twist;
};

class ChassisOnATty : public GuardRig {
 protected:
  ChassisOnATty() {
    const auto* entry = find_driver("gt01_serial");
    std::vector<OptionSpec> table(entry->options.begin(), entry->options.end());
    table.insert(table.end(), entry->twin_options.begin(), entry->twin_options.end());
    twin_ = std::get<MakeByteDriveTwin>(entry->make_twin)(Options(table));
    twin_->set_power(true, runtime::monotonic_now());
    std::filesystem::create_directory(file("lines"));
    write("lines/estop", "1\n");
    write("drover.json", R"({
      "paths": {"state": ")" +
                             file("state") + R"(", "run": ")" + file("run") + R"("},
      "links": {"chassis": {"serial": ")" +
                             file("tty") + R"("},
                "panel": {"gpio": "files:)" +
                             file("lines") + R"("}},
      "devices": {
        "chassis": {"driver": "gt01_serial", "link": "chassis", "accept": ["no_watchdog"]},
        "estop": {"driver": "gpio_line", "link": "panel", "line": "estop", "is": "estop"}},
      "groups": {"base": {"kind": "twist", "device": "chassis", "track_m": 0.6, "hold": "brake"}},
      "guard": {"socket": ")" +
                             file("guard.sock") + R"("},
      "control": {"realtime": false},
      "mqtt": {"enabled": false}})");
    std::filesystem::create_directory(file("state"));
    std::filesystem::create_directory(file("run"));
    plug();
    start();
  }
  ~ChassisOnATty() override {
    daemon.signal(SIGKILL);
    static_cast<void>(daemon.wait(5s));
    if (HasFailure()) std::fprintf(stderr, "---- droverd\n%s", said().c_str());
  }

  void write(const char* name, const std::string& text) const { std::ofstream(file(name)) << text; }
  /// Another device under the same name.
  void plug() {
    device_ = link::UniqueFd(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    ::grantpt(device_.get());
    ::unlockpt(device_.get());
    std::filesystem::remove(file("tty"));
    std::filesystem::create_symlink(::ptsname(device_.get()), file("tty"));
    bytes_.clear();
  }
  void unplug() {
    std::filesystem::remove(file("tty"));
    device_.reset();
  }
  /// A master sees EIO when nobody has the other side open.
  bool is_open() const {
    char byte = 0;
    while (::read(device_.get(), &byte, 1) > 0) {
    }
    return errno != EIO;
  }
  void start_daemon() {
    daemon = Process({DROVERD_PROGRAM, "--config", file("drover.json")}, file("droverd.log"));
  }
  std::string said() const { return daemon.output(); }

  /// The chassis lives for a moment: tells of itself and hears.
  void live() {
    std::array<char, 512> out{};
    const auto size = twin_->on_tick(runtime::monotonic_now(), shafts_, out);
    if (device_) static_cast<void>(::write(device_.get(), out.data(), size) < 0);
    std::array<std::uint8_t, 4096> in{};
    const auto n = device_ ? ::read(device_.get(), in.data(), in.size()) : 0;
    if (n > 0) bytes_.insert(bytes_.end(), in.begin(), in.begin() + n);
    hear();
    std::this_thread::sleep_for(2ms);
  }
  bool live_until(const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + 20s;
    while (std::chrono::steady_clock::now() < end) {
      live();
      if (done()) return true;
    }
    return false;
  }
  void live_for(std::chrono::milliseconds time) {
    const auto end = std::chrono::steady_clock::now() + time;
    while (std::chrono::steady_clock::now() < end) live();
  }
  bool hears_something() {
    heard.clear();
    return live_until([this] { return heard.size() > 3; });
  }
  bool guard_says(const char* what) const {
    return at_stop_socket("state").find(what) != std::string::npos;
  }
  bool live_until_guard_says(const char* what) {
    return live_until([&] { return guard_says(what); });
  }
  /// It watches the chassis, and droverd has the line.
  bool is_equipped() {
    return live_until([this] {
      return guard_says(R"("axes":1)") && guard_says(R"("holds":false)") &&
             guard_says(R"("droverd":"alive")") && guard_says(R"("set_refused":false)");
    });
  }

  /// The command line's exit status; the chassis lives meanwhile.
  int drover(const std::vector<std::string>& words) {
    std::vector<std::string> all{DROVER_PROGRAM, "--socket", file("run/drover.sock")};
    all.insert(all.end(), words.begin(), words.end());
    Process process(all, file("drover.log"));
    std::optional<int> code;
    static_cast<void>(live_until([&] {
      code = process.wait(0s);
      return code.has_value();
    }));
    drover_said = process.output();
    return code.value_or(-1);
  }

  Process daemon;
  std::vector<Heard> heard;
  std::string drover_said;

 private:
  void hear() {
    namespace codec = gt01::serial;
    while (bytes_.size() >= codec::kBeforeData) {
      const auto size = codec::packet_size(bytes_);
      const auto asked = size > 0 && size <= bytes_.size()
                             ? codec::asked_twist({bytes_.data(), size})
                             : std::nullopt;
      if (size > bytes_.size()) return;
      if (asked) {
        const auto sequence = static_cast<std::uint16_t>(bytes_[2] | (bytes_[3] << 8U));
        heard.push_back({std::chrono::steady_clock::now(), sequence, *asked});
      }
      bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(asked ? size : 1));
    }
  }

  link::UniqueFd device_;
  std::unique_ptr<ByteDriveTwin> twin_;
  std::array<Shaft, 2> shafts_{};
  std::vector<std::uint8_t> bytes_;
};

TEST_F(ChassisOnATty, HearsTheGuardsPacketsWhenDroverdIsKilledAndDroverdsAfterItsRestart) {
  start_daemon();
  ASSERT_TRUE(is_equipped()) << said();
  ASSERT_TRUE(hears_something());
  EXPECT_THAT(said(), HasSubstr("drover-guard watches the drives (chassis)"));

  live_for(200ms);
  heard.clear();
  const auto killed = std::chrono::steady_clock::now();
  daemon.signal(SIGKILL);
  ASSERT_EQ(daemon.wait(5s), 128 + SIGKILL);
  ASSERT_TRUE(live_until_guard_says(R"("holds":true)"));
  live_for(300ms);
  // The recipe's sequence numbers begin at 0 and go up to 15, then at 0 again.
  const auto first = std::find_if(heard.begin(), heard.end(), [&](const Heard& each) {
    return each.at > killed && each.sequence == 0;
  });
  ASSERT_NE(first, heard.end());
  std::printf("the guard's first packet came %.0f ms after the kill\n",
              std::chrono::duration<double, std::milli>(first->at - killed).count());
  for (auto it = first; it + 1 != heard.end(); ++it) {
    EXPECT_EQ((it + 1)->sequence, (it->sequence + 1) % 16);
    EXPECT_EQ(it->twist.vx_mps, 0);
  }

  start_daemon();
  ASSERT_TRUE(is_equipped()) << said();
  EXPECT_THAT(said(), HasSubstr("taken back from drover-guard"));
  EXPECT_THAT(said(), Not(HasSubstr("busy")));
  EXPECT_THAT(said(), Not(HasSubstr("another program uses this line")));
  ASSERT_TRUE(hears_something());
}

TEST_F(ChassisOnATty, IsLetGoOfByBothWhenItsLineIsPulledAndOpenedAgain) {
  start_daemon();
  ASSERT_TRUE(is_equipped()) << said();
  for (int time = 0; time < 2; ++time) {
    unplug();
    ASSERT_TRUE(live_until([this] { return said().find("lost") != std::string::npos; })) << said();
    live_for(300ms);
    plug();
    ASSERT_TRUE(hears_something()) << said();
    ASSERT_TRUE(is_equipped()) << said();
  }
  // Nobody holds on to the line once both have ended.
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(10s), 0);
  ASSERT_TRUE(is_open()) << "the guard has it";
  kill();
  EXPECT_FALSE(is_open());
}

TEST_F(ChassisOnATty, IsNotSaidToStopWhileItsLineIsPulled) {
  start_daemon();
  ASSERT_TRUE(is_equipped()) << said();
  live_for(300ms);
  EXPECT_EQ(drover({"stop"}), 0) << drover_said;
  unplug();
  ASSERT_TRUE(live_until([this] { return said().find("lost") != std::string::npos; })) << said();
  live_for(500ms);
  EXPECT_EQ(drover({"stop"}), 1) << drover_said;
  EXPECT_THAT(drover_said,
              HasSubstr("but nothing is heard from the base: whether the robot stops"));
}

TEST_F(ChassisOnATty, GetsANewGuardWhenTheFirstOneDies) {
  start_daemon();
  ASSERT_TRUE(is_equipped()) << said();
  kill();
  start();
  ASSERT_TRUE(is_equipped()) << said();
  ASSERT_TRUE(hears_something());
  daemon.signal(SIGKILL);
  static_cast<void>(daemon.wait(5s));
  ASSERT_TRUE(live_until_guard_says(R"("holds":true)"));
  heard.clear();
  live_for(300ms);
  EXPECT_GT(heard.size(), 10U);
}

TEST_F(ChassisOnATty, HearsNothingOfDroverdWhileTheGuardHoldsIt) {
  start_daemon();
  ASSERT_TRUE(is_equipped()) << said();
  ASSERT_TRUE(hears_something());
  EXPECT_THAT(at_stop_socket("stop"), HasSubstr(R"("holds":true)"));
  live_for(100ms);
  heard.clear();
  live_for(500ms);
  ASSERT_GT(heard.size(), 20U);
  for (std::size_t i = 1; i < heard.size(); ++i)
    EXPECT_EQ(heard[i].sequence, (heard[i - 1].sequence + 1) % 16) << "all are the guard's";
}

}  // namespace
}  // namespace drover::test
