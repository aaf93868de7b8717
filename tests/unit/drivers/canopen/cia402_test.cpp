#include "drivers/canopen/cia402.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace drover::canopen {
namespace {

// Words of drives, as traces and manuals show them.
TEST(Cia402, KnowsTheStateByTheStatusword) {
  const std::pair<std::uint16_t, DriveState> kWords[] = {
      {0x0000, DriveState::not_ready},
      {0x0250, DriveState::switch_on_disabled},
      {0x0240, DriveState::switch_on_disabled},
      {0x0640, DriveState::switch_on_disabled},
      {0x0231, DriveState::ready_to_switch_on},
      {0x0233, DriveState::switched_on},
      {0x0237, DriveState::operation_enabled},
      {0x1637, DriveState::operation_enabled},
      {0x0217, DriveState::quick_stop_active},
      {0x0207, DriveState::quick_stop_active},
      {0x1617, DriveState::quick_stop_active},
      {0x021F, DriveState::fault_reaction},
      {0x0218, DriveState::fault},
      {0x0238, DriveState::fault},
  };
  for (const auto& [word, state] : kWords) EXPECT_EQ(drive_state(word), state) << std::hex << word;
  EXPECT_EQ(drive_state(0x0002), DriveState::unknown);
}

/// A drive that makes one transition for each controlword, as CiA 402 draws them.
struct Machine {
  DriveState state = DriveState::switch_on_disabled;
  std::uint16_t last = 0;

  void on_controlword(std::uint16_t word) {
    const bool edge = (word & 0x80U) != 0 && (last & 0x80U) == 0;
    last = word;
    if (state == DriveState::fault) {
      if (edge) state = DriveState::switch_on_disabled;
      return;
    }
    if ((word & 0x02U) == 0) {  // disable voltage
      state = DriveState::switch_on_disabled;
    } else if ((word & 0x04U) == 0) {  // quick stop
      if (state == DriveState::operation_enabled) state = DriveState::quick_stop_active;
    } else if (state == DriveState::switch_on_disabled && (word & 0x07U) == 0x06) {
      state = DriveState::ready_to_switch_on;
    } else if (state == DriveState::ready_to_switch_on && (word & 0x0FU) == 0x07) {
      state = DriveState::switched_on;
    } else if ((word & 0x0FU) == 0x0F &&
               (state == DriveState::switched_on || state == DriveState::quick_stop_active)) {
      state = DriveState::operation_enabled;
    }
  }
};

std::vector<DriveState> way(DriveState from, DriveGoal goal, bool reset_fault) {
  Machine machine{from, 0};
  std::vector<DriveState> states;
  std::uint16_t last = 0;
  for (int i = 0; i < 8; ++i) {
    last = next_controlword(goal, machine.state, last, reset_fault);
    machine.on_controlword(last);
    if (states.empty() || states.back() != machine.state) states.push_back(machine.state);
  }
  return states;
}

TEST(Cia402, ComesToOperationOneTransitionAfterAnother) {
  EXPECT_EQ(way(DriveState::switch_on_disabled, DriveGoal::enabled, false),
            (std::vector{DriveState::ready_to_switch_on, DriveState::switched_on,
                         DriveState::operation_enabled}));
}

TEST(Cia402, LeavesAFaultOnlyWhenItMay) {
  EXPECT_EQ(way(DriveState::fault, DriveGoal::enabled, false), std::vector{DriveState::fault});
  EXPECT_EQ(way(DriveState::fault, DriveGoal::enabled, true).back(), DriveState::operation_enabled);
  EXPECT_EQ(way(DriveState::fault, DriveGoal::off, true), std::vector{DriveState::fault});
}

TEST(Cia402, ResetsAFaultByAnEdgeThatItMakesAgain) {
  std::uint16_t last = kFaultReset;
  last = next_controlword(DriveGoal::enabled, DriveState::fault, last, true);
  EXPECT_EQ(last, kDisableVoltage) << "bit 7 was there already";
  EXPECT_EQ(next_controlword(DriveGoal::enabled, DriveState::fault, last, true), kFaultReset);
}

TEST(Cia402, StopsQuicklyOnlyWhatRuns) {
  EXPECT_EQ(way(DriveState::operation_enabled, DriveGoal::quick_stop, false),
            std::vector{DriveState::quick_stop_active});
  EXPECT_EQ(way(DriveState::switched_on, DriveGoal::quick_stop, false),
            std::vector{DriveState::switch_on_disabled});
}

TEST(Cia402, SwitchesOffFromEachState) {
  for (const auto state : {DriveState::ready_to_switch_on, DriveState::switched_on,
                           DriveState::operation_enabled, DriveState::quick_stop_active})
    EXPECT_EQ(way(state, DriveGoal::off, false), std::vector{DriveState::switch_on_disabled});
}

TEST(Cia402, NeverEnablesADriveWhoseStateItDoesNotKnow) {
  for (const auto state : {DriveState::not_ready, DriveState::fault_reaction, DriveState::unknown})
    EXPECT_EQ(next_controlword(DriveGoal::enabled, state, 0, true), kDisableVoltage);
}

TEST(Cia402, NamesEachState) {
  EXPECT_EQ(text(DriveState::operation_enabled), "operation enabled");
  EXPECT_EQ(text(DriveState::unknown), "no state of CiA 402");
}

}  // namespace
}  // namespace drover::canopen
