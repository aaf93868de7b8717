// What else than the wheels says that the base moves.
#include "engine/health/motion_witness.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "engine/health/ground_way.h"
#include "engine/health/place_sigma.h"

namespace drover::engine {
namespace {

constexpr double kMoving_mps = 0.2;
constexpr double kMoving_m = 0.3;
const double kTurning_radps = to_rad(3.0);
const double kTurned_rad = to_rad(5.0);
constexpr double kSigmas = 4.0;
constexpr double kFresh_s = 0.5;  // receivers tell ten times a second, and once a second at worst
constexpr Duration kApart = std::chrono::milliseconds(90);
constexpr Duration kStandsFor = std::chrono::seconds(1);
constexpr Duration kStoodFor = std::chrono::seconds(3);
constexpr double kStands_m = 0.06;        // four sigma of two fixes
constexpr double kSpeedAtRest_mps = 0.1;  // three sigma
constexpr Duration kStoodLately = std::chrono::milliseconds(1500);
// What a receiver's speed and way may differ by: noise, and how the speed changes in a second.
constexpr double kApart_mps = 0.1;
constexpr double kApartShare = 0.25;
constexpr double kTurnSmooth_s = 0.1;   // a knock is no turn
constexpr double kLearned = 0.05;       // share of each new speed
constexpr double kMostNoise_mps = 0.5;  // what is more, nobody has to call noise

double speed_sigma_mps(FixQuality quality) {
  switch (quality) {
    case FixQuality::rtk_fixed: return 0.03;
    case FixQuality::rtk_float: return 0.15;
    case FixQuality::dgps:
    case FixQuality::pps: return 0.3;
    default: return 0.5;
  }
}

void append(Reason& text, const char* format, double value) {
  Reason part;
  part.format(format, value);
  if (!text.empty()) text.append(", ");
  text.append(part);
}

}  // namespace

bool MotionWitness::fresh(Time at, Time now) const {
  return at != kNever && now - at <= from_s(kFresh_s);
}

void MotionWitness::on_speed(const GnssVelocity& velocity, Time at) {
  if (!std::isfinite(velocity.speed_mps)) return;
  if (speed_at_ == kNever || at > speed_at_) {
    speed_before_mps_ = speed_mps_;
    speed_before_at_ = speed_at_;
  }
  speed_mps_ = std::abs(velocity.speed_mps);
  speed_at_ = at;
  // Of a fix the noise is known. Taken for noise, a slow motion that grows would never be one.
  if (!rests_ || position_.quality == FixQuality::rtk_fixed) return;
  const double noise_mps = std::min(speed_mps_, kMostNoise_mps);
  learned_noise_mps2_ += kLearned * (noise_mps * noise_mps - learned_noise_mps2_);
}

void MotionWitness::on_position(const GnssPosition& position, Time at) {
  const bool place = position.quality != FixQuality::none && std::isfinite(position.latitude_deg) &&
                     std::isfinite(position.longitude_deg);
  if (!place) return;
  if (position.quality != position_.quality) learned_noise_mps2_ = 0;
  if (position_at_ == kNever || at > position_at_) {
    position_before_ = position_;
    position_before_at_ = position_at_;
  }
  position_ = position;
  position_at_ = at;
  keep_place(position, at);
  if (from_at_ == kNever && wanted_from_ != kNever && at >= wanted_from_) {
    from_ = position;
    from_at_ = at;
  }
}

/// The youngest that is so old, and not much older; nullptr: none.
const MotionWitness::Place* MotionWitness::place_before(Time at, Duration age) const {
  const Place* before = nullptr;
  for (const Place& each : places_) {
    if (each.at == kNever || at - each.at < age || at - each.at > age + kStandsFor) continue;
    if (before == nullptr || each.at > before->at) before = &each;
  }
  return before;
}

void MotionWitness::keep_place(const GnssPosition& position, Time at) {
  if (position.quality != FixQuality::rtk_fixed) {
    places_.fill({});
    one_motion_ = kNever;
    return;
  }
  const auto length_m = [](const PathPoint& way) { return std::hypot(way.x_m, way.y_m); };
  // A receiver may tell once a second, and its speed after its place.
  const bool speaks = speed_at_ != kNever && at - speed_at_ <= kStoodLately;
  bool one = false;
  if (const Place* before = place_before(at, kStandsFor); before != nullptr && speaks) {
    last_second_ = ground_way(before->position, position);
    if (length_m(last_second_) < kStands_m && speed_mps_ < kSpeedAtRest_mps) stands_at_ = at;
    const double mps = length_m(last_second_) / to_s(at - before->at);
    one = mps > kMoving_mps && std::abs(speed_mps_ - mps) < kApart_mps + kApartShare * mps;
  }
  if (!one) one_motion_ = kNever;
  if (one && one_motion_ == kNever) one_motion_ = at;
  const Place* long_before = place_before(at, kStoodFor);
  if (long_before != nullptr && speaks && speed_mps_ < kSpeedAtRest_mps &&
      length_m(ground_way(long_before->position, position)) < kStands_m) {
    stood_at_ = at;
  }
  const Place& last = places_[(next_place_ + places_.size() - 1) % places_.size()];
  if (last.at != kNever && at - last.at < kApart) return;
  places_[next_place_] = {position, at};
  next_place_ = (next_place_ + 1) % places_.size();
}

bool MotionWitness::turns(Time now) const {
  return fresh(turn_at_, now) && std::abs(turn_radps_) > kTurning_radps;
}

bool MotionWitness::stands(Time now) const {
  return !turns(now) && stands_at_ != kNever && now - stands_at_ <= kStoodLately;
}

bool MotionWitness::stood(Time now) const {
  return stands(now) && stood_at_ != kNever && now - stood_at_ <= kStoodLately;
}

std::optional<PathPoint> MotionWitness::proven_way(Time now) const {
  const bool proven = one_motion_ != kNever && fresh(position_at_, now) && fresh(speed_at_, now) &&
                      now - one_motion_ >= kStandsFor;
  return proven ? std::optional(last_second_) : std::nullopt;
}

bool MotionWitness::is_slower(double speed_mps, Time now) const {
  const bool fixed = position_.quality == FixQuality::rtk_fixed && fresh(position_at_, now);
  return fixed && fresh(speed_at_, now) && speed_mps_ < speed_mps;
}

void MotionWitness::on_turn(double turn_radps, Time at) {
  if (!std::isfinite(turn_radps)) return;
  const double dt_s = turn_at_ == kNever ? 1.0 : std::max(to_s(at - turn_at_), 0.0);
  turn_radps_ += dt_s / (kTurnSmooth_s + dt_s) * (turn_radps - turn_radps_);
  turn_at_ = at;
}

void MotionWitness::on_heading(const GnssHeading& heading, Time at) {
  if (!std::isfinite(heading.heading_deg) || (heading_at_ != kNever && at < heading_at_)) return;
  if (turned_from_ != kNever) {
    turned_rad_ -= wrap_rad(to_rad(heading.heading_deg - heading_deg_));  // a compass turns right
  } else if (wanted_from_ != kNever && at >= wanted_from_) {
    turned_from_ = at;
    turned_rad_ = 0;
  }
  heading_deg_ = heading.heading_deg;
  heading_at_ = at;
}

void MotionWitness::expect_rest(Time at, double turn) {
  wanted_from_ = at;
  from_at_ = turned_from_ = kNever;
  commanded_turn_ = turn;
}

void MotionWitness::forget_receiver() {
  speed_at_ = position_at_ = heading_at_ = kNever;
  from_at_ = turned_from_ = kNever;
  learned_noise_mps2_ = 0;
  places_.fill({});
  one_motion_ = stands_at_ = stood_at_ = kNever;
}

double MotionWitness::speed_noise_mps() const {
  return std::max(speed_sigma_mps(position_.quality), std::sqrt(learned_noise_mps2_));
}

double MotionWitness::speed_mps(Time now) const {
  if (!fresh(speed_at_, now)) return 0;
  return speed_mps_ > std::max(kMoving_mps, kSigmas * speed_noise_mps()) ? speed_mps_ : 0.0;
}

double MotionWitness::proven_speed_mps(Time now, double yaw_rad) const {
  const bool two = fresh(speed_at_, now) && fresh(speed_before_at_, speed_at_) &&
                   fresh(position_at_, now) && fresh(position_before_at_, position_at_);
  if (!two) return 0;
  const double speed_mps = std::min(speed_mps_, speed_before_mps_);
  const PathPoint step = ground_way(position_before_, position_);
  const double noise_m = std::hypot(place_sigma_m(position_before_, config_.estimate),
                                    place_sigma_m(position_, config_.estimate));
  const double went_m = std::isfinite(yaw_rad)
                            ? std::abs(step.x_m * std::cos(yaw_rad) + step.y_m * std::sin(yaw_rad))
                            : std::hypot(step.x_m, step.y_m);
  if (went_m <= kSigmas * noise_m || speed_mps <= kSigmas * speed_noise_mps()) return 0;
  return std::min(speed_mps, went_m / to_s(position_at_ - position_before_at_));
}

PathPoint MotionWitness::way(Time now) const {
  if (from_at_ == kNever || !fresh(position_at_, now)) return {};
  return ground_way(from_, position_);
}

bool MotionWitness::went(Time now) const {
  const PathPoint gone = way(now);
  const double noise_m = std::hypot(place_sigma_m(from_, config_.estimate),
                                    place_sigma_m(position_, config_.estimate));
  return std::hypot(gone.x_m, gone.y_m) > std::max(kMoving_m, kSigmas * noise_m);
}

bool MotionWitness::turns_on(Time now) const {
  if (!fresh(turn_at_, now) || !fresh(heading_at_, now) || turned_from_ == kNever) return false;
  const double noise_rad = std::hypot(1.0, 1.0) * to_rad(config_.estimate.heading_sigma_deg);
  return turn_radps_ * commanded_turn_ > kTurning_radps &&
         turned_rad_ * commanded_turn_ > std::max(kTurned_rad, kSigmas * noise_rad);
}

bool MotionWitness::spins_on(Time now) const {
  return turns_on(now) && !went(now) && speed_mps(now) == 0;
}

Testimony MotionWitness::hear(Time now) const {
  Testimony said;
  if (fresh(speed_at_, now)) {
    ++said.heard;
    if (const double speed = speed_mps(now); speed > 0) {
      ++said.moving;
      append(said.in_words, "the receiver says %.1f m/s", speed);
    }
  }
  if (fresh(turn_at_, now)) {
    ++said.heard;
    if (turns(now)) {
      ++said.moving;
      append(said.in_words, "the gyro %.0f deg/s", to_deg(turn_radps_));
    }
  }
  if (from_at_ != kNever && fresh(position_at_, now)) {
    ++said.heard;
    if (went(now)) {
      const PathPoint gone = way(now);
      ++said.moving;
      append(said.in_words, "the receiver's position went %.1f m", std::hypot(gone.x_m, gone.y_m));
    }
  }
  if (turns_on(now)) {  // silent otherwise: it does not speak for itself
    ++said.heard;
    ++said.moving;
    append(said.in_words, "the receiver's heading turned by %.0f deg", to_deg(turned_rad_));
  }
  return said;
}

}  // namespace drover::engine
