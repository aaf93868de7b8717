#include "drivers/agilex_v2/driver.h"

#include <cmath>

namespace drover::agilex_v2 {
namespace {

using std::chrono::milliseconds;

/// Its switch to CAN is told in the next state, at most 0.1 s later: asked less often than that.
constexpr Duration kAskModeEach = milliseconds(200);
/// Near its own time-out of 0.5 s nobody knows whether it still obeys.
constexpr Duration kGap = milliseconds(400);
/// Two of its states long: then its mode is one from after the gap.
constexpr Duration kZerosAfterGap = milliseconds(200);

/// Of speeds that are nearly zero the one divided by the other is no curve; nor is it while a base
/// is caught, whose speeds fall one by one.
constexpr double kSlowestCurve_mps = 0.01;
/// Wheels are so far behind of what they are told while they turn, and come to it.
constexpr double kOnTheirWay_rad = 0.15;
/// Of a Hunter. It rests for so long before its brake is locked: what still rolls is not thrown
/// into it.
constexpr Duration kStillBeforeBrake = milliseconds(300);
constexpr Duration kAskBrakeEach = milliseconds(200);
/// A brake that does not tell that it is locked keeps nobody in command for longer.
constexpr Duration kBrakeTakes = milliseconds(600);

StopRecipe zeros(bool hold) {
  StopRecipe recipe;
  recipe.rounds.resize(1);
  recipe.rounds[0].frames.resize(1);
  recipe.rounds[0].frames[0] = motion_command({});
  recipe.period = milliseconds(20);
  recipe.ends = hold ? StopEnds::holds : StopEnds::damps;
  return recipe;
}

}  // namespace

AgilexV2Driver::AgilexV2Driver(AxisId axis, std::optional<Steering> steering, bool zero_holds)
    : axis_(axis), steering_(steering), recipe_(zeros(zero_holds)) {}

void AgilexV2Driver::on_link_up(Time) {
  state_known_ = false;
  held_off_ = held_off_ || request_ == AxisRequest::run;
}

void AgilexV2Driver::on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut& out) {
  if (wanted.empty()) return;
  const Setpoint& want = wanted[0];
  take_request(want.request, now);
  if (!ever_heard()) return;
  const bool known = status(now).state != AxisState::unknown;
  // In standby it is left as it is: of a sibling it is told that commands alone wake it.
  if (known && state_.mode == Mode::standby && !arms(request_)) return;

  if (now - last_command_ > kGap) zero_until_ = now + kZerosAfterGap;
  const bool finite = std::isfinite(want.twist.vx_mps) && std::isfinite(want.twist.wz_radps);
  command(may_move(now) && finite ? want.twist : Twist{}, now, out);

  if (!known || state_.vehicle != Vehicle::well) return;
  if (arms(request_) && !held_off_ && state_.mode == Mode::standby) ask_for(Mode::can, now, out);
  const bool braked = mind_brake(now, out);
  if (request_ == AxisRequest::idle && state_.mode == Mode::can && at_rest(now) && braked)
    ask_for(Mode::standby, now, out);
}

/// Released before it moves, locked when it rests and nobody drives: what standby and silence do
/// with it is nowhere said. True when it may leave the mode.
bool AgilexV2Driver::mind_brake(Time now, DriverOut& out) {
  if (!steering_) return true;
  const bool drives = request_ == AxisRequest::run && !held_off_;
  if (drives || !at_rest(now)) {
    still_since_ = kNever;
  } else if (still_since_ == kNever) {
    still_since_ = now;
  }
  if (state_.mode != Mode::can) return true;
  const bool rests = still_since_ != kNever && now - still_since_ >= kStillBeforeBrake;
  const bool wrong = drives ? state_.brake_locked : rests && !state_.brake_locked;
  if (wrong && now - last_brake_command_ >= kAskBrakeEach) {
    out.send(brake_command(!drives));
    last_brake_command_ = now;
    return false;
  }
  return state_.brake_locked || (rests && now - asked_since_ > kBrakeTakes);
}

/// After a boot, a gap, a fault or a remote control's turn it must not go on by itself. Only to
/// hold it may be taken back: that moves nothing.
void AgilexV2Driver::take_request(AxisRequest request, Time now) {
  if (request != request_) {
    request_ = request;
    asked_since_ = now;
    in_command_ = false;
    held_off_ = false;
  }
  const AxisState state = status(now).state;
  const bool running = state == AxisState::running;
  const bool lost = state == AxisState::unknown || state == AxisState::fault;
  if (request_ == AxisRequest::run && (lost || (in_command_ && !running))) held_off_ = true;
  in_command_ = in_command_ || running;
}

