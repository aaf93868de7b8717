// A simulated battery's registers, laid out by the same map that the driver reads by.
#pragma once

#include <map>

#include "drivers/modbus_bms/codec.h"
#include "drover/options.h"
#include "drover/twin.h"

namespace drover::modbus_bms {

class ModbusBmsTwin final : public RegisterTwin {
 public:
  ModbusBmsTwin(const Options& options, const RegisterMap& map);

  void set_truth(const BatteryTruth& truth) override;
  bool read(std::uint8_t function, std::uint16_t address,
            std::span<std::uint16_t> words) const override;

 private:
  double value_of(const RegisterField& field, const BatteryTruth& truth) const;
  void put(const RegisterField& field, std::uint32_t index, double raw);
  std::uint16_t& at(std::uint8_t function, std::uint32_t address);

  RegisterMap map_;
  std::uint16_t cells_;
  std::uint16_t probes_;
  /// By function, then address; holes between the map's blocks read as 0, as devices do.
  std::map<std::uint8_t, std::map<std::uint16_t, std::uint16_t>> registers_;
};

}  // namespace drover::modbus_bms
