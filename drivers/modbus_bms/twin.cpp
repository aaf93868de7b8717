// A simulated battery's registers, laid out by the same map that the driver reads by.
#include "drivers/modbus_bms/twin.h"

#include <algorithm>

namespace drover::modbus_bms {
namespace {

/// Cells differ: the lowest and the highest stand so far from the mean.
constexpr double kSpread_V = 0.01;
constexpr double kSwitchAboveCells_degC = 4.0;

BatteryFlow flow_of(const BatteryTruth& truth) {
  constexpr double kStill_A = 0.05;
  if (truth.current_A > kStill_A) return BatteryFlow::charging;
  return truth.current_A < -kStill_A ? BatteryFlow::discharging : BatteryFlow::idle;
}

}  // namespace

ModbusBmsTwin::ModbusBmsTwin(const Options& options, const RegisterMap& map)
    : map_(map),
      cells_(static_cast<std::uint16_t>(options.number("cells"))),
      probes_(static_cast<std::uint16_t>(options.number("probes"))) {
  for (const RegisterBlock& block : plan_blocks(map))
    for (std::uint32_t i = 0; i < block.count; ++i)
      at(block.function, block.address + i * map.stride) = 0;
  set_truth({});
}

std::uint16_t& ModbusBmsTwin::at(std::uint8_t function, std::uint32_t address) {
  return registers_[function][static_cast<std::uint16_t>(address)];
}

double ModbusBmsTwin::value_of(const RegisterField& field, const BatteryTruth& truth) const {
  switch (field.field) {
    case BatteryField::voltage_V: return truth.voltage_V;
    case BatteryField::current_A: return truth.current_A;
    case BatteryField::soc_percent: return truth.soc_percent;
    case BatteryField::remaining_Ah: return truth.capacity_Ah * truth.soc_percent / 100;
    case BatteryField::temperature_degC: return truth.temperature_degC;
    case BatteryField::mosfet_degC: return truth.temperature_degC + kSwitchAboveCells_degC;
    case BatteryField::min_cell_V:
    case BatteryField::max_cell_V: return truth.voltage_V / cells_;
    case BatteryField::flow:
    case BatteryField::charger: break;
  }
  return 0;
}

void ModbusBmsTwin::put(const RegisterField& field, std::uint32_t index, double raw) {
  const auto address = field.address + index * registers_of(field.type) * map_.stride;
  std::uint16_t unused = 0;
  const bool two = registers_of(field.type) == 2;
  put_raw(field.type, field.order, raw, at(field.function, address),
          two ? at(field.function, address + map_.stride) : unused);
}

void ModbusBmsTwin::set_truth(const BatteryTruth& truth) {
  for (const RegisterField& field : map_.fields) {
    if (field.field == BatteryField::flow) {
      const auto it = std::find(field.flows.begin(), field.flows.end(), flow_of(truth));
      put(field, 0, it == field.flows.end() ? 0 : static_cast<double>(it - field.flows.begin()));
    } else if (field.field == BatteryField::charger) {
      put(field, 0, truth.charger_connected ? 1 : 0);
    } else {
      const bool cell =
          field.field == BatteryField::min_cell_V || field.field == BatteryField::max_cell_V;
      const std::uint16_t fitted = std::min(field.count, cell ? cells_ : probes_);
      if (field.count_address) at(field.function, *field.count_address) = fitted;
      const double value = value_of(field, truth);
      for (std::uint32_t i = 0; i < field.count; ++i) {
        double own = value;
        if (cell && field.count > 1 && fitted > 1)
          own += i == 0 ? -kSpread_V : i == 1 ? kSpread_V : 0;
        // What is not fitted reads 0, whatever 0 would mean.
        put(field, i, field.count == 1 || i < fitted ? (own - field.offset) / field.scale : 0);
      }
    }
  }
  for (const RegisterAlarm& alarm : map_.alarms) at(alarm.function, alarm.address) = 0;
  for (std::size_t i = 0; i < map_.alarms.size() && i < kMaxRegisterAlarms; ++i)
    if ((truth.alarm_bits >> i & 1U) != 0)
      at(map_.alarms[i].function, map_.alarms[i].address) |=
          static_cast<std::uint16_t>(1U << map_.alarms[i].bit);
}

bool ModbusBmsTwin::read(std::uint8_t function, std::uint16_t address,
                         std::span<std::uint16_t> words) const {
  const auto bank = registers_.find(function);
  if (bank == registers_.end()) return false;
  const auto known = [&](std::uint32_t one) {
    return one <= 0xFFFF && bank->second.count(static_cast<std::uint16_t>(one)) != 0;
  };
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto one = static_cast<std::uint32_t>(address + i * map_.stride);
    if (!known(one)) return false;
    words[i] = bank->second.at(static_cast<std::uint16_t>(one));
  }
  return !words.empty();
}

}  // namespace drover::modbus_bms
