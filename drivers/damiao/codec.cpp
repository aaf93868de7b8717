#include "drivers/damiao/codec.h"

#include <algorithm>
#include <bit>

#include "drover/bytes.h"

namespace drover::damiao {

bool Feedback::failed() const {
  return status >= static_cast<std::uint8_t>(MotorStatus::over_voltage) &&
         status <= static_cast<std::uint8_t>(MotorStatus::overload);
}

float RegisterReply::as_float() const {
  return std::bit_cast<float>(raw);
}

CanFrame encode_read(std::uint8_t id, std::uint8_t rid) {
  return make_frame(kRequestId, {id, 0, static_cast<std::uint8_t>(Verb::read), rid, 0, 0, 0, 0});
}

CanFrame encode_write(std::uint8_t id, std::uint8_t rid, std::uint32_t raw) {
  CanFrame frame =
      make_frame(kRequestId, {id, 0, static_cast<std::uint8_t>(Verb::write), rid, 0, 0, 0, 0});
  store_le(frame.data, 4, raw);
  return frame;
}

CanFrame encode_request(std::uint8_t id) {
  return make_frame(kRequestId, {id, 0, static_cast<std::uint8_t>(Verb::feedback), 0, 0, 0, 0, 0});
}

std::optional<RegisterReply> decode_reply(const CanFrame& frame, std::uint8_t id) {
  if (!frame.is_plain() || frame.len != 8 || frame.data[0] != id || frame.data[1] != 0)
    return std::nullopt;
  RegisterReply reply;
  switch (frame.data[2]) {
    case static_cast<std::uint8_t>(Verb::read): reply.verb = Verb::read; break;
    case static_cast<std::uint8_t>(Verb::write): reply.verb = Verb::write; break;
    case static_cast<std::uint8_t>(Verb::store): reply.verb = Verb::store; break;
    default: return std::nullopt;
  }
  reply.rid = frame.data[3];
  reply.raw = load_le<std::uint32_t>(frame.data, 4);
  if (reply.rid > reg::kLast) return std::nullopt;
  return reply;
}

std::optional<Feedback> decode_feedback(const CanFrame& frame, std::uint8_t id,
                                        const Ranges& ranges) {
  if (!frame.is_plain() || frame.len != 8 || (frame.data[0] & 0xFU) != id) return std::nullopt;
  Feedback feedback;
  feedback.status = frame.data[0] >> 4U;
  feedback.motion = mit::decode_motion(frame.payload().subspan<1, mit::kMotionBytes>(), ranges);
  feedback.mos_degC = frame.data[6];
  feedback.rotor_degC = frame.data[7];
  return feedback;
}

CanFrame encode_feedback(std::uint32_t master_id, std::uint8_t id, const Feedback& feedback,
                         const Ranges& ranges) {
  const auto degrees = [](double degC) {
    return static_cast<std::uint8_t>(std::clamp(degC, 0.0, 255.0));
  };
  CanFrame frame =
      make_frame(master_id, {static_cast<std::uint8_t>(feedback.status << 4U | (id & 0xFU)), 0, 0,
                             0, 0, 0, degrees(feedback.mos_degC), degrees(feedback.rotor_degC)});
  mit::encode_motion(feedback.motion, ranges,
                     std::span(frame.data).subspan<1, mit::kMotionBytes>());
  return frame;
}

CanFrame encode_reply(std::uint32_t master_id, std::uint8_t id, const RegisterReply& reply) {
  CanFrame frame =
      make_frame(master_id, {id, 0, static_cast<std::uint8_t>(reply.verb), reply.rid, 0, 0, 0, 0});
  store_le(frame.data, 4, reply.raw);
  return frame;
}

}  // namespace drover::damiao
