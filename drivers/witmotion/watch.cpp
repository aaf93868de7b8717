#include "drivers/witmotion/watch.h"

#include <cmath>

#include "drivers/witmotion/codec.h"
#include "drover/rotation.h"

namespace drover::witmotion {
namespace {

constexpr Duration kPaceWindow = std::chrono::seconds(1);
constexpr Duration kLongestPeriod = std::chrono::seconds(10);
constexpr Duration kRest = std::chrono::seconds(1);
constexpr double kRestRate_radps = 0.1;  // with the bias of a cheap sensor
constexpr double kRestForce_mps2 = 1.0;  // off 1 g
constexpr double kLeastUpright = 0.866;  // cosine of 30 degrees

}  // namespace

void PaceWatch::reset() {
  from_ = kNever;
  pace_Hz_ = kAbsent;
}

void PaceWatch::add(Time at) {
  if (from_ == kNever || at - last_ > kLongestPeriod) {
    reset();
    from_ = last_ = at;
    count_ = 0;
    return;
  }
  last_ = at;
  ++count_;
  if (at - from_ < kPaceWindow) return;
  pace_Hz_ = count_ / to_s(at - from_);
  from_ = at;
  count_ = 0;
}

void GravityWatch::add(Time at, const Vector3& acceleration_mps2, const Vector3& rate_radps) {
  const bool rests = length(rate_radps) < kRestRate_radps &&
                     std::abs(length(acceleration_mps2) - kGravity_mps2) < kRestForce_mps2;
  if (!rests || from_ == kNever) {
    from_ = rests ? at : kNever;
    sum_ = {};
    count_ = 0;
    if (!rests) return;
  }
  sum_ = {sum_.x + acceleration_mps2.x, sum_.y + acceleration_mps2.y, sum_.z + acceleration_mps2.z};
  ++count_;
  if (at - from_ < kRest) return;
  mean_ = {sum_.x / count_, sum_.y / count_, sum_.z / count_};
  wrong_ = mean_.z < kLeastUpright * length(mean_);
  from_ = kNever;
}

}  // namespace drover::witmotion
