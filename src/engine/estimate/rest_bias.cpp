#include "engine/estimate/rest_bias.h"

#include <algorithm>
#include <cmath>

namespace drover::engine::estimate {
namespace {

constexpr Duration kWindow = std::chrono::seconds(2);
constexpr Duration kLongestGap = std::chrono::milliseconds(200);
constexpr double kFewest = 20;
constexpr double kSteady_radps = 0.02;  // one sigma; more is no rest
constexpr double kLargest_radps = 0.2;  // more is no bias
constexpr double kFloor_radps = 0.0001;

}  // namespace

void RestBias::begin(const std::array<double, 3>& rate, Time at) {
  since_ = at;
  count_ = 0;
  first_ = rate;
  sum_ = sum2_ = {};
}

void RestBias::update(const Vector3& rate_radps, Time at, bool standing) {
  const std::array<double, 3> rate{rate_radps.x, rate_radps.y, rate_radps.z};
  const bool broken = last_ == kNever || at - last_ > kLongestGap;
  last_ = at;
  if (!standing) {
    since_ = kNever;
    return;
  }
  if (broken || since_ == kNever) begin(rate, at);
  count_ += 1;
  for (std::size_t i = 0; i < 3; ++i) {
    sum_[i] += rate[i] - first_[i];
    sum2_[i] += (rate[i] - first_[i]) * (rate[i] - first_[i]);
  }
  if (at - since_ < kWindow) return;
  std::array<double, 3> mean{};
  double worst = 0;
  double z_variance = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    mean[i] = first_[i] + sum_[i] / count_;
    z_variance = std::max(0.0, sum2_[i] / count_ - sum_[i] / count_ * (sum_[i] / count_));
    worst = std::max(
        {worst, std::sqrt(z_variance) / kSteady_radps, std::abs(mean[i]) / kLargest_radps});
  }
  if (count_ >= kFewest && worst <= 1) {
    known_ = true;
    bias_radps_ = {.x = mean[0], .y = mean[1], .z = mean[2]};
    sigma_radps_ = std::max(kFloor_radps, std::sqrt(z_variance / count_));
  }
  begin(rate, at);
}

}  // namespace drover::engine::estimate
