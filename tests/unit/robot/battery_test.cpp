// The simulated battery and its line, read by the gateway's own driver.
#include "sim/robot/battery.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "config/register_map.h"
#include "drover/registry.h"
#include "link/modbus_frame.h"
#include "sim/robot/battery_port.h"

namespace drover::sim {
namespace {

using namespace std::chrono_literals;

TEST(Battery, DischargesWithWhatTheWheelsTakeAndChargesAtTheCharger) {
  Battery battery({});
  battery.step(3600, 200);
  const double after_driving = battery.truth().soc_percent;
  EXPECT_LT(after_driving, 80);
  EXPECT_LT(battery.truth().current_A, -5);
  battery.set_charger(true);
  battery.step(3600, 0);
  EXPECT_GT(battery.truth().current_A, 2);
  EXPECT_GT(battery.truth().soc_percent, after_driving);
}

TEST(Battery, SagsWhenItIsNearlyEmpty) {
  Battery battery({});
  const double full_V = battery.truth().voltage_V;
  battery.set_soc(2);
  battery.step(1, 0);
  EXPECT_LT(battery.truth().voltage_V, full_V - 2);
}

/// The gateway's end of the line, and the device behind it, in steps of 5 ms.
class ABatteryPort : public ::testing::Test {
 protected:
  ABatteryPort() {
    const auto* entry = find_driver("modbus_bms");
    Options options(entry->options);
    for (const auto& spec : entry->twin_options) options.set(spec.name, spec.default_value);
    map = config::load_register_map(DROVER_SOURCE_DIR "/config/maps/daly_d2.json").map;
    twin = std::get<MakeRegisterTwin>(entry->make_twin)(options, map);
    twin->set_truth({26, -3, 55, 40, 21, false, 0});
    link_path =
        std::filesystem::temp_directory_path() / ("drover-battery-" + std::to_string(::getpid()));
    port.emplace(link_path.string(), 9600);
    port->add(210, *twin);
    open();
  }
  void open() { line = link::UniqueFd(::open(link_path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK)); }
  /// What came back in so many seconds of the simulation.
  std::vector<std::uint8_t> ask(double seconds = 1, std::uint8_t unit = 210) {
    const auto request = link::rtu_read_request(unit, kBlock);
    EXPECT_EQ(::write(line.get(), request.data(), request.size()), 8);
    return listen(seconds);
  }
  std::vector<std::uint8_t> listen(double seconds) {
    std::vector<std::uint8_t> heard;
    for (int i = 0; i < seconds * 200; ++i) {
      now += 5ms;
      port->pump(now, 5ms);
      std::array<std::uint8_t, 64> chunk{};
      const auto n = ::read(line.get(), chunk.data(), chunk.size());
      if (n > 0) heard.insert(heard.end(), chunk.begin(), chunk.begin() + n);
    }
    return heard;
  }
  static link::Answer kind(const std::vector<std::uint8_t>& bytes) {
    return link::find_rtu_answer(bytes, 210, kBlock).answer;
  }

  static constexpr RegisterBlock kBlock{3, 0x28, 3};
  RegisterMap map;
  std::unique_ptr<RegisterTwin> twin;
  std::filesystem::path link_path;
  std::optional<BatteryPort> port;
  link::UniqueFd line;
  Time now{100s};
};

TEST_F(ABatteryPort, AnswersAndDoesEverythingWrongThatItIsToldTo) {
  EXPECT_EQ(kind(ask()), link::Answer::good);
  const std::pair<const char*, link::Answer> faults[] = {
      {"silent", link::Answer::nothing},      {"other_unit", link::Answer::wrong_unit},
      {"wrong_crc", link::Answer::damaged},   {"drip", link::Answer::incomplete},
      {"exception", link::Answer::exception}, {"echo", link::Answer::good},
      {"deaf_echo", link::Answer::nothing},   {"slow", link::Answer::nothing}};
  for (const auto& [word, answer] : faults) {
    EXPECT_EQ(port->command(word), "ok");
    EXPECT_EQ(kind(ask()), answer) << word;
  }
  EXPECT_EQ(kind(listen(3)), link::Answer::good) << "the slow one comes after all";
  EXPECT_EQ(port->command("well"), "ok");
  EXPECT_EQ(kind(ask()), link::Answer::good);
  EXPECT_TRUE(port->command("broken").starts_with("error"));
}

TEST_F(ABatteryPort, HasAFaultForEachOfItsUnits) {
  port->add(211, *twin);
  EXPECT_EQ(link::find_rtu_answer(ask(1, 211), 211, kBlock).answer, link::Answer::good);
  EXPECT_EQ(port->command("silent", 1), "ok");
  EXPECT_EQ(ask(1, 211).size(), 0U);
  EXPECT_EQ(kind(ask()), link::Answer::good);
}

TEST_F(ABatteryPort, DripsAByteEach490Milliseconds) {
  port->command("drip");
  EXPECT_EQ(ask(1.96).size(), 4U);
}

TEST_F(ABatteryPort, HangsUpWhenItIsUnpluggedAndComesBack) {
  EXPECT_EQ(port->command("unplug"), "ok");
  std::uint8_t byte = 0;
  EXPECT_LE(::read(line.get(), &byte, 1), 0);
  EXPECT_FALSE(std::filesystem::exists(link_path));
  line.reset();
  EXPECT_EQ(port->command("plug"), "ok");
  open();
  EXPECT_EQ(kind(ask()), link::Answer::good);
}

}  // namespace
}  // namespace drover::sim
