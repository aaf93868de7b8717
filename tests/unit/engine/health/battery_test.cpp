#include "engine/health/battery.h"

#include <gtest/gtest.h>

namespace drover::engine {
namespace {

using namespace std::chrono_literals;

class ABatteryMonitor : public ::testing::Test {
 protected:
  ABatteryMonitor() {
    source.state = SourceState::fresh;
    sample.soc_percent = 70;
    sample.temperature_degC = 25;
    sample.min_cell_V = 3.3;
    sample.max_cell_V = 3.31;
  }
  /// A sample each second, looked at five times in between.
  void run(Duration time) {
    for (const Time end = now + time; now < end;) {
      battery.sample = sample;
      battery.time = now;
      for (int i = 0; i < 5; ++i, now += 200ms)
        verdict = monitor.update(now, battery, source, stands);
    }
  }
  std::string critical() const { return std::string(verdict.critical.view()); }

  BatteryMonitor monitor{HealthConfig{}};
  BatterySnapshot battery;
  BatterySample sample;
  SourceHealth source;
  BatteryVerdict verdict;
  bool stands = true;
  Time now{100s};
};

TEST_F(ABatteryMonitor, SaysThatNothingIsKnownUntilItWasHeardAndWhenItIsSilent) {
  source.state = SourceState::never_heard;
  source.reason = "no answer";
  verdict = monitor.update(now, battery, source);
  EXPECT_EQ(verdict.silent, "battery unknown: no answer");
  EXPECT_TRUE(verdict.critical.empty());
  source = {};
  source.state = SourceState::fresh;
  run(3s);
  EXPECT_TRUE(verdict.silent.empty()) << verdict.silent.view();
  // Its thread hangs: nobody tells that the source is stale.
  verdict = monitor.update(now + 6s, battery, source);
  EXPECT_FALSE(verdict.silent.empty());
}

TEST_F(ABatteryMonitor, StopsNothingWhenItIsSilent) {
  run(3s);
  source.state = SourceState::stale;
  verdict = monitor.update(now + 60s, battery, source);
  EXPECT_TRUE(verdict.critical.empty() && verdict.low.empty() && verdict.charger.empty());
}

TEST_F(ABatteryMonitor, CountsAnEmptyOneAtOnceWhenItIsTheFirstThatIsHeard) {
  sample.soc_percent = 5;
  run(1s);
  EXPECT_EQ(critical(), "battery empty: 5 %, at least 10 % are needed");
}

TEST_F(ABatteryMonitor, TakesNoSagForAnEmptyBattery) {
  run(5s);
  sample.soc_percent = 3;
  run(19s);
  EXPECT_EQ(critical(), "");
  sample.soc_percent = 70;
  run(1s);
  sample.soc_percent = 3;
  run(19s);
  EXPECT_EQ(critical(), "");
  run(2s);
  EXPECT_NE(critical(), "");
}

TEST_F(ABatteryMonitor, ForgetsALimitOnlyAfterAsLongBack) {
  sample.soc_percent = 15;
  run(1s);
  EXPECT_EQ(verdict.low, "battery low: 15 %");
  EXPECT_EQ(critical(), "");
  sample.soc_percent = 21;
  run(20s);
  EXPECT_FALSE(verdict.low.empty());
  run(1s);
  EXPECT_TRUE(verdict.low.empty());
}

TEST_F(ABatteryMonitor, SaysOfALimitThatIsHeldOnWhenItWasSoAndWhatIsNow) {
  sample.soc_percent = 5;
  sample.temperature_degC = 70;
  run(1s);
  sample.soc_percent = 80;
  run(4s);
  EXPECT_EQ(critical(), "battery too hot: 70 C") << "what is so comes before what was";
  sample.soc_percent = 15;
  sample.temperature_degC = 30;
  run(3s);
  EXPECT_EQ(critical(), "battery was empty until 7 s ago, 15 % now");
  run(14s);
  EXPECT_EQ(critical(), "battery was too hot until 17 s ago, 30 C now");
  EXPECT_EQ(verdict.low, "battery low: 15 %");
  run(5s);
  EXPECT_EQ(critical(), "");
  sample.soc_percent = 80;
  run(4s);
  EXPECT_EQ(verdict.low, "battery was low until 4 s ago, 80 % now");
}

TEST_F(ABatteryMonitor, SaysOfCellsAndAnAlarmThatAreHeldOnWhenItWasSo) {
  sample.min_cell_V = 2.7;
  run(1s);
  sample.min_cell_V = 3.3;
  run(4s);
  EXPECT_EQ(critical(), "battery cells were too far apart until 4 s ago, 3.30 V to 3.31 V now");
  run(20s);
  sample.alarm = BatteryAlarm::critical;
  battery.alarms = "short circuit";
  run(2s);
  sample.alarm = BatteryAlarm::none;
  battery.alarms = "";
  run(4s);
  EXPECT_EQ(critical(), "battery had an alarm until 4 s ago");
  sample.temperature_degC = 55;
  run(22s);
  sample.temperature_degC = 30;
  run(4s);
  EXPECT_EQ(verdict.warning, "battery was hot until 4 s ago, 30 C now");
}

TEST_F(ABatteryMonitor, KeepsAVerdictWhileTheChargeIsUnknown) {
  sample.soc_percent = 15;
  run(1s);
  sample.soc_percent = kAbsent;
  run(60s);
  EXPECT_EQ(verdict.low, "battery low when its charge was told");
}

TEST_F(ABatteryMonitor, TellsHotAndEndsTasksWhenTooHotOrCellsAreApart) {
  run(1s);
  sample.temperature_degC = 55;
  run(22s);
  EXPECT_EQ(verdict.warning, "battery hot: 55 C");
  EXPECT_EQ(critical(), "");
  sample.temperature_degC = 65;
  run(22s);
  EXPECT_EQ(critical(), "battery too hot: 65 C");
  sample.temperature_degC = 25;
  sample.min_cell_V = 2.7;
  run(22s);
  EXPECT_EQ(critical(), "battery cells too far apart: 2.70 V to 3.31 V");
}

TEST_F(ABatteryMonitor, BelievesACriticalAlarmWithTheSecondSampleAndAWarningAtOnce) {
  run(1s);
  sample.alarm = BatteryAlarm::warning;
  battery.alarms = "cells apart";
  run(1s);
  EXPECT_EQ(verdict.warning, "battery: cells apart");
  sample.alarm = BatteryAlarm::critical;
  battery.alarms = "short circuit";
  run(1s);
  EXPECT_EQ(critical(), "");
  run(1s);
  EXPECT_EQ(critical(), "battery: short circuit");
}

TEST_F(ABatteryMonitor, KnowsTheChargerFromTheFirstWordToTheLast) {
  run(1s);
  sample.charger_connected = true;
  run(1s);
  EXPECT_EQ(verdict.charger, "charging: unplug the charger first");
  sample.charger_connected = false;
  run(1s);
  EXPECT_TRUE(verdict.charger.empty());
}

TEST_F(ABatteryMonitor, LetsNoTaskStartWhileItChargesAtRestForHoweverShortATime) {
  run(2s);
  sample.charges = true;
  run(1s);
  EXPECT_EQ(verdict.present, "charging: unplug the charger first");
  EXPECT_TRUE(verdict.charger.empty()) << "what drives goes on";
  sample.charges = false;
  run(1s);
  EXPECT_TRUE(verdict.present.empty());
}

TEST_F(ABatteryMonitor, TakesWhatABrakeGaveBackForNoCharger) {
  run(2s);
  stands = false;
  sample.charges = true;
  run(3s);
  EXPECT_TRUE(verdict.present.empty());
  // It stands now, and the last sample is of before, or of a mean that has some of it.
  stands = true;
  run(1s);
  EXPECT_TRUE(verdict.present.empty());
  sample.charges = false;
  run(1s);
  EXPECT_TRUE(verdict.present.empty());
  // One that goes on at rest is a charger.
  sample.charges = true;
  run(1s);
  EXPECT_FALSE(verdict.present.empty());
}

TEST_F(ABatteryMonitor, LetsNoTaskStartWhenItFellSilentWhileItCharged) {
  run(2s);
  sample.charges = true;
  run(1s);
  source.state = SourceState::stale;
  verdict = monitor.update(now + 60s, battery, source);
  EXPECT_EQ(verdict.present, "the charger was connected when the battery was last heard");
}

TEST_F(ABatteryMonitor, LetsNoTaskStartAtAPlugThatWasThereWhenItFellSilent) {
  sample.charger_connected = true;
  run(1s);
  EXPECT_TRUE(verdict.plugged.empty());
  source.state = SourceState::stale;
  verdict = monitor.update(now + 60s, battery, source);
  EXPECT_EQ(verdict.plugged, "the charger was connected when the battery was last heard");
  EXPECT_TRUE(verdict.charger.empty()) << "old knowledge ends no task";
  source.state = SourceState::fresh;
  sample.charger_connected = false;
  run(1s);
  EXPECT_TRUE(verdict.plugged.empty());
}

}  // namespace
}  // namespace drover::engine