bool AgilexV2Driver::may_move(Time now) const {
  return arms(request_) && !held_off_ && now >= zero_until_ &&
         status(now).state == AxisState::running;
}

void AgilexV2Driver::command(const Twist& twist, Time now, DriverOut& out) {
  if (steering_) {
    steer(twist, now);
    out.send(steered_command({twist.vx_mps, asked_inner_rad_}));
  } else {
    out.send(motion_command(twist));
  }
  last_command_ = now;
}

/// A Hunter is steered by who drives it. At rest, and on its way there, its wheels stay as they
/// were when that ended: what is far from there it was asked last, and never told. As they are,
/// where somebody else steers them meanwhile.
void AgilexV2Driver::steer(const Twist& twist, Time now) {
  const double speed_mps = std::abs(twist.vx_mps);
  // From rest on it is steered as it begins to roll: what it can drive is a curve at any speed.
  const bool possible = speed_mps > 0 && std::abs(twist.wz_radps) <=
                                             speed_mps * steering_->radpm(steering_->most_rad);
  const bool drives = request_ == AxisRequest::run && (possible || speed_mps >= kSlowestCurve_mps);
  if (drives) {
    asked_inner_rad_ = steering_->inner_rad(twist.wz_radps / twist.vx_mps);
  } else if (status(now).state != AxisState::running ||
             (was_steered_ && std::abs(asked_inner_rad_ - inner_rad_) > kOnTheirWay_rad)) {
    asked_inner_rad_ = inner_rad_;
  }
  was_steered_ = drives;
}

void AgilexV2Driver::ask_for(Mode mode, Time now, DriverOut& out) {
  if (now - last_mode_command_ < kAskModeEach) return;
  out.send(mode_command(mode));
  last_mode_command_ = now;
}

std::span<const FrameRule> AgilexV2Driver::rules() const {
  static constexpr std::array kRules{
      FrameRule{.id = kMotionCommandId, .min_len = 8, .max_len = 8},
      FrameRule{.id = kModeCommandId, .min_len = 1, .max_len = 1},
      FrameRule{.id = kBrakeCommandId, .min_len = 1, .max_len = 1},
  };
  return steering_ ? std::span(kRules) : std::span(kRules).first(2);
}

/// What a command asks of the base: a Hunter that stands turns its wheels and nothing else.
std::optional<Twist> AgilexV2Driver::read_twist(const CanFrame& frame) const {
  if (!steering_) return read_motion_command(frame);
  const auto steered = read_steered_command(frame);
  if (!steered) return {};
  return Twist{steered->speed_mps, steered->speed_mps * steering_->radpm(steered->inner_rad)};
}

Effect AgilexV2Driver::effect(const Message& message, Time) const {
  const CanFrame* frame = message.frame();
  if (frame == nullptr) return {FrameEffect::forbidden};
  if (const auto twist = read_twist(*frame)) {
    if (is_zero(*twist)) return {FrameEffect::stop};
    return {FrameEffect::motion, channel_bit(0)};
  }
  const auto mode = read_mode_command(*frame);
  if (mode == Mode::can) return {FrameEffect::harmless};  // it forgets what it was told before
  if (mode == Mode::standby) return {FrameEffect::stop};
  // Released it stands by its zero speed, and is driven by nothing else.
  if (const auto lock = read_brake_command(*frame); lock && steering_)
    return {*lock ? FrameEffect::stop : FrameEffect::harmless};
  return {FrameEffect::forbidden};
}

Twist AgilexV2Driver::setpoint_twist(const Message& message, std::size_t channel) const {
  if (const CanFrame* frame = message.frame(); frame != nullptr && channel == 0)
    if (const auto twist = read_twist(*frame)) return *twist;
  return {kAbsent, kAbsent};
}

SilenceBehaviour AgilexV2Driver::silence() const {
  return {.stops = true,
          .after = milliseconds(500),
          .text = "drives at zero speed after 0.5 s (communication protection)",
          .ends = recipe_.ends};  // what it does at zero
}

}  // namespace drover::agilex_v2
