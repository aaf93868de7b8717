#include "gateway/can_condition.h"

#include <linux/can.h>
#include <linux/can/error.h>

namespace drover::gateway {
namespace {

// Newer than some headers: data[6] and data[7] hold the error counters.
constexpr std::uint32_t kCountersClass = 0x200;
constexpr std::uint32_t kBusErrors = CAN_ERR_PROT | CAN_ERR_BUSERROR | CAN_ERR_ACK;
// Errors and no frame for so long: not a plug that was just pushed in.
constexpr Duration kOnlyErrors = std::chrono::seconds(1);

}  // namespace

void CanCondition::enter(State state) {
  state_ = state;
  counted_ = false;
}

void CanCondition::on_error_frame(const CanFrame& frame, Time received) {
  if ((frame.id & kBusErrors) != 0) {
    if (last_error_ == kNever || last_frame_ > last_error_) errors_since_ = received;
    last_error_ = received;
  }
  if ((frame.id & CAN_ERR_RESTARTED) != 0) enter(State::active);
  if ((frame.id & CAN_ERR_CRTL) != 0) {
    const unsigned what = frame.data[1];
    if ((what & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) != 0) {
      enter(State::passive);
    } else if ((what & (CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING)) != 0) {
      enter(State::warning);
    } else if ((what & CAN_ERR_CRTL_ACTIVE) != 0) {
      enter(State::active);
    }
  }
  if ((frame.id & CAN_ERR_BUSOFF) != 0) enter(State::off);
  if ((frame.id & kCountersClass) != 0) {
    counted_ = true;
    transmit_errors_ = frame.data[6];
    receive_errors_ = frame.data[7];
  }
}

[[gnu::hot]] void CanCondition::on_frame(Time received) {
  last_frame_ = received;
  if (state_ == State::off) enter(State::active);
}

Reason CanCondition::text(std::string_view bus, Time now) const {
  Reason out;
  const auto tell = [&](const char* what, const char* advice) {
    Name counts;
    if (counted_)
      counts.format(" (errors: %u sending, %u receiving)", transmit_errors_, receive_errors_);
    out.format("%.*s %s%.*s: %s", static_cast<int>(bus.size()), bus.data(), what,
               static_cast<int>(counts.view().size()), counts.view().data(), advice);
  };
  switch (state_) {
    case State::off:
      tell("is bus-off", "look at wiring, termination and bit rate, then set it down and up");
      break;
    case State::passive:
      tell("is error-passive", "wiring, termination, or drives without power");
      break;
    case State::warning: tell("has many errors", "wiring or termination"); break;
    case State::active: {
      const bool only_errors = last_error_ != kNever && last_error_ > last_frame_ &&
                               last_error_ - errors_since_ >= kOnlyErrors &&
                               now - last_error_ < kOnlyErrors;
      if (only_errors) tell("hears only errors", "is the bit rate right?");
      break;
    }
  }
  return out;
}

}  // namespace drover::gateway
