// The whole simulator on socket buses and files, in real time: it starts, answers, records, ends.
#include "sim/robot/simulator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "drover/registry.h"
#include "link/can_open.h"
#include "link/serial_link.h"

namespace drover::sim {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

class SimulatorTest : public testing::Test {
 protected:
  SimulatorTest() {
    std::string pattern = (fs::temp_directory_path() / "drover-sim-XXXXXX").string();
    folder = ::mkdtemp(pattern.data());
    std::ofstream(folder / "scenario.json")
        << R"({"name": "smoke", "world": ")" << DROVER_SOURCE_DIR << R"(/sim/worlds/field.xml",
      "origin": {"latitude_deg": 52, "longitude_deg": 13},
      "can": {"can0": {"kind": "vcan"}},
      "drives": [{"joint": "front_left", "driver": "odrive", "bus": "can0",
                  "options": {"node": 0}}],
      "gnss": {},
      "lidar": {"place": {"x_m": 0.4, "z_m": 0.1}},
      "imu": {"driver": "hipnuc_can", "bus": "can0"},
      "more": {"imu_rear": {"is": "imu", "driver": "hipnuc_can", "bus": "can0",
                            "options": {"node": 9}}}})";
    settings.scenario_file = (folder / "scenario.json").string();
    settings.run_folder = (folder / "run").string();
    settings.log_folder = (folder / "log").string();
    settings.can_over_unix = true;
    settings.line_files = true;
  }
  ~SimulatorTest() override { fs::remove_all(folder); }
  std::string read(const fs::path& path) const {
    std::ifstream stream(folder / path);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }
  fs::path folder;
  SimulatorSettings settings;
};

TEST_F(SimulatorTest, RefusesAScenarioThatIsNotThere) {
  settings.scenario_file = "/no/such.json";
  EXPECT_THROW(Simulator{settings}, std::runtime_error);
}

TEST_F(SimulatorTest, AnswersOnItsWiresUntilItIsToldToQuit) {
  Simulator simulator(settings);
  std::thread loop([&simulator] { simulator.run(); });
  const auto socket = settings.run_folder + "/sim.sock";
  auto can = link::open_can({"unix:" + settings.run_folder + "/can0.sock", 64, false});
  ASSERT_TRUE(can.link) << can.problem;
  pollfd wait{can.link->fd(), POLLIN, 0};
  EXPECT_EQ(::poll(&wait, 1, 20'000), 1) << "no frame came";

  EXPECT_THAT(ask(socket, "dance"), StartsWith("error: unknown command"));
  EXPECT_THAT(ask(socket, "can can9 unplug"), StartsWith("error: say: can BUS"));
  EXPECT_THAT(ask(socket, "truth"), HasSubstr("\"x_m\":"));
  EXPECT_EQ(ask(socket, "estop press"), "ok");
  EXPECT_TRUE(fs::is_symlink(folder / "run/gnss"));
  for (const auto* sensor : {"imu", "imu imu_rear"})  // on the bus
    for (const auto* what : {" unplug", " plug", " silent", " well"})
      EXPECT_EQ(ask(socket, sensor + std::string(what)), "ok") << sensor << what;
  EXPECT_THAT(ask(socket, "imu imu_front unplug"), StartsWith("error: "));
  EXPECT_EQ(ask(socket, "gnss unplug"), "ok");
  EXPECT_FALSE(fs::is_symlink(folder / "run/gnss"));
  EXPECT_EQ(ask(socket, "gnss plug"), "ok");
  EXPECT_TRUE(fs::is_symlink(folder / "run/gnss"));
  EXPECT_EQ(ask(socket, "lidar unplugged"), "ok");
  EXPECT_FALSE(fs::is_symlink(folder / "run/lidar"));
  EXPECT_EQ(ask(socket, "lidar normal"), "ok");
  EXPECT_TRUE(fs::is_symlink(folder / "run/lidar"));
  EXPECT_EQ(ask(socket, "lidar covered"), "ok");
  EXPECT_THAT(ask(socket, "lidar muddy"), StartsWith("error: no state 'muddy'"));
  EXPECT_EQ(ask(socket, "quit"), "ok");
  loop.join();
  EXPECT_THAT(simulator.summary(), HasSubstr(" ticks"));
  EXPECT_THAT(read("log/can.log"), HasSubstr(") can0 001#"));
  EXPECT_THAT(read("log/can.log"), HasSubstr(") can0 0CFF3408#"));
  EXPECT_THAT(read("log/can.log"), HasSubstr(") can0 0CFF3709#"));
  EXPECT_THAT(read("log/truth.csv"), StartsWith("time_s,x_m,y_m"));
}

TEST_F(SimulatorTest, ScansOnASerialLineAtTheScannersSpeed) {
  Simulator simulator(settings);
  std::thread loop([&simulator] { simulator.run(); });
  auto line = link::open_serial({(folder / "run/lidar").string(), 230400});
  ASSERT_TRUE(line.link) << line.problem;
  const auto* const entry = find_driver("ld06");
  const auto made = entry->make(Options(entry->options)
                                    .set("mount_x_m", 0.0)
                                    .set("mount_y_m", 0.0)
                                    .set("mount_z_m", 0.2)
                                    .set("mount_yaw_deg", 0.0),
                                {});
  Time now{std::chrono::seconds(100)};
  // Half a second of packets, however slow the machine is.
  for (int i = 0; i < 2000 && made.device->health(now).good < 190; ++i) {
    std::array<std::uint8_t, 1024> bytes{};
    std::size_t size = 0;
    ASSERT_TRUE(line.link->read(bytes, size));
    ScanOut out;
    made.scans->on_bytes({bytes.data(), size}, now, out);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    now += std::chrono::milliseconds(5);
  }
  EXPECT_GE(made.device->health(now).good, 190U);
  EXPECT_LE(made.device->health(now).bad, 1U) << "the first may be cut";
  EXPECT_EQ(ask(settings.run_folder + "/sim.sock", "quit"), "ok");
  loop.join();
}

TEST_F(SimulatorTest, LeavesNothingInItsRunFolder) {
  {
    Simulator simulator(settings);
    std::thread loop([&simulator] { simulator.run(); });
    (void)ask(settings.run_folder + "/sim.sock", "quit");
    loop.join();
  }
  for (const auto* name : {"run/gnss", "run/lidar", "run/can0.sock", "run/sim.sock", "run/ready"})
    EXPECT_FALSE(fs::exists(fs::symlink_status(folder / name))) << name;
}

}  // namespace
}  // namespace drover::sim
