// Texts of the drives' error bits. The two firmware families share no meanings.
#pragma once

#include <cstdint>
#include <string_view>

#include "drivers/odrive/codec.h"
#include "drover/fixed_text.h"

namespace drover::odrive {

/// Everything that the drive has said about why it does not run.
struct ErrorReport {
  std::uint32_t axis = 0;           ///< of the heartbeat; 0.6: active errors
  std::uint32_t disarm_reason = 0;  ///< 0.6
  std::uint64_t motor = 0;          ///< 0.5, as the two below
  std::uint32_t encoder = 0;
  std::uint32_t controller = 0;
};

/// "motor over temperature; watchdog expired", empty when nothing is set. Bits without a name are
/// given as a number. Source: ODrive firmware 0.5.6 and 0.6 error enumerations.
Reason error_text(const ErrorReport& report, Firmware firmware);
/// Whether the drive is sound and only went without set points or supply: its watchdog ran out, or
/// the bus voltage fell. False when no error is set.
bool only_lapsed(const ErrorReport& report, Firmware firmware);
/// Why a requested state was not reached, firmware 0.6; empty for success and busy.
std::string_view procedure_text(std::uint8_t procedure_result);

}  // namespace drover::odrive
