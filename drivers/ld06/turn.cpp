#include "drivers/ld06/turn.h"

#include <algorithm>

namespace drover::ld06 {
namespace {

// A motor does not run backwards; its angle may tremble by less than this.
constexpr double kBackwards_cdeg = 500;
// By the device's own clock, in which waiting on the way does not count. Half a turn: with more
// missing nobody knows whether the angle passed zero meanwhile.
constexpr int kGap_ms = 50;
// That clock has begun anew after 30 s of silence.
constexpr Duration kSilence = std::chrono::seconds(1);
// Of a motor that stands the steps in time are not known: a tenth of a turn a second is no motion.
constexpr double kStanding_degps = 36;

Duration step_of(const Slice& slice) {
  if (slice.speed_degps < kStanding_degps) return Duration::zero();
  const double beam_s = span_cdeg(slice) / 100.0 / slice.speed_degps / (kBeams - 1);
  return from_s(std::min(beam_s, 2 / kPoints_Hz));
}

}  // namespace

void TurnAssembler::reset() {
  whole_ = false;
  last_cdeg_ = 0;
  stamp_ms_.reset();
}

bool TurnAssembler::is_gap(std::uint16_t stamp_ms, Time sent) const {
  if (!stamp_ms_) return false;
  return sent - sent_ > kSilence || (stamp_ms - *stamp_ms_ + kStampWrap) % kStampWrap > kGap_ms;
}

void TurnAssembler::begin_turn(Time at) {
  growing_.points.clear();
  growing_.begin = growing_.end = at;
  speed_degps_ = 0;
  slices_ = 0;
}

bool TurnAssembler::end_turn() {
  if (!whole_ || slices_ == 0) return false;
  growing_.turn_Hz = speed_degps_ / slices_ / 360;
  growing_.sectors.clear();
  ended_ = growing_;
  return true;
}

bool TurnAssembler::add(const Slice& slice, Time sent) {
  if (is_gap(slice.stamp_ms, sent)) reset();
  stamp_ms_ = slice.stamp_ms;
  sent_ = sent;
  bool ended = false;
  const double step_cdeg = static_cast<double>(span_cdeg(slice)) / (kBeams - 1);
  const Duration step = step_of(slice);
  for (std::size_t i = 0; i < kBeams; ++i) {
    double angle_cdeg = slice.start_cdeg + static_cast<double>(i) * step_cdeg;
    if (angle_cdeg >= kTurn_cdeg) angle_cdeg -= kTurn_cdeg;
    const Time at = sent - static_cast<long>(kBeams - 1 - i) * step;
    if (angle_cdeg < last_cdeg_ - kBackwards_cdeg) {
      ended = end_turn();
      begin_turn(at);
      whole_ = true;
    }
    last_cdeg_ = angle_cdeg;
    if (!whole_) continue;
    if (i == 0 || slices_ == 0) {
      speed_degps_ += slice.speed_degps;
      ++slices_;
    }
    const double clockwise_rad = to_rad(angle_cdeg / 100);
    // More points than fit are those of a turn that never ends: what they saw stays unknown.
    if (growing_.points.push_back({wrap_rad(upside_down_ ? clockwise_rad : -clockwise_rad),
                                   slice.beams[i].range_mm / 1000.0, slice.beams[i].intensity}))
      growing_.end = std::max(growing_.begin, at);
  }
  return ended;
}

}  // namespace drover::ld06
