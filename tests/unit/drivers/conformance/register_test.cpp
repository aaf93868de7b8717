// What every driver of registers must do, with every map that comes with them.
#include <gtest/gtest.h>

#include <set>

#include "support/describe.h"
#include "unit/drivers/conformance/harness.h"
#include "unit/drivers/conformance/register_harness.h"

namespace drover::test {
namespace {

using std::chrono::seconds;

class RegisterConformance : public ::testing::TestWithParam<std::tuple<Subject, std::string>> {
 protected:
  Made make() const { return made_of(*subject().entry, subject().options, &map); }
  std::unique_ptr<RegisterTwin> make_twin() const {
    return std::get<MakeRegisterTwin>(subject().entry->make_twin)(subject().options, map);
  }
  const Subject& subject() const { return std::get<0>(GetParam()); }

  /// One round against the twin; false when the twin refuses.
  static bool round(const Made& driver, const RegisterTwin& twin, Time now, DriverOut& out) {
    std::array<std::uint16_t, 125> words{};
    for (std::size_t i = 0; i < driver.registers->blocks().size(); ++i) {
      const RegisterBlock& block = driver.registers->blocks()[i];
      const std::span<std::uint16_t> part(words.data(), block.count);
      if (!twin.read(block.function, block.address, part)) return false;
      driver.registers->on_registers(i, part, now, out);
    }
    return true;
  }

