#include "drivers/canopen/sdo_client.h"

namespace drover::canopen {

std::optional<std::uint32_t> SdoOutcome::number() const {
  if (data.empty() || data.size() > 4) return {};
  std::uint32_t value = 0;
  for (std::size_t i = data.size(); i-- > 0;) value = value << 8U | data[i];
  return value;
}

CanFrame SdoClient::read(Object object, Time now) {
  begin(State::reading, object, now);
  return encode_sdo_read(node_, object);
}

CanFrame SdoClient::write(Object object, SdoNumber value, Time now) {
  begin(State::writing, object, now);
  return encode_sdo_write(node_, object, value);
}

void SdoClient::begin(State state, Object object, Time now) {
  state_ = state;
  since_ = now;
  toggle_ = false;
  announced_.reset();
  current_ = {};
  current_.object = object;
  outcome_.reset();
}

void SdoClient::end(SdoOutcome::Kind kind, std::uint32_t code) {
  current_.kind = kind;
  current_.code = code;
  outcome_ = current_;
  state_ = State::idle;
}

/// The node is told, so that it does not go on with what nobody waits for.
std::optional<CanFrame> SdoClient::give_up(std::uint32_t code) {
  const auto kind = code == kAbortTimeout ? SdoOutcome::Kind::silent : SdoOutcome::Kind::refused;
  end(kind, code);
  return encode_sdo_abort(node_, current_.object, code);
}

bool SdoClient::keep(const SdoAnswer& answer) {
  for (const auto byte : answer.data)
    if (!current_.data.push_back(byte)) return false;
  return true;
}

std::optional<CanFrame> SdoClient::on_frame(const CanFrame& frame, Time now) {
  if (!busy()) return {};
  const auto answer = decode_sdo_answer(frame, node_);
  if (!answer) return {};
  if (answer->kind == SdoAnswer::Kind::segment)
    return state_ == State::segments ? on_segment(*answer, now) : std::nullopt;
  if (!(answer->object == current_.object)) return {};
  switch (answer->kind) {
    case SdoAnswer::Kind::abort: end(SdoOutcome::Kind::refused, answer->code); return {};
    case SdoAnswer::Kind::written:
      if (state_ == State::writing) end(SdoOutcome::Kind::written);
      return {};
    case SdoAnswer::Kind::value:
      if (state_ != State::reading) return {};
      keep(*answer);
      end(SdoOutcome::Kind::read);
      return {};
    case SdoAnswer::Kind::segmented:
      if (state_ != State::reading) return {};
      if (answer->size.value_or(0) > current_.data.capacity()) return give_up(kAbortMemory);
      announced_ = answer->size;
      state_ = State::segments;
      since_ = now;
      return encode_sdo_segment_request(node_, toggle_);
    case SdoAnswer::Kind::segment: return {};
  }
  return {};
}

std::optional<CanFrame> SdoClient::on_segment(const SdoAnswer& segment, Time now) {
  if (segment.toggle != toggle_) return give_up(kAbortToggle);
  if (!keep(segment)) return give_up(kAbortMemory);
  // Or a node that says nothing at length would be listened to for ever.
  if (segment.data.empty() && !segment.last) return give_up(kAbortCommand);
  if (segment.last) {
    if (announced_ && *announced_ != current_.data.size()) return give_up(kAbortLength);
    end(SdoOutcome::Kind::read);
    return {};
  }
  toggle_ = !toggle_;
  since_ = now;
  return encode_sdo_segment_request(node_, toggle_);
}

std::optional<CanFrame> SdoClient::on_tick(Time now) {
  if (!busy() || now - since_ < patience_) return {};
  return give_up(kAbortTimeout);
}

void SdoClient::forget() {
  state_ = State::idle;
  outcome_.reset();
}

std::optional<SdoOutcome> SdoClient::take_outcome() {
  auto outcome = outcome_;
  outcome_.reset();
  return outcome;
}

}  // namespace drover::canopen
