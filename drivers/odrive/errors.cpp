// Error bits to words, from the enumerations of ODrive firmware 0.5.6 and 0.6.
#include "drivers/odrive/errors.h"

#include <span>
#include <string_view>

namespace drover::odrive {
namespace {

struct Bit {
  std::uint64_t mask;
  std::string_view text;
};

constexpr Bit kAxis_0_5[] = {
    {0x1, "state not allowed now (not calibrated?)"},
    {0x2, "bus under voltage"},
    {0x40, "motor failed"},
    {0x80, "sensorless estimator failed"},
    {0x100, "encoder failed"},
    {0x200, "controller failed"},
    {0x800, "watchdog expired"},
    {0x1000, "lower end stop pressed"},
    {0x2000, "upper end stop pressed"},
    {0x4000, "emergency stop requested"},
    {0x20000, "homing without end stop"},
    {0x40000, "over temperature"},
    {0x80000, "unknown position"},
};
constexpr Bit kMotor_0_5[] = {
    {0x1, "phase resistance out of range"},
    {0x2, "phase inductance out of range"},
    {0x8, "gate driver fault"},
    {0x10, "control deadline missed"},
    {0x80, "modulation too large"},
    {0x400, "current sense saturated"},
    {0x1000, "current limit violated"},
    {0x10000, "modulation not a number"},
    {0x20000, "motor over temperature"},
    {0x40000, "inverter over temperature"},
    {0x80000, "timer update missed"},
    {0x100000, "no current measurement"},
    {0x200000, "current controller failed"},
    {0x400000, "bus current out of range"},
    {0x800000, "brake resistor disarmed"},
    {0x1000000, "system-level error"},
    {0x2000000, "bad timing"},
    {0x4000000, "unknown phase"},
    {0x8000000, "unknown phase velocity"},
    {0x10000000, "unknown torque"},
    {0x20000000, "unknown current command"},
    {0x40000000, "unknown current"},
    {0x80000000, "unknown bus voltage"},
    {0x100000000, "unknown voltage command"},
    {0x200000000, "unknown gains"},
    {0x400000000, "controller initializing"},
    {0x800000000, "unbalanced phases"},
};
constexpr Bit kEncoder_0_5[] = {
    {0x1, "encoder gain unstable"},    {0x2, "encoder resolution and pole pairs disagree"},
    {0x4, "encoder does not respond"}, {0x8, "encoder mode unsupported"},
    {0x10, "illegal Hall state"},      {0x20, "encoder index not found yet"},
    {0x40, "encoder SPI time-out"},    {0x80, "encoder SPI broken"},
    {0x100, "encoder SPI not ready"},  {0x200, "Hall sensors not calibrated"},
};
constexpr Bit kController_0_5[] = {
    {0x1, "overspeed"},
    {0x2, "invalid input mode"},
    {0x4, "controller gain unstable"},
    {0x8, "invalid mirror axis"},
    {0x10, "invalid load encoder"},
    {0x20, "invalid estimate"},
    {0x40, "invalid circular range"},
    {0x80, "spinout"},
};
constexpr Bit kDrive_0_6[] = {
    {0x1, "initializing"},
    {0x2, "system-level error"},
    {0x4, "timing error"},
    {0x8, "missing estimate (encoder?)"},
    {0x10, "bad configuration"},
    {0x20, "gate driver fault"},
    {0x40, "missing input"},
    {0x100, "bus over voltage"},
    {0x200, "bus under voltage"},
    {0x400, "bus over current"},
    {0x800, "bus over regeneration current"},
    {0x1000, "current limit violated"},
    {0x2000, "motor over temperature"},
    {0x4000, "inverter over temperature"},
    {0x8000, "velocity limit violated"},
    {0x10000, "position limit violated"},
    {0x1000000, "watchdog expired"},
    {0x2000000, "emergency stop requested"},
    {0x4000000, "spinout"},
    {0x8000000, "brake resistor disarmed"},
    {0x10000000, "thermistor disconnected"},
    {0x40000000, "calibration error"},
};

class Text {
 public:
  void append(std::string_view part) {
    if (reason_.empty()) {
      reason_.assign(part);
    } else {
      const Reason before = reason_;
      const auto a = before.view();
      reason_.format("%.*s; %.*s", static_cast<int>(a.size()), a.data(),
                     static_cast<int>(part.size()), part.data());
    }
  }
  void append_bits(std::uint64_t bits, std::span<const Bit> table, const char* source) {
    for (const Bit& bit : table) {
      if ((bits & bit.mask) == 0) continue;
      append(bit.text);
      bits &= ~bit.mask;
    }
    if (bits == 0) return;
    FixedText<48> unnamed;
    unnamed.format("%s 0x%llx", source, static_cast<unsigned long long>(bits));
    append(unnamed);
  }
  const Reason& reason() const { return reason_; }

 private:
  Reason reason_;
};

}  // namespace

bool only_lapsed(const ErrorReport& report, Firmware firmware) {
  constexpr std::uint32_t kLapses_0_6 = 0x1000000 | 0x200;
  constexpr std::uint32_t kLapses_0_5 = 0x800 | 0x2;  // 2: bus under voltage
  const std::uint32_t lapses = firmware == Firmware::v0_6 ? kLapses_0_6 : kLapses_0_5;
  const bool more = report.motor != 0 || report.encoder != 0 || report.controller != 0;
  return report.axis != 0 && (report.axis & ~lapses) == 0 && !more;
}

Reason error_text(const ErrorReport& report, Firmware firmware) {
  Text text;
  if (firmware == Firmware::v0_6) {
    // The reason of the last disarming stays after the error itself is gone.
    text.append_bits(report.axis | report.disarm_reason, kDrive_0_6, "error");
    return text.reason();
  }
  text.append_bits(report.axis, kAxis_0_5, "axis error");
  text.append_bits(report.motor, kMotor_0_5, "motor error");
  text.append_bits(report.encoder, kEncoder_0_5, "encoder error");
  text.append_bits(report.controller, kController_0_5, "controller error");
  return text.reason();
}

std::string_view procedure_text(std::uint8_t procedure_result) {
  constexpr std::string_view kTexts[] = {
      "",
      "",
      "cancelled",
      "disarmed",
      "no response",
      "pole pairs and encoder resolution disagree",
      "phase resistance out of range",
      "phase inductance out of range",
      "unbalanced phases",
      "invalid motor type",
      "illegal Hall state",
      "time-out",
      "homing without end stop",
      "state not allowed now",
      "not calibrated",
      "calibration does not converge",
  };
  if (procedure_result < std::size(kTexts)) return kTexts[procedure_result];
  return "unknown procedure result";
}

}  // namespace drover::odrive
