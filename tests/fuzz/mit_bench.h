// A driver of a motor in MIT mode under any frames, requests, set points and gaps. What must hold:
// at rest nothing moves it, what it sends is on its own list and not forbidden, and it is enabled
// only while it is asked to run.
#pragma once

#include <array>
#include <cstdlib>

#include "drivers/mit/frame.h"
#include "tests/fuzz/drive_actuator.h"

namespace drover::fuzz {

inline double mit_value(std::uint8_t byte) {
  return byte == 0xFF ? kAbsent : (byte - 127) * 0.5;
}

inline Setpoint read_mit_setpoint(Input& input, std::uint8_t what) {
  Setpoint setpoint;
  setpoint.request = static_cast<AxisRequest>(what % 4);
  setpoint.velocity_radps = mit_value(input.byte());
  setpoint.impedance = {mit_value(input.byte()), mit_value(input.byte()), mit_value(input.byte()),
                        mit_value(input.byte())};
  return setpoint;
}

/// `driver` is of the motor with id 1.
template <class Driver>
void judge_mit(const Driver& driver, const Setpoint& setpoint, Time now, const DriverOut& out) {
  if (out.overflows != 0 || out.frames.size() > driver.messages_per_cycle()) std::abort();
  for (const CanFrame& frame : out.frames) {
    const FrameEffect effect = driver.effect(frame, now).kind;
    if (!on_list(driver, frame) || effect == FrameEffect::forbidden) std::abort();
    const bool runs = setpoint.request == AxisRequest::run || setpoint.request == AxisRequest::hold;
    const bool enables = mit::decode_special(frame, 1) == mit::Special::enable;
    if (!runs && (effect == FrameEffect::motion || enables)) std::abort();
  }
}

template <class Driver>
void drive_mit(Driver& driver, const std::array<std::uint32_t, 4>& ids, Input& input) {
  drive_actuator(driver, ids, input, read_mit_setpoint, judge_mit<Driver>);
}

}  // namespace drover::fuzz
