#include "drivers/cubemars_mit/codec.h"

#include <algorithm>
#include <cmath>

namespace drover::cubemars_mit {
namespace {

constexpr std::uint8_t kShort = 6;
constexpr std::uint8_t kLong = 8;

}  // namespace

std::string_view error_text(std::uint8_t error) {
  switch (static_cast<MotorError>(error)) {
    case MotorError::over_temperature: return "over temperature";
    case MotorError::over_current: return "over current";
    case MotorError::over_voltage: return "supply over voltage";
    case MotorError::under_voltage: return "supply under voltage";
    case MotorError::encoder: return "encoder";
    case MotorError::phase_imbalance: return "phases out of balance";
    default: return {};
  }
}

std::optional<Feedback> decode_feedback(const CanFrame& frame, std::uint8_t id,
                                        const Ranges& ranges) {
  if (!frame.is_plain() || (frame.len != kShort && frame.len != kLong) || frame.data[0] != id)
    return std::nullopt;
  Feedback feedback;
  feedback.motion = mit::decode_motion(frame.payload().subspan<1, mit::kMotionBytes>(), ranges);
  if (frame.len == kLong) {
    feedback.degC = static_cast<std::int8_t>(frame.data[6]);
    feedback.error = frame.data[7];
  }
  return feedback;
}

CanFrame encode_feedback(std::uint32_t master_id, std::uint8_t id, const Feedback& feedback,
                         const Ranges& ranges) {
  const double degC = std::isfinite(feedback.degC) ? std::clamp(feedback.degC, -128.0, 127.0) : 0;
  CanFrame frame = make_frame(
      master_id, {id, 0, 0, 0, 0, 0, static_cast<std::uint8_t>(static_cast<std::int8_t>(degC)),
                  feedback.error});
  mit::encode_motion(feedback.motion, ranges,
                     std::span(frame.data).subspan<1, mit::kMotionBytes>());
  return frame;
}

}  // namespace drover::cubemars_mit
