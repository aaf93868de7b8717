// What a CubeMars motor in MIT mode answers: pure functions, total over any frame. What is sent to
// it stands in drivers/mit/frame.h.
//
// Source: CubeMars' AK Series Actuator Driver Manual V1.0.8, chapter 5.3, as neurobionics/
// TMotorCANControl (mit_can.py) reads it; bgkatz/motorcontrol, the firmware that the mode is from.
#pragma once

#include <string_view>

#include "drivers/mit/frame.h"
#include "drover/measurement.h"

namespace drover::cubemars_mit {

using mit::encode_special;
using mit::Ranges;
using mit::Special;

/// The last byte of an answer. That it is not enabled is none of them: it never says so.
enum class MotorError : std::uint8_t {
  none = 0,
  over_temperature = 1,
  over_current = 2,
  over_voltage = 3,
  under_voltage = 4,
  encoder = 5,
  phase_imbalance = 6,
};

struct Feedback {
  mit::Motion motion;
  double degC = kAbsent;   ///< of six bytes: not told, as the error
  std::uint8_t error = 0;  ///< a MotorError, or what nobody has documented

  bool failed() const { return error != 0; }
};

/// For operators; empty: not documented.
std::string_view error_text(std::uint8_t error);

/// Of six or eight bytes, by its first byte this motor's; which id it came under the caller knows.
std::optional<Feedback> decode_feedback(const CanFrame& frame, std::uint8_t id,
                                        const Ranges& ranges);
/// Eight bytes, as the twin sends them.
CanFrame encode_feedback(std::uint32_t master_id, std::uint8_t id, const Feedback& feedback,
                         const Ranges& ranges);

}  // namespace drover::cubemars_mit
