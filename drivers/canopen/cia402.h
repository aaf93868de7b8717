// The state machine of drives: what a statusword says, and which controlword comes next.
// Source: CiA 402-2 (IEC 61800-7-201), sections 10.4 to 10.6.
#pragma once

#include <cstdint>
#include <string_view>

#include "drivers/canopen/sdo.h"

namespace drover::canopen {

// Objects of a drive's first axis; the next axes of one node have theirs 0x800 higher each.
inline constexpr std::uint16_t kErrorCode = 0x603F;
inline constexpr std::uint16_t kControlword = 0x6040;
inline constexpr std::uint16_t kStatusword = 0x6041;
inline constexpr std::uint16_t kQuickStopOption = 0x605A;
inline constexpr std::uint16_t kMode = 0x6060;
inline constexpr std::uint16_t kModeDisplay = 0x6061;
inline constexpr std::uint16_t kPositionActual = 0x6064;
inline constexpr std::uint16_t kVelocityActual = 0x606C;
inline constexpr std::uint16_t kTorqueActual = 0x6077;
inline constexpr std::uint16_t kTargetVelocity = 0x60FF;

enum class DriveState : std::uint8_t {
  not_ready,           ///< it starts
  switch_on_disabled,  ///< idle
  ready_to_switch_on,
  switched_on,
  operation_enabled,  ///< obeys set points
  quick_stop_active,  ///< stops, or holds after a quick stop
  fault_reaction,     ///< stops because of a fault
  fault,
  unknown,  ///< no statusword of CiA 402
};

DriveState drive_state(std::uint16_t statusword);
/// As CiA 402 calls it.
std::string_view text(DriveState state);

/// Whether the power stage is on, so that the motor drives, brakes or holds.
bool is_powered(DriveState state);

/// Where a drive shall go. An ordinary stop is a set point of zero while it is enabled.
enum class DriveGoal : std::uint8_t {
  enabled,     ///< operation enabled
  off,         ///< power stage off: it may coast
  quick_stop,  ///< stops as object 605A says
};

inline constexpr std::uint16_t kDisableVoltage = 0x00;
inline constexpr std::uint16_t kQuickStop = 0x02;
inline constexpr std::uint16_t kShutdown = 0x06;
inline constexpr std::uint16_t kSwitchOn = 0x07;
inline constexpr std::uint16_t kEnableOperation = 0x0F;
inline constexpr std::uint16_t kFaultReset = 0x80;

/// The controlword that brings a drive in `state` one transition nearer; to be sent until the
/// statusword tells the next state. `last` is the controlword before: a fault is reset by an edge
/// of bit 7, so it is 0 once before each reset. Whether a fault may be reset at all is for the
/// caller to know; without `reset_fault` the drive is left in it.
std::uint16_t next_controlword(DriveGoal goal, DriveState state, std::uint16_t last,
                               bool reset_fault);

}  // namespace drover::canopen
