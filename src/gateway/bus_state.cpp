#include "gateway/bus_state.h"

namespace drover::gateway {

void BusState::on_up() {
  condition_ = {};
  strangers_.clear();
  lost_.clear();
  jammed_since_ = kNever;
}

[[gnu::hot]] void BusState::on_frame(const CanFrame& frame, Time received) {
  if (frame.error) {
    condition_.on_error_frame(frame, received);
  } else {
    condition_.on_frame(received);
  }
}

void BusState::on_sent(std::uint64_t sent, std::uint64_t refused, Time now) {
  if (sent != sent_) {
    jammed_since_ = kNever;
  } else if (refused != refused_ && jammed_since_ == kNever) {
    jammed_since_ = now;
  }
  sent_ = sent;
  refused_ = refused;
}

bool BusState::cut(Time now) const {
  return lost() || jammed(now) || condition_.state() == CanCondition::State::off;
}

Reason BusState::trouble(Time now) const {
  if (lost()) return lost_;
  Reason text = condition_.text(name_.view(), now);
  if (text.empty() && jammed(now)) {
    const auto name = name_.view();
    text.format("%.*s takes no frames: nobody acknowledges them, or its queue is stuck",
                static_cast<int>(name.size()), name.data());
  }
  return text;
}

}  // namespace drover::gateway
