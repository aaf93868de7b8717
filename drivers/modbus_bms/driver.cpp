// Driver of a battery's management system that is read over Modbus, by a register map.
#include "drivers/modbus_bms/driver.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace drover::modbus_bms {
namespace {

/// One failure is noise on the line; two in a row are told.
constexpr int kToldAfter = 2;
/// Below it the sign of a current says nothing.
constexpr double kClearCurrent_A = 1.0;
constexpr int kContradictions = 3;

/// Of a map without a state register: less than this is the pack's own noise.
constexpr double kIdleCurrent_A = 0.3;

BatteryFlow flow_of(double current_A) {
  if (std::isnan(current_A)) return BatteryFlow::unknown;
  if (std::abs(current_A) < kIdleCurrent_A) return BatteryFlow::idle;
  return current_A > 0 ? BatteryFlow::charging : BatteryFlow::discharging;
}

bool tells_flow(const RegisterMap& map) {
  return std::any_of(map.fields.begin(), map.fields.end(),
                     [](const RegisterField& f) { return f.field == BatteryField::flow; });
}

std::string_view exception_text(int exception) {
  switch (exception) {
    case 1: return "illegal function";
    case 2: return "illegal address";
    case 3: return "illegal value";
    case 4: return "device failure";
    case 5: return "not done yet";
    case 6: return "busy";
    case 10: return "the gateway has no path";
    case 11: return "the device behind the gateway is silent";
    default: return "unknown exception";
  }
}

}  // namespace

ModbusBmsDriver::ModbusBmsDriver(const Settings& settings, const RegisterMap& map)
    : settings_(settings), map_(map), tells_flow_(tells_flow(map)), blocks_(plan_blocks(map)) {
  if (blocks_.empty()) throw std::runtime_error("the register map asks for nothing");
  std::size_t total = 0;
  for (const RegisterBlock& block : blocks_) total += block.count;
  words_.resize(total);
  std::size_t at = 0;
  for (const RegisterBlock& block : blocks_) {
    runs_.push_back({block.function, block.address, {words_.data() + at, block.count}});
    at += block.count;
  }
}

void ModbusBmsDriver::on_registers(std::size_t block, std::span<const std::uint16_t> words,
                                   Time received, DriverOut& out) {
  if (block == 0) next_block_ = 0;
  if (block != next_block_ || block >= blocks_.size() || words.size() != blocks_[block].count) {
    next_block_ = blocks_.size();  // out of step: this round is lost
    return;
  }
  const auto at = static_cast<std::size_t>(runs_[block].words.data() - words_.data());
  std::copy(words.begin(), words.end(), words_.begin() + static_cast<std::ptrdiff_t>(at));
  if (++next_block_ == blocks_.size()) complete(received, out);
}

void ModbusBmsDriver::complete(Time received, DriverOut& out) {
  const Decoded decoded = decode(map_, runs_);
  BatterySample sample = decoded.sample;
  bad_ += decoded.absurd;
  oddity_ = decoded.reason;
  if (settings_.current_reversed) sample.current_A = -sample.current_A;
  if (sample.voltage_V < settings_.min_voltage_V || sample.voltage_V > settings_.max_voltage_V) {
    if (oddity_.empty()) oddity_.format("voltage of %.1f V cannot be here", sample.voltage_V);
    sample.voltage_V = kAbsent;
    ++bad_;
  }
  if (!tells_flow_) sample.flow = flow_of(sample.current_A);
  compare_directions(sample);
  judge_charger(sample, received);
  ++good_;
  failed_rounds_ = 0;
  failure_.clear();
  last_good_ = received;
  Measurement m;
  m.time = received;
  m.received = received;
  m.value = sample;
  out.report(m);
}

/// Vendors contradict themselves about the current's sign; the state register knows better.
void ModbusBmsDriver::compare_directions(const BatterySample& sample) {
  const bool contradicts =
      (sample.flow == BatteryFlow::discharging && sample.current_A > kClearCurrent_A) ||
      (sample.flow == BatteryFlow::charging && sample.current_A < -kClearCurrent_A);
  contradictions_ = contradicts ? std::min(contradictions_ + 1, kContradictions) : 0;
}

void ModbusBmsDriver::judge_charger(BatterySample& sample, Time received) {
  // Braking charges, too, but not for long and not much.
  const bool charging = std::isnan(sample.current_A)
                            ? sample.flow == BatteryFlow::charging
                            : sample.current_A >= settings_.charger_current_A &&
                                  sample.flow != BatteryFlow::discharging;
  sample.charges = charging || sample.charger_connected;
  if (!charging) {
    charging_since_ = kNever;
    return;
  }
  if (charging_since_ == kNever) charging_since_ = received;
  if (received - charging_since_ >= settings_.charger_after) sample.charger_connected = true;
}

void ModbusBmsDriver::on_failure(std::size_t block, RegisterFailure failure, int exception,
                                 Time /*now*/) {
  next_block_ = blocks_.size();
  ++bad_;
  failed_rounds_ = std::min(failed_rounds_ + 1, 1000);
  switch (failure) {
    case RegisterFailure::silent: failure_ = "no answer"; break;
    case RegisterFailure::damaged: failure_ = "the answers are damaged"; break;
    case RegisterFailure::wrong_unit: failure_ = "another unit answers"; break;
    case RegisterFailure::link: failure_ = "no line to it"; break;
    case RegisterFailure::refused: {
      const auto text = exception_text(exception);
      const RegisterBlock& asked = blocks_[std::min(block, blocks_.size() - 1)];
      failure_.format("refuses %u register%s from %u (0x%04X): exception %d, %.*s", asked.count,
                      asked.count == 1 ? "" : "s", asked.address, asked.address, exception,
                      static_cast<int>(text.size()), text.data());
      break;
    }
  }
}

void ModbusBmsDriver::on_link_up(Time /*now*/) {
  next_block_ = 0;
  charging_since_ = kNever;
}

Reason ModbusBmsDriver::words(const Measurement& reported) const {
  const auto* const sample = std::get_if<BatterySample>(&reported.value);
  return sample != nullptr ? alarm_words(map_, sample->alarm_bits) : Reason();
}

SourceHealth ModbusBmsDriver::health(Time now) const {
  SourceHealth health;
  health.last_good = last_good_;
  health.good = good_;
  health.bad = bad_;
  if (last_good_ == kNever) {
    health.reason = failure_.empty() ? Reason("never heard") : failure_;
    return health;
  }
  const bool stale = now - last_good_ > settings_.stale_after;
  health.state = stale ? SourceState::stale : SourceState::fresh;
  if (failed_rounds_ >= kToldAfter) {
    health.reason = failure_;
  } else if (stale) {
    health.reason.format("nothing good heard for %.1f s", to_s(now - last_good_));
  } else if (!oddity_.empty()) {
    health.reason = oddity_;
  } else if (contradictions_ >= kContradictions) {
    health.reason = "current and state contradict each other: see option current_sign";
  }
  return health;
}

}  // namespace drover::modbus_bms
