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

StopRecipe zeros() {
  StopRecipe recipe;
  recipe.rounds.resize(1);
  recipe.rounds[0].frames.resize(1);
  recipe.rounds[0].frames[0] = motion_command({});
  recipe.period = milliseconds(20);
  recipe.ends = StopEnds::damps;  // that zero holds on a slope is nowhere said
  return recipe;
}

}  // namespace

AgilexV2Driver::AgilexV2Driver(AxisId axis) : axis_(axis), recipe_(zeros()) {}

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
  if (request_ == AxisRequest::idle && state_.mode == Mode::can && at_rest(now))
    ask_for(Mode::standby, now, out);
}

/// After a boot, a gap, a fault or a remote control's turn it must not go on by itself. Only to
/// hold it may be taken back: that moves nothing.
void AgilexV2Driver::take_request(AxisRequest request, Time now) {
  if (request != request_) {
    request_ = request;
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
  out.send(motion_command(twist));
  last_command_ = now;
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
  };
  return kRules;
}

Effect AgilexV2Driver::effect(const Message& message, Time) const {
  const CanFrame* frame = message.frame();
  if (frame == nullptr) return {FrameEffect::forbidden};
  if (const auto twist = read_motion_command(*frame)) {
    if (is_zero(*twist)) return {FrameEffect::stop};
    return {FrameEffect::motion, channel_bit(0)};
  }
  const auto mode = read_mode_command(*frame);
  if (mode == Mode::can) return {FrameEffect::harmless};  // it forgets what it was told before
  if (mode == Mode::standby) return {FrameEffect::stop};
  return {FrameEffect::forbidden};
}

Twist AgilexV2Driver::setpoint_twist(const Message& message, std::size_t channel) const {
  if (const CanFrame* frame = message.frame(); frame != nullptr && channel == 0)
    if (const auto twist = read_motion_command(*frame)) return *twist;
  return {kAbsent, kAbsent};
}

SilenceBehaviour AgilexV2Driver::silence() const {
  return {.stops = true,
          .after = milliseconds(500),
          .text = "drives at zero speed after 0.5 s (communication protection)",
          .ends = StopEnds::damps};
}

}  // namespace drover::agilex_v2
