// The robot's ends of the wires, on loopback: files, a fake chip, a pseudo-terminal, socket buses.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "link/can_open.h"
#include "link/serial_link.h"
#include "sim/robot/can_port.h"
#include "sim/robot/line_port.h"
#include "sim/robot/log.h"
#include "sim/robot/output_log.h"
#include "sim/robot/serial_port.h"

namespace drover::sim {
namespace {

namespace fs = std::filesystem;

class Ports : public testing::Test {
 protected:
  Ports() {
    std::string pattern = (fs::temp_directory_path() / "drover-ports-XXXXXX").string();
    folder = ::mkdtemp(pattern.data());
  }
  ~Ports() override { fs::remove_all(folder); }
  static std::string read(const fs::path& path) {
    std::ifstream stream(path);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }
  static void write(const fs::path& path, const std::string& text) {
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  GpioSimChip chip() const { return GpioSimChip({(folder / "config").string(), folder.string()}); }
  std::unique_ptr<link::CanLink> connect() {
    auto opened = link::open_can({"unix:" + (folder / "can0.sock").string(), 64, false});
    EXPECT_TRUE(opened.link) << opened.problem;
    return std::move(opened.link);
  }
  std::unique_ptr<link::SerialLink> open_line(const char* name, int baud) {
    auto opened = link::open_serial({(folder / name).string(), baud});
    EXPECT_TRUE(opened.link) << opened.problem;
    return std::move(opened.link);
  }
  static std::string received(link::SerialLink& line) {
    std::array<std::uint8_t, 64> bytes{};
    std::size_t size = 0;
    EXPECT_TRUE(line.read(bytes, size));
    return {bytes.begin(), bytes.begin() + static_cast<long>(size)};
  }
  fs::path folder;
  Scenario scenario;
  link::StampWindow window{Time{}, Time{std::chrono::seconds(1)}, {}};
};

TEST_F(Ports, RefuseAChipThatIsNotThere) {
  EXPECT_THROW(GpioSimChip({(folder / "none").string(), folder.string()}), std::runtime_error);
}

TEST_F(Ports, RefuseAChipThatLacksALine) {
  write(folder / "config/robot/dev_name", "gpio-sim.0\n");
  write(folder / "config/robot/bank0/label", "drover-sim\n");
  write(folder / "config/robot/bank0/chip_name", "gpiochip3\n");
  EXPECT_THROW(LinePort::gpio_sim(scenario, chip()), std::runtime_error);
}

TEST_F(Ports, PullTheLinesOfTheChipWithTheLabel) {
  const fs::path bank = folder / "config/robot/bank0";
  write(folder / "config/other/bank0/label", "something else\n");
  write(folder / "config/robot/dev_name", "gpio-sim.0\n");
  write(bank / "label", "drover-sim\n");
  write(bank / "chip_name", "gpiochip3\n");
  for (std::size_t i = 0; i < kLineNames; ++i) {
    write(bank / ("line" + std::to_string(i + 2)) / "name", std::string(kLineText[i]) + "\n");
    write(folder / "gpio-sim.0/gpiochip3" / ("sim_gpio" + std::to_string(i + 2)) / "pull", "");
  }
  auto port = LinePort::gpio_sim(scenario, chip());
  port.set(LineName::zone_far, true);
  EXPECT_EQ(read(folder / "gpio-sim.0/gpiochip3/sim_gpio4/pull"), "pull-up");
  EXPECT_EQ(read(folder / "gpio-sim.0/gpiochip3/sim_gpio2/pull"), "");
}

TEST_F(Ports, RecordEachChangeOfAnOutputAndThatItsChipIsGone) {
  const fs::path bank = folder / "config/robot/bank0";
  const fs::path lines = folder / "gpio-sim.0/gpiochip3";
  write(folder / "config/robot/dev_name", "gpio-sim.0\n");
  write(bank / "label", "drover-sim\n");
  write(bank / "chip_name", "gpiochip3\n");
  for (std::size_t i = 0; i < kOutputText.size(); ++i) {
    write(bank / ("line" + std::to_string(i)) / "name", std::string(kOutputText[i]) + "\n");
    write(lines / ("sim_gpio" + std::to_string(i)) / "value", "0\n");
  }
  {
    OutputLog log((folder / "lines.log").string(), chip());
    log.sample(Time{std::chrono::milliseconds(1005)});
    write(lines / "sim_gpio1/value", "1\n");
    log.sample(Time{std::chrono::milliseconds(1010)});
    log.sample(Time{std::chrono::milliseconds(1015)});
    write(lines / "sim_gpio1/value", "");  // as a chip that is gone, nothing can be read
    log.sample(Time{std::chrono::milliseconds(1020)});
  }
  EXPECT_EQ(read(folder / "lines.log"),
            "(1.005000000) enable_relay 0\n(1.005000000) lamp 0\n(1.005000000) buzzer 0\n"
            "(1.005000000) watchdog 0\n(1.010000000) lamp 1\n(1.020000000) lamp -\n");
}

TEST_F(Ports, RewriteALinesFileInPlace) {
  scenario.lines[1].wired = false;
  auto port = LinePort::files(scenario, (folder / "lines").string());
  port.set(LineName::estop, true);
  port.set(LineName::bumper, true);
  EXPECT_EQ(read(folder / "lines/estop"), "1");
  port.set(LineName::estop, false);
  EXPECT_EQ(read(folder / "lines/estop"), "0");
  EXPECT_FALSE(fs::exists(folder / "lines/bumper"));
}

TEST_F(Ports, CarryFramesBetweenTheRobotAndEveryClientOfASocketBus) {
  auto bus = make_unix_port((folder / "can0.sock").string());
  auto daemon = connect();
  auto guard = connect();
  std::vector<link::ReceivedFrame> received;
  bus->receive(window, received);  // accepts
  ASSERT_TRUE(daemon->send(std::array{make_frame(0x0D, {1, 2})}));
  bus->receive(window, received);
  ASSERT_EQ(received.size(), 1U);
  EXPECT_EQ(received[0].frame, make_frame(0x0D, {1, 2}));
  EXPECT_EQ(received[0].received, window.now);
  bus->send(std::array{make_frame(0x09, {3})});

  link::FrameBatch heard;
  ASSERT_TRUE(guard->receive(window, heard));
  ASSERT_EQ(heard.size(), 2U);
  EXPECT_EQ(heard[0].frame, make_frame(0x0D, {1, 2}));
  EXPECT_EQ(heard[1].frame, make_frame(0x09, {3}));
  ASSERT_TRUE(daemon->receive(window, heard));
  ASSERT_EQ(heard.size(), 1U);  // not its own
}

TEST_F(Ports, LetAClientOfASocketBusLeaveAndComeBack) {
  auto bus = make_unix_port((folder / "can0.sock").string());
  std::vector<link::ReceivedFrame> received;
  connect().reset();
  bus->receive(window, received);
  bus->receive(window, received);
  auto again = connect();
  bus->receive(window, received);
  bus->send(std::array{make_frame(7)});
  link::FrameBatch heard;
  ASSERT_TRUE(again->receive(window, heard));
  EXPECT_EQ(heard.size(), 1U);
}

TEST_F(Ports, WaitForAnInterfaceThatIsNotThere) {
  auto bus = make_socketcan_port("nocan7");
  std::vector<link::ReceivedFrame> received;
  bus->receive(window, received);
  bus->send(std::array{make_frame(7)});
  EXPECT_TRUE(received.empty());
  EXPECT_EQ(bus->dropped(), 1U);
}

TEST_F(Ports, LoseAReceiversBytesWhileNobodyListens) {
  SerialPort port((folder / "gnss").string(), 115200);
  for (int i = 0; i < 100; ++i) port.pump(i == 0 ? "$OLD\r\n" : "", std::chrono::milliseconds(5));
  const auto reader = open_line("gnss", 115200);
  ASSERT_TRUE(reader);
  for (int i = 0; i < 100; ++i) port.pump(i == 0 ? "$NEW\r\n" : "", std::chrono::milliseconds(5));
  EXPECT_EQ(received(*reader), "$NEW\r\n");
}

TEST_F(Ports, CarryWhatIsWrittenToADeviceEvenWhileItIsSilent) {
  SerialPort port((folder / "imu").string(), 115200);
  const auto host = open_line("imu", 115200);
  ASSERT_TRUE(host);
  const std::array<std::uint8_t, 5> command{0xFF, 0xAA, 0x69, 0x88, 0xB5};
  std::size_t taken = 0;
  ASSERT_TRUE(host->write(command, taken));
  ASSERT_EQ(taken, command.size());
  std::vector<std::uint8_t> heard;
  for (int i = 0; i < 4; ++i) {
    port.pump("", kTick);
    heard.insert(heard.end(), port.heard().begin(), port.heard().end());
  }
  EXPECT_EQ(heard, std::vector<std::uint8_t>(command.begin(), command.end()));
}

TEST_F(Ports, TurnEverythingIntoNoiseWhenTheSpeedsDiffer) {
  SerialPort port((folder / "imu").string(), 9600);
  const auto host = open_line("imu", 115200);
  ASSERT_TRUE(host);
  std::size_t taken = 0;
  ASSERT_TRUE(host->write(std::array<std::uint8_t, 5>{0xFF, 0xAA, 0x69, 0x88, 0xB5}, taken));
  for (int i = 0; i < 20; ++i) {
    port.pump(i == 0 ? "spoken words" : "", kTick);
    if (i == 0) {
      EXPECT_EQ(port.heard().size(), 5U);
      EXPECT_NE(port.heard()[1], 0xAA);
    }
  }
  const auto heard = received(*host);
  EXPECT_EQ(heard.size(), 12U);
  EXPECT_NE(heard, "spoken words");
  // The device changes its speed: both agree now.
  port.set_baud(115200);
  for (int i = 0; i < 4; ++i) port.pump(i == 0 ? "spoken words" : "", kTick);
  EXPECT_EQ(received(*host), "spoken words");
}

TEST_F(Ports, HangUpWhenUnpluggedAndAreThereAgainWhenPlugged) {
  SerialPort port((folder / "imu").string(), 115200);
  const auto host = open_line("imu", 115200);
  ASSERT_TRUE(host);
  port.unplug();
  port.pump("lost", kTick);
  EXPECT_FALSE(fs::is_symlink(folder / "imu"));
  std::array<std::uint8_t, 8> bytes{};
  std::size_t size = 0;
  EXPECT_FALSE(host->read(bytes, size));
  port.plug();
  const auto again = open_line("imu", 115200);
  ASSERT_TRUE(again);
  for (int i = 0; i < 4; ++i) port.pump(i == 0 ? "new" : "", kTick);
  EXPECT_EQ(received(*again), "new");
}

TEST_F(Ports, RemoveTheReceiversLinkAtTheEnd) {
  { const SerialPort port((folder / "gnss").string(), 9600); }
  EXPECT_FALSE(fs::is_symlink(folder / "gnss"));
}

TEST_F(Ports, RefuseADeviceOnUsbThatIsNoneOrWhoseIdsAreIncomplete) {
  for (const char* path : {"usb:", "usb:1546"})
    EXPECT_THROW(SerialPort(path, 9600), std::runtime_error);
}

TEST_F(Ports, HearWhatACommandedDeviceIsToldAtEachTickNoFasterThanItsLine) {
  SerialPort port((folder / "base").string(), 9600);
  auto line = open_line("base", 9600);
  ASSERT_TRUE(line);
  const std::array<std::uint8_t, 24> told{};  // 25 ms of this line
  std::size_t taken = 0;
  ASSERT_TRUE(line->write(told, taken));
  std::size_t heard = 0;
  for (int i = 0; i < 4; ++i) {
    port.listen(kTick);
    EXPECT_LE(port.heard().size(), 5U);
    heard += port.heard().size();
    port.pump(i == 0 ? "ok" : "", kTick);
  }
  EXPECT_EQ(heard, 19U);
  port.listen(kTick);
  EXPECT_EQ(heard + port.heard().size(), told.size());
  EXPECT_EQ(received(*line), "ok");
}

TEST(BaudPacer, LetsBytesGoAtTheLinesPace) {
  BaudPacer pacer(115200);
  std::size_t waiting = 388;
  int ticks = 0;
  for (; waiting > 0; ++ticks) waiting -= pacer.take(waiting, std::chrono::milliseconds(5));
  EXPECT_EQ(ticks, 7);  // 33.7 ms
}

TEST(BaudPacer, CarriesFractionsOver) {
  BaudPacer pacer(4800);  // 2.4 bytes in 5 ms
  std::size_t sent = 0;
  for (int i = 0; i < 10; ++i) sent += pacer.take(1000, std::chrono::milliseconds(5));
  EXPECT_EQ(sent, 24U);
}

TEST(BaudPacer, SavesNothingUpWhileTheLineIsIdle) {
  BaudPacer pacer(115200);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(pacer.take(0, std::chrono::milliseconds(5)), 0U);
  EXPECT_EQ(pacer.take(1000, std::chrono::milliseconds(5)), 57U);
}

TEST(CandumpLine, LooksLikeCandumpsLog) {
  const Time time{Duration{12'003'000'004}};
  std::string line;
  append_candump(line, time, "can0", make_frame(0x0D, {0, 0xAB}));
  EXPECT_EQ(line, "(12.003000004) can0 00D#00AB\n");
  line.clear();
  CanFrame frame = make_frame(0x1ABCDEF0, {1});
  frame.extended = true;
  append_candump(line, time, "can1", frame);
  EXPECT_EQ(line, "(12.003000004) can1 1ABCDEF0#01\n");
  line.clear();
  frame = make_frame(0x69);
  frame.remote = true;
  append_candump(line, time, "can0", frame);
  EXPECT_EQ(line, "(12.003000004) can0 069#R\n");
  line.clear();
  frame = make_frame(0x69, {5});
  frame.fd = true;
  append_candump(line, time, "can0", frame);
  EXPECT_EQ(line, "(12.003000004) can0 069##005\n");
}

}  // namespace
}  // namespace drover::sim
