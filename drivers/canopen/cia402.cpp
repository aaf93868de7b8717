#include "drivers/canopen/cia402.h"

namespace drover::canopen {
namespace {

struct Row {
  std::uint16_t mask;
  std::uint16_t value;
  DriveState state;
  std::string_view text;
};

constexpr Row kRows[] = {
    {0x4F, 0x00, DriveState::not_ready, "not ready to switch on"},
    {0x4F, 0x40, DriveState::switch_on_disabled, "switch on disabled"},
    {0x6F, 0x21, DriveState::ready_to_switch_on, "ready to switch on"},
    {0x6F, 0x23, DriveState::switched_on, "switched on"},
    {0x6F, 0x27, DriveState::operation_enabled, "operation enabled"},
    {0x6F, 0x07, DriveState::quick_stop_active, "quick stop active"},
    {0x4F, 0x0F, DriveState::fault_reaction, "fault reaction active"},
    {0x4F, 0x08, DriveState::fault, "fault"},
};

std::uint16_t towards_enabled(DriveState state) {
  switch (state) {
    case DriveState::switch_on_disabled: return kShutdown;
    case DriveState::ready_to_switch_on: return kSwitchOn;
    case DriveState::switched_on:
    case DriveState::operation_enabled:
    // Only where the drive stays in this state after a quick stop (605A from 5 on); it is let go
    // from there by a person's start, which ends here.
    case DriveState::quick_stop_active: return kEnableOperation;
    case DriveState::not_ready:
    case DriveState::fault_reaction:
    case DriveState::fault:
    case DriveState::unknown: break;
  }
  return kDisableVoltage;
}

}  // namespace

DriveState drive_state(std::uint16_t statusword) {
  for (const Row& row : kRows)
    if ((statusword & row.mask) == row.value) return row.state;
  return DriveState::unknown;
}

std::string_view text(DriveState state) {
  for (const Row& row : kRows)
    if (row.state == state) return row.text;
  return "no state of CiA 402";
}

bool is_powered(DriveState state) {
  return state == DriveState::operation_enabled || state == DriveState::quick_stop_active ||
         state == DriveState::fault_reaction;
}

std::uint16_t next_controlword(DriveGoal goal, DriveState state, std::uint16_t last,
                               bool reset_fault) {
  if (state == DriveState::fault) {
    if (!reset_fault || goal != DriveGoal::enabled) return kDisableVoltage;
    return (last & kFaultReset) != 0 ? kDisableVoltage : kFaultReset;
  }
  switch (goal) {
    case DriveGoal::enabled: return towards_enabled(state);
    case DriveGoal::quick_stop: return is_powered(state) ? kQuickStop : kDisableVoltage;
    case DriveGoal::off: break;
  }
  return kDisableVoltage;
}

}  // namespace drover::canopen
