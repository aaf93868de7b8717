// Driver of a battery's management system that is read over Modbus, by a register map.
#pragma once

#include <vector>

#include "drivers/modbus_bms/codec.h"
#include "drover/options.h"

namespace drover::modbus_bms {

struct Settings {
  Duration stale_after{};
  bool current_reversed = false;
  double min_voltage_V = 0;
  double max_voltage_V = 0;
  double charger_current_A = 0;
  Duration charger_after{};
};
/// Throws std::runtime_error naming the option.
Settings read_settings(const Options& options);

/// One BatterySample a round: all blocks answered, in order. A round with a failure says nothing,
/// so that no sample is made of old and new registers. Values outside their range are left out of
/// the sample and counted.
class ModbusBmsDriver final : public Device, public RegisterFace {
 public:
  /// Throws std::runtime_error when the map asks for nothing.
  ModbusBmsDriver(const Settings& settings, const RegisterMap& map);

  std::span<const RegisterBlock> blocks() const override { return blocks_; }
  void on_registers(std::size_t block, std::span<const std::uint16_t> words, Time received,
                    DriverOut& out) override;
  void on_failure(std::size_t block, RegisterFailure failure, int exception, Time now) override;
  void on_link_up(Time now) override;
  void on_tick(Time, DriverOut&) override {}
  SourceHealth health(Time now) const override;
  Reason words(const Measurement& reported) const override;

 private:
  void complete(Time received, DriverOut& out);
  void judge_charger(BatterySample& sample, Time received);
  void compare_directions(const BatterySample& sample);

  Settings settings_;
  RegisterMap map_;
  bool tells_flow_;  ///< the map has a register for it
  std::vector<RegisterBlock> blocks_;
  std::vector<std::uint16_t> words_;
  std::vector<Run> runs_;
  std::size_t next_block_ = 0;  ///< whose answer the round waits for
  Time last_good_ = kNever;
  std::uint64_t good_ = 0;
  std::uint64_t bad_ = 0;
  int failed_rounds_ = 0;  ///< without a good one between
  Reason failure_;
  Reason oddity_;  ///< of the last good round
  int contradictions_ = 0;
  Time charging_since_ = kNever;
};

}  // namespace drover::modbus_bms
