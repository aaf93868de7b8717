// The second gate: which frames may leave on which bus.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "drover/driver.h"
#include "drover/fixed_vector.h"
#include "drover/measurement.h"

namespace drover::engine {

enum class FrameVerdict : std::uint8_t {
  pass,
  refused_not_allowed,  ///< not on the sender's list for this bus, or a forbidden effect
  refused_motion,       ///< may move an axis while nothing may, or while the guard has the bus
};

/// The one motion that needs no owner: a wheel that rolls is brought to rest.
struct Slowing {
  bool permitted = false;
  double measured_radps = 0;  ///< of the joint, fresh
};

/// Built once from the allow-lists of the drivers; refuses all else. Pure but for its counts.
class FrameGate final {
 public:
  static constexpr std::size_t kMaxBuses = 8;

  /// At start-up. `driver` must outlive the gate. Throws std::runtime_error when there are too many
  /// drivers or buses, or when two drivers of one bus would send the same frame.
  void add(std::size_t bus, const Actuator& driver);

  /// `motion_permitted`: EngineOutput::motion_permitted of this cycle.
  /// `slowing`: of the sender's axis. Then a set point passes that is no faster than the wheel, in
  /// its direction, and no faster than the one before.
  FrameVerdict admit(std::size_t bus, const CanFrame& frame, const Actuator& from,
                     bool motion_permitted, bool guard_has_bus, const Slowing& slowing = {});

  /// The next ramp of this drive begins anew.
  void end_slowing(const Actuator& driver);

  struct Counts {
    std::uint64_t passed = 0;
    std::uint64_t not_allowed = 0;
    std::uint64_t motion = 0;
  };
  /// Of one bus; what was asked of a bus that does not exist is counted on none.
  const Counts& counts(std::size_t bus) const { return counts_.at(bus); }

 private:
  struct Sender {
    std::size_t bus = 0;
    const Actuator* driver = nullptr;
    /// Of its last set point while slowing; infinite before the first.
    double slowest_radps = std::numeric_limits<double>::infinity();
  };
  FrameVerdict judge(std::size_t bus, const CanFrame& frame, const Actuator& from,
                     bool motion_possible, const Slowing& slowing);
  static bool slows(Sender& sender, const CanFrame& frame, const Slowing& slowing);

  FixedVector<Sender, kMaxAxes> senders_;
  std::array<Counts, kMaxBuses> counts_{};
};

/// Whether a frame is what a rule describes: id, kind and length.
bool matches(const FrameRule& rule, const CanFrame& frame);

}  // namespace drover::engine
