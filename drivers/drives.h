// What drivers of motor drives share.
#pragma once

#include <cstdint>

#include "drover/actuator.h"
#include "drover/driver_out.h"
#include "drover/fixed_text.h"
#include "drover/measurement.h"
#include "drover/time.h"

namespace drover {

/// Whether the drive has to be in closed loop for it.
constexpr bool arms(AxisRequest request) {
  return request == AxisRequest::run || request == AxisRequest::hold;
}

/// What a device that stamps nothing said: of the instant in which it came.
template <class T>
void report_heard(const T& value, Time received, DriverOut& out) {
  Measurement m;
  m.time = received;
  m.received = received;
  m.value = value;
  out.report(m);
}

/// A status is told when it changed, and whenever it is asked for.
class ToldStatus final {
 public:
  /// True when this one is to be told now; of whose axis it is does not count.
  bool is_due(const AxisStatus& current, bool always);

 private:
  AxisStatus told_;
  bool told_once_ = false;
};

/// Somebody else's command to the drive, remembered for as long as it is shown.
class ForeignCommand final {
 public:
  void on_frame(std::uint32_t id, Time received) {
    id_ = id;
    at_ = received;
  }
  bool is_shown(Time now) const;
  /// For operators, with the id of the frame.
  Reason text() const;

 private:
  std::uint32_t id_ = 0;
  Time at_ = kNever;
};

}  // namespace drover
