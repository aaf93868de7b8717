#include "engine/sensors/choice.h"

namespace drover::engine {
namespace {

constexpr Duration kApart = std::chrono::seconds(1);
constexpr Duration kTogether = std::chrono::seconds(3);

}  // namespace

Choice::Choice(const SensorList& all) : all_(all) {
  while (steers_ < all_.size() && all_[steers_].role != Role::steers) ++steers_;
  if (steers_ == all_.size()) steers_ = 0;
  in_use_ = steers_;
}

bool Choice::take(std::size_t which, Time now) {
  in_use_ = which;
  was_well_ = true;
  changed_ = now;
  return true;
}

bool Choice::update(Time now, const SensorConditions& candidates, bool stands) {
  if (all_.size() < 2) return false;
  if (begun_ == kNever) begun_ = now;
  if (!candidates[steers_].well) {
    steers_well_since_ = kNever;
  } else if (steers_well_since_ == kNever) {
    steers_well_since_ = now;
  }
  was_well_ = was_well_ || candidates[in_use_].well;
  if (candidates[in_use_].well) {
    const bool proved = steers_well_since_ != kNever && now - steers_well_since_ >= kProved;
    return is_spare() && proved && stands && take(steers_, now);
  }
  if (!was_well_ && now - begun_ < kBoots) return false;
  if (changed_ != kNever && now - changed_ < kSettles) return false;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const SensorCondition& it = candidates[i];
    if (i == in_use_ || all_[i].role == Role::told || !it.well) continue;
    if (it.fits || stands) return take(i, now);
  }
  return false;
}

void Agreement::update(Time now, bool apart) {
  if (apart != agree_) {
    opposite_since_ = kNever;
    return;
  }
  if (opposite_since_ == kNever) opposite_since_ = now;
  if (now - opposite_since_ < (apart ? kApart : kTogether)) return;
  agree_ = !apart;
  opposite_since_ = kNever;
}

}  // namespace drover::engine
