#include "drivers/canopen/setup.h"

namespace drover::canopen {
namespace {

constexpr int kTries = 3;

}  // namespace

void SdoSetup::begin() {
  client_.forget();
  next_ = 0;
  written_ = false;
  silences_ = 0;
  reason_.clear();
}

std::optional<CanFrame> SdoSetup::on_frame(const CanFrame& frame, Time now) {
  const auto reply = client_.on_frame(frame, now);
  if (const auto outcome = client_.take_outcome()) judge(*outcome);
  return reply;
}

std::optional<CanFrame> SdoSetup::on_tick(Time now) {
  const auto reply = client_.on_tick(now);
  if (const auto outcome = client_.take_outcome()) judge(*outcome);
  if (reply) return reply;
  return ask(now);
}

std::optional<CanFrame> SdoSetup::ask(Time now) {
  if (done() || failed() || client_.busy()) return {};
  const SdoStep& step = steps_[next_];
  return written_ ? client_.read(step.object, now) : client_.write(step.object, step.value, now);
}

void SdoSetup::judge(const SdoOutcome& outcome) {
  const SdoStep& step = steps_[next_];
  const unsigned index = step.object.index;
  const unsigned sub = step.object.sub;
  if (outcome.kind == SdoOutcome::Kind::silent) {
    if (++silences_ == kTries)
      reason_.format("object %04X:%02X: the node does not answer", index, sub);
    return;
  }
  silences_ = 0;
  if (outcome.kind == SdoOutcome::Kind::refused) {
    if (step.may_be_refused && !written_) return next_step();
    const auto why = abort_text(outcome.code);
    reason_.format("object %04X:%02X cannot be %s: %.*s (%08X)", index, sub,
                   written_ ? "read" : "written", static_cast<int>(why.size()), why.data(),
                   static_cast<unsigned>(outcome.code));
    return;
  }
  if (!written_ && step.read_back) {
    written_ = true;
    return;
  }
  if (written_) {
    const std::uint32_t mask = step.value.size >= 4 ? ~0U : (1U << (8U * step.value.size)) - 1U;
    if ((outcome.number().value_or(~step.value.bits) & mask) != (step.value.bits & mask)) {
      reason_.format("object %04X:%02X holds %u after %u was written", index, sub,
                     static_cast<unsigned>(outcome.number().value_or(0)),
                     static_cast<unsigned>(step.value.bits));
      return;
    }
  }
  next_step();
}

void SdoSetup::next_step() {
  ++next_;
  written_ = false;
}

}  // namespace drover::canopen