  const RegisterMap map = read_map(std::get<1>(GetParam()));
  Time now{seconds(100)};
  DriverOut out;
};

TEST_P(RegisterConformance, AsksForNoMoreThanTheDeviceAnswersAndForNoTwoBlocksOfOneLength) {
  const auto driver = make();
  std::set<int> lengths;
  ASSERT_FALSE(driver.registers->blocks().empty());
  for (const RegisterBlock& block : driver.registers->blocks()) {
    EXPECT_GE(block.count, 1);
    EXPECT_LE(block.count, map.max_count);
    EXPECT_TRUE(lengths.insert(block.count).second) << block.count << " registers, twice";
  }
}

TEST_P(RegisterConformance, AnswersItsOwnTwin) {
  const auto driver = make();
  const auto twin = make_twin();
  BatteryTruth truth;
  truth.voltage_V = 26.1;
  truth.current_A = -4.5;
  truth.soc_percent = 63;
  truth.capacity_Ah = 50;
  truth.temperature_degC = 21;
  truth.alarm_bits = 1U << 3U;
  twin->set_truth(truth);
  ASSERT_TRUE(round(driver, *twin, now, out));
  ASSERT_EQ(out.measurements.size(), 1U);
  const auto& sample = std::get<BatterySample>(out.measurements[0].value);
  EXPECT_EQ(out.measurements[0].time, now);
  EXPECT_NEAR(sample.voltage_V, 26.1, 0.06);
  EXPECT_NEAR(std::abs(sample.current_A), 4.5, 0.06);
  EXPECT_NEAR(sample.soc_percent, 63, 0.6);
  EXPECT_NEAR(sample.remaining_Ah, 31.5, 0.06);
  EXPECT_NEAR(sample.temperature_degC, 21, 0.6);
  EXPECT_NEAR(sample.min_cell_V, 26.1 / 8, 0.011);
  EXPECT_NEAR(sample.max_cell_V, 26.1 / 8, 0.011);
  EXPECT_LT(sample.min_cell_V, sample.max_cell_V);
  EXPECT_FALSE(sample.charger_connected);
  EXPECT_EQ(sample.alarm_bits, truth.alarm_bits);
  EXPECT_EQ(driver.device->words(out.measurements[0]).view(), map.alarms[3].text);
  EXPECT_EQ(driver.device->health(now).bad, 0U);
}

TEST_P(RegisterConformance, IsNeverHeardThenFreshThenStaleAndSaysWhy) {
  const auto driver = make();
  const auto twin = make_twin();
  twin->set_truth({26, 0, 50, 40, 20, false, 0});
  EXPECT_EQ(driver.device->health(now).state, SourceState::never_heard);
  EXPECT_FALSE(driver.device->health(now).reason.empty());
  ASSERT_TRUE(round(driver, *twin, now, out));
  EXPECT_EQ(driver.device->health(now).state, SourceState::fresh);
  EXPECT_TRUE(driver.device->health(now).reason.empty())
      << driver.device->health(now).reason.view();
  now += seconds(61);
  EXPECT_EQ(driver.device->health(now).state, SourceState::stale);
  EXPECT_FALSE(driver.device->health(now).reason.empty());
}

TEST_P(RegisterConformance, ReportsNothingOfARoundThatFailed) {
  const auto twin = make_twin();
  twin->set_truth({26, 0, 50, 40, 20, false, 0});
  std::array<std::uint16_t, 125> words{};
  for (std::size_t failing = 0; failing < make().registers->blocks().size(); ++failing) {
    const auto driver = make();
    for (std::size_t i = 0; i < driver.registers->blocks().size(); ++i) {
      const RegisterBlock& block = driver.registers->blocks()[i];
      const std::span<std::uint16_t> part(words.data(), block.count);
      ASSERT_TRUE(twin->read(block.function, block.address, part));
      if (i == failing) {
        driver.registers->on_failure(i, RegisterFailure::silent, 0, now);
      } else {
        driver.registers->on_registers(i, part, now, out);
      }
    }
    EXPECT_EQ(describe(out), "nothing");
    EXPECT_EQ(driver.device->health(now).state, SourceState::never_heard);
    EXPECT_EQ(driver.device->health(now).bad, 1U);
  }
}

TEST_P(RegisterConformance, TellsTheSecondFailureInARowAndForgetsItWithTheNextGoodRound) {
  const auto driver = make();
  const auto twin = make_twin();
  twin->set_truth({26, 0, 50, 40, 20, false, 0});
  ASSERT_TRUE(round(driver, *twin, now, out));
  for (const auto failure :
       {RegisterFailure::silent, RegisterFailure::damaged, RegisterFailure::wrong_unit,
        RegisterFailure::refused, RegisterFailure::link}) {
    driver.registers->on_failure(0, failure, 2, now);
    EXPECT_TRUE(driver.device->health(now).reason.empty());
    driver.registers->on_failure(0, failure, 2, now);
    EXPECT_FALSE(driver.device->health(now).reason.empty());
    EXPECT_EQ(driver.device->health(now).state, SourceState::fresh);
    ASSERT_TRUE(round(driver, *twin, now, out));
    EXPECT_TRUE(driver.device->health(now).reason.empty())
        << driver.device->health(now).reason.view();
  }
}

TEST_P(RegisterConformance, BelievesNoAbsurdValueOfRandomRegistersAndAllocatesNothing) {
  const auto driver = make();
  std::mt19937 random(7);
  std::array<std::uint16_t, 125> words{};
  std::uint64_t allocations = 0;
  for (int i = 0; i < 3000; ++i) {
    now += seconds(1);
    out.clear();
    AllocationCounter counter;
    for (std::size_t block = 0; block < driver.registers->blocks().size(); ++block) {
      for (auto& word : words)
        word = static_cast<std::uint16_t>(random() % 3 == 0 ? random() : random() % 64);
      driver.registers->on_registers(block, {words.data(), driver.registers->blocks()[block].count},
                                     now, out);
    }
    (void)driver.device->health(now);
    allocations += counter.count();
    ASSERT_EQ(out.measurements.size(), 1U);
    const auto& sample = std::get<BatterySample>(out.measurements[0].value);
    const auto inside = [](double value, double min, double max) {
      return std::isnan(value) || (value >= min && value <= max);
    };
    ASSERT_TRUE(inside(sample.soc_percent, 0, 100)) << describe(out);
    ASSERT_TRUE(inside(sample.voltage_V, 1, 1000)) << describe(out);
    ASSERT_TRUE(inside(sample.temperature_degC, -40, 125)) << describe(out);
    ASSERT_TRUE(inside(sample.min_cell_V, 0.5, 5)) << describe(out);
    ASSERT_TRUE(inside(sample.max_cell_V, 0.5, 5)) << describe(out);
  }
  EXPECT_EQ(allocations, 0U);
  EXPECT_GT(driver.device->health(now).bad, 0U);
}

INSTANTIATE_TEST_SUITE_P(Registry, RegisterConformance,
                         ::testing::Combine(::testing::ValuesIn(subjects(&Made::registers)),
                                            ::testing::ValuesIn(map_names())),
                         [](const auto& test) {
                           return std::get<0>(test.param).label + "_" +
                                  alphanumeric(std::get<1>(test.param));
                         });

}  // namespace
}  // namespace drover::test
