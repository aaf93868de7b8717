// What drivers of motor drives share.
#pragma once

#include <cstdint>
#include <string_view>
#include <variant>

#include "drover/actuator.h"
#include "drover/driver.h"
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
  out.report(received, received, value);
}

/// A status with its words: decoded, empty when there is no error.
struct StatusInWords : AxisStatus {
  Reason reason;
};

/// A status is told when it changed, and whenever it is asked for. Its words stay here until the
/// next one is told.
class ToldStatus final {
 public:
  /// True when this one is to be told now; of whose axis it is does not count.
  bool is_due(const StatusInWords& current, bool always);
  /// For Device::words, of a device that tells one status, of all its axes.
  Reason words(const Measurement& reported) const {
    return std::holds_alternative<AxisStatus>(reported.value) ? told_.reason : Reason();
  }

 private:
  StatusInWords told_;
  bool told_once_ = false;
};

/// What is missing: "no status (181) for 0.31 s", or "... since the link came up".
Reason silent_text(std::string_view what, Time last, Time now);
/// The same for a status, which is told when its text changes: "no status (181) for more than 0.3
/// s".
Reason silent_text(std::string_view what, Duration limit);
/// "lost: why", or the one of them that there is.
Reason joined(const Reason& lost, const Reason& why);

/// What was heard of a device, whatever it said.
struct Heard {
  Time last_good = kNever;
  Time last_alive = kNever;  ///< since the link came up: of what tells that it is there
  std::uint64_t good = 0;
  std::uint64_t bad = 0;

  /// Fresh, for all that is known here: whether the device says enough its driver knows. `never`
  /// and `what` ("no heartbeat") are for the reason while it is not.
  SourceHealth health(Time now, std::string_view never, std::string_view what,
                      Duration limit) const;
};
/// It talks, and does not say enough.
SourceHealth stale(SourceHealth health, const Reason& reason);

/// The guard knows nothing but the recipe. Whoever sends anything else fights with this gateway,
/// though it is a stop: one that lets go lets the robot roll.
bool is_of_recipe(const CanFrame& frame, const StopRecipe& recipe);

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
