// A simulated CANopen node: its dictionary, its service channel, process data mapped as it is told,
// its heartbeat. What its objects do is for the twin that has one.
#pragma once

#include <array>

#include "drivers/canopen/nmt.h"
#include "drivers/canopen/sdo.h"
#include "drover/time.h"
#include "drover/twin.h"

namespace drover::canopen {

struct TwinObject {
  Object object;
  SdoNumber value;
  bool read_only = false;
};

/// Each way.
inline constexpr std::uint16_t kPdos = 4;

class TwinNode final {
 public:
  /// What was written by one frame, in its order.
  using Writes = FixedVector<TwinObject, 8>;

  explicit TwinNode(std::uint8_t node) : node_(node) {}

  /// With the objects of four PDOs each way, all of them off, and what 1016 and 1017 ask for off.
  void boot(std::span<const TwinObject> objects, Time now, TwinFrames& out);
  /// False: a command of network management asks for a new start.
  bool on_frame(const CanFrame& frame, Time now, Writes& writes, TwinFrames& out);
  void on_tick(Time now, TwinFrames& out);
  std::uint32_t value(Object object) const;
  void set(Object object, std::uint32_t bits);
  NodeState state() const { return state_; }
  /// Once after each loss: the one that it watches (1016) was heard, and is no more.
  bool lost_its_master(Time now);

 private:
  const TwinObject* find(Object object) const;
  void on_sdo(const CanFrame& frame, Writes& writes, TwinFrames& out);
  void on_pdo(std::uint16_t number, const CanFrame& frame, Writes& writes);
  void send_pdo(std::uint16_t number, TwinFrames& out) const;

  std::uint8_t node_;
  NodeState state_ = NodeState::boot_up;
  FixedVector<TwinObject, 128> objects_;
  std::array<Time, kPdos> next_pdo_{};
  Time next_heartbeat_ = kNever;
  Time master_heard_ = kNever;
};

}  // namespace drover::canopen
