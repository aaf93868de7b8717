#include "drivers/modbus_bms/driver.h"

#include <gtest/gtest.h>

#include "drivers/modbus_bms/entry.h"
#include "support/describe.h"

namespace drover::modbus_bms {
namespace {

using std::chrono::seconds;

RegisterField field(BatteryField what, std::uint16_t address, double scale, double offset,
                    double min, double max) {
  RegisterField f;
  f.field = what;
  f.address = address;
  f.scale = scale;
  f.offset = offset;
  f.min = min;
  f.max = max;
  return f;
}

/// Voltage, current, state of charge, state.
RegisterMap small_map() {
  RegisterMap map;
  map.fields = {field(BatteryField::voltage_V, 0, 0.1, 0, 1, 1000),
                field(BatteryField::current_A, 1, 0.1, -3000, -2000, 2000),
                field(BatteryField::soc_percent, 2, 1, 0, 0, 100),
                field(BatteryField::flow, 3, 1, 0, 0, 0)};
  map.fields[3].flows = {BatteryFlow::idle, BatteryFlow::charging, BatteryFlow::discharging};
  return map;
}

class ABmsDriver : public ::testing::Test {
 protected:
  BatterySample give(std::vector<std::uint16_t> words) {
    if (!driver) driver.emplace(read_settings(options), map);
    now += seconds(1);
    out.clear();
    driver->on_registers(0, words, now, out);
    return out.measurements.empty() ? BatterySample{}
                                    : std::get<BatterySample>(out.measurements[0].value);
  }
  std::string reason() const { return std::string(driver->health(now).reason.view()); }

  RegisterMap map = small_map();
  Options options{kModbusBmsEntry.options};
  std::optional<ModbusBmsDriver> driver;
  Time now{seconds(100)};
  DriverOut out;
};

TEST_F(ABmsDriver, LeavesOutWhatCannotBeAndCountsAndTellsIt) {
  options.set("max_voltage_V", 60.0);
  const auto sample = give({655, 30000, 255, 9});
  EXPECT_TRUE(std::isnan(sample.soc_percent));
  EXPECT_TRUE(std::isnan(sample.voltage_V));
  EXPECT_EQ(sample.flow, BatteryFlow::unknown);
  EXPECT_EQ(driver->health(now).bad, 3U);
  EXPECT_EQ(reason(), "state of charge of 255 % cannot be");
  EXPECT_EQ(give({480, 30000, 55, 0}).soc_percent, 55);
  EXPECT_EQ(reason(), "");
}

TEST_F(ABmsDriver, IgnoresAnAnswerOfAnotherLengthOrOutOfTurn) {
  EXPECT_TRUE(std::isnan(give({480, 30000, 55}).voltage_V));
  driver->on_registers(1, std::vector<std::uint16_t>{1, 2, 3, 4}, now, out);
  EXPECT_TRUE(out.measurements.empty());
  EXPECT_EQ(driver->health(now).state, SourceState::never_heard);
}

TEST_F(ABmsDriver, TurnsTheCurrentRoundWhenTheOptionSaysSo) {
  EXPECT_NEAR(give({480, 29911, 55, 2}).current_A, -8.9, 1e-9);
  options.set("current_sign", std::string("reversed"));
  driver.reset();
  EXPECT_NEAR(give({480, 29911, 55, 2}).current_A, 8.9, 1e-9);
}

TEST_F(ABmsDriver, TellsThatCurrentAndStateContradictEachOther) {
  give({480, 30089, 55, 2});
  give({480, 30089, 55, 2});
  EXPECT_EQ(reason(), "");
  give({480, 30089, 55, 2});
  EXPECT_EQ(reason(), "current and state contradict each other: see option current_sign");
}

TEST_F(ABmsDriver, TakesALastingChargingCurrentForAChargerAndABriefOneForBraking) {
  EXPECT_FALSE(give({480, 30050, 55, 1}).charger_connected);
  EXPECT_FALSE(give({480, 30050, 55, 1}).charger_connected);
  EXPECT_FALSE(give({480, 29990, 55, 2}).charger_connected);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(give({480, 30050, 55, 1}).charger_connected);
  EXPECT_TRUE(give({480, 30050, 55, 1}).charger_connected);
  EXPECT_FALSE(give({480, 30000, 55, 0}).charger_connected);
}

TEST_F(ABmsDriver, TellsAtOnceThatItChargesAsAChargerDoes) {
  EXPECT_FALSE(give({480, 30010, 55, 1}).charges) << "1 A";
  EXPECT_TRUE(give({480, 30050, 55, 1}).charges);
  EXPECT_FALSE(give({480, 30050, 55, 2}).charges) << "its state says otherwise";
  EXPECT_FALSE(give({480, 29990, 55, 2}).charges);
}

TEST_F(ABmsDriver, NamesTheRegistersThatTheDeviceRefuses) {
  give({480, 30000, 55, 0});
  for (int i = 0; i < 2; ++i) driver->on_failure(0, RegisterFailure::refused, 2, now);
  EXPECT_EQ(reason(), "refuses 4 registers from 0 (0x0000): exception 2, illegal address");
}

TEST_F(ABmsDriver, NamesARefusedRegisterAsAMapDoes) {
  map.fields = {field(BatteryField::soc_percent, 40041, 1, 0, 0, 100)};
  give({55});
  for (int i = 0; i < 2; ++i) driver->on_failure(0, RegisterFailure::refused, 2, now);
  EXPECT_EQ(reason(), "refuses 1 register from 40041 (0x9C69): exception 2, illegal address");
}

TEST_F(ABmsDriver, RefusesAMapThatAsksForNothing) {
  map.fields.clear();
  EXPECT_THROW(give({}), std::runtime_error);
}

TEST(ModbusRegisters, AreReadInEveryWordOrderAndType) {
  const auto raw = [](RegisterType type, WordOrder order, std::uint16_t a, std::uint16_t b) {
    return raw_value(type, order, a, b).value_or(-1);
  };
  EXPECT_EQ(raw(RegisterType::i32, WordOrder::abcd, 0xFFFF, 0xE0C0), -8000);
  EXPECT_EQ(raw(RegisterType::i32, WordOrder::cdab, 0xE0C0, 0xFFFF), -8000);
  EXPECT_EQ(raw(RegisterType::u32, WordOrder::badc, 0x0100, 0x0302), 0x00010203);
  EXPECT_EQ(raw(RegisterType::u32, WordOrder::dcba, 0x0302, 0x0100), 0x00010203);
  EXPECT_EQ(raw(RegisterType::i16, WordOrder::badc, 0xFEFF, 0), -2);
  EXPECT_EQ(raw(RegisterType::u8_high, WordOrder::abcd, 0x1237, 0), 0x12);
  EXPECT_EQ(raw(RegisterType::u8_low, WordOrder::abcd, 0x1237, 0), 0x37);
  EXPECT_EQ(raw(RegisterType::f32, WordOrder::abcd, 0x41C8, 0x0000), 25);
  EXPECT_FALSE(raw_value(RegisterType::f32, WordOrder::abcd, 0x7FC0, 0x0000));
}

TEST(ModbusRegisters, AreWrittenAsTheyAreRead) {
  for (const auto order : {WordOrder::abcd, WordOrder::cdab, WordOrder::badc, WordOrder::dcba}) {
    for (const auto type :
         {RegisterType::u8_high, RegisterType::u8_low, RegisterType::u16, RegisterType::i16,
          RegisterType::u32, RegisterType::i32, RegisterType::f32}) {
      for (const double value : {0.0, 1.0, 77.0, 255.0}) {
        std::uint16_t first = 0;
        std::uint16_t second = 0;
        put_raw(type, order, value, first, second);
        EXPECT_EQ(raw_value(type, order, first, second), value);
      }
    }
  }
}

TEST(ModbusRegisters, OfATemperatureThatIsNotFittedSayNothing) {
  // Daly, a capture of esphome-daly-bms issue 9: 0x42 is FFFF where there is no sensor.
  RegisterMap map;
  map.fields = {field(BatteryField::mosfet_degC, 0x42, 1, -40, -40, 200)};
  map.fields[0].invalid = {0xFFFF, 0};
  const std::vector<std::uint16_t> words{0, 0, 0x7530, 0, 0xFFFF, 0, 0, 0, 0};
  const modbus_bms::Run run{3, 0x3E, words};
  const auto decoded = decode(map, {&run, 1});
  EXPECT_TRUE(std::isnan(decoded.sample.mosfet_degC));
  EXPECT_EQ(decoded.absurd, 0U);
}

TEST(ModbusBlocks, AreMergedAcrossSmallHolesOnlyAndNeverSplitAValue) {
  RegisterMap map;
  map.max_count = 4;
  map.max_hole = 1;
  map.fields = {field(BatteryField::voltage_V, 10, 1, 0, 0, 1),
                field(BatteryField::current_A, 12, 1, 0, 0, 1),
                field(BatteryField::soc_percent, 13, 1, 0, 0, 1),
                field(BatteryField::remaining_Ah, 20, 1, 0, 0, 1)};
  map.fields[2].type = RegisterType::u32;  // 13 and 14 would make five registers
  const auto blocks = plan_blocks(map);
  ASSERT_EQ(blocks.size(), 3U);
  EXPECT_EQ(blocks[0].address, 10);
  EXPECT_EQ(blocks[0].count, 3);
  EXPECT_EQ(blocks[1].address, 13);
  EXPECT_EQ(blocks[1].count, 2);
  EXPECT_EQ(blocks[2].address, 20);
}

// Seplos v3 refuses a read of PIA that goes one register beyond its 17 (exception 2).
TEST(ModbusBlocks, NeverReachBeyondTheRegistersThatTheMapDeclares) {
  RegisterMap map;
  map.fields = {field(BatteryField::voltage_V, 0x1000, 1, 0, 0, 1),
                field(BatteryField::soc_percent, 0x1005, 1, 0, 0, 1),
                field(BatteryField::min_cell_V, 0x1100, 1, 0, 0, 1)};
  map.fields[2].count = 16;
  const auto blocks = plan_blocks(map);
  ASSERT_EQ(blocks.size(), 3U);
  EXPECT_EQ(blocks[0].count, 1);  // no gap is read along that the map does not declare
  EXPECT_EQ(blocks[1].count, 1);  // and none is made longer to differ from another
  EXPECT_EQ(blocks[2].count, 16);
  map.max_hole = 4;
  EXPECT_EQ(plan_blocks(map).size(), 2U);
  EXPECT_EQ(plan_blocks(map)[0].count, 6);
}

TEST_F(ABmsDriver, TellsTheFlowFromTheCurrentWhereTheMapHasNoStateRegister) {
  map.fields.pop_back();
  EXPECT_EQ(give({550, 30100, 80}).flow, BatteryFlow::charging);
  EXPECT_EQ(give({550, 29900, 80}).flow, BatteryFlow::discharging);
  EXPECT_EQ(give({550, 30002, 80}).flow, BatteryFlow::idle) << "0.2 A";
  map.fields.erase(map.fields.begin() + 1);
  map.max_hole = 4;
  driver.reset();
  EXPECT_EQ(give({550, 0, 80}).flow, BatteryFlow::unknown) << "no current either";
}

}  // namespace
}  // namespace drover::modbus_bms
