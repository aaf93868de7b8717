// What it says of itself.
#include <algorithm>
#include <cmath>

#include "drivers/agilex_v2/driver.h"

namespace drover::agilex_v2 {
namespace {

using std::chrono::milliseconds;

/// It comes each 20 ms.
constexpr Duration kMotionStale = milliseconds(100);
/// It comes each 100 ms.
constexpr Duration kStateStale = milliseconds(350);
constexpr Duration kV1Remembered = std::chrono::seconds(1);
/// A chassis that is well is in CAN mode by then, and its brake free.
constexpr Duration kStarts = std::chrono::seconds(1);

/// A skid-steered base slips: of its speed a few per cent, of its turning much more.
constexpr double kLeastSigma_mps = 0.02;
constexpr double kSlipAhead = 0.05;
constexpr double kLeastSigma_radps = 0.03;
constexpr double kSlipTurning = 0.3;

constexpr double kLeastRolling_radps = 0.005;
constexpr double kBeside_radpm = 0.03;
constexpr double kSlipRolling = 0.05;

/// Of a base whose wheels are held its last digit may flicker.
constexpr double kStill_mps = 0.0025;
constexpr double kStill_radps = 0.0055;

double square(double value) {
  return value * value;
}

bool stands(const Twist& twist) {
  return std::abs(twist.vx_mps) < kStill_mps && std::abs(twist.wz_radps) < kStill_radps;
}

BodyMotion skidding(const Twist& twist) {
  return {.twist = twist,
          .vx_var = square(kLeastSigma_mps) + square(kSlipAhead * twist.vx_mps),
          .wz_var = square(kLeastSigma_radps) + square(kSlipTurning * twist.wz_radps),
          .known = true,
          .standing = stands(twist)};
}

/// Of wheels that roll on a curve: they slip little, and are steered a degree beside what they say.
BodyMotion rolling(double speed_mps, double radpm) {
  const Twist twist{speed_mps, speed_mps * radpm};
  return {.twist = twist,
          .vx_var = square(kLeastSigma_mps) + square(kSlipAhead * speed_mps),
          .wz_var = square(kLeastRolling_radps) + square(kBeside_radpm * speed_mps) +
                    square(kSlipRolling * twist.wz_radps),
          .known = true,
          .standing = stands(twist)};
}

/// Beside a state in which it is well; empty: no error bit is set.
Reason oddity_of(std::uint16_t error, Model model) {
  const ErrorWords told = error_words(error, model);
  if (told.unnamed == 0) return told.text;
  Reason all;
  if (told.text.empty()) {
    all.format("its error word is %04X", error);
  } else {
    const std::string_view text = told.text;
    all.format("%.*s (its error word is %04X)", static_cast<int>(text.size()), text.data(), error);
  }
  return all;
}

}  // namespace

std::span<const FrameFilter> AgilexV2Driver::listens() const {
  static constexpr std::array kListens{
      FrameFilter{kSystemStateId}, FrameFilter{kMotionId},        FrameFilter{kMotionCommandId},
      FrameFilter{kModeCommandId}, FrameFilter{kV1SystemStateId}, FrameFilter{kBrakeCommandId},
  };
  return std::span(kListens).first(kListens.size() - (steering_ ? 0 : 1));
}

void AgilexV2Driver::on_frame(const CanFrame& frame, Time received, DriverOut& out) {
  if (!frame.is_plain()) return;
  if (frame.id == kV1SystemStateId) {
    last_v1_ = received;
  } else if (frame.id == kSystemStateId) {
    if (const auto state = read_system_state(frame, model())) {
      hear_state(*state, received, out);
    } else {
      ++bad_;
    }
  } else if (frame.id == kMotionId) {
    hear_motion(frame, received, out);
  } else if (!is_of_recipe(frame, recipe_)) {
    // Its own ids of commands: somebody else drives it, and it goes on by a new request only.
    foreign_.on_frame(frame.id, received);
    held_off_ = held_off_ || request_ == AxisRequest::run;
  }
}

void AgilexV2Driver::hear_state(const SystemState& state, Time received, DriverOut& out) {
  ++good_;
  state_ = state;
  state_known_ = true;
  last_state_ = received;
  out.report({received, received, AxisSupply{.axis = axis_, .bus_V = state.battery_V}});
}

void AgilexV2Driver::hear_motion(const CanFrame& frame, Time received, DriverOut& out) {
  BodyMotion motion;
  if (!steering_) {
    const auto twist = read_motion(frame);
    if (!twist) return void(++bad_);
    motion = skidding(*twist);
  } else {
    const auto steered = read_steered_motion(frame);
    if (!steered) return void(++bad_);
    inner_rad_ = steered->inner_rad;
    motion = rolling(steered->speed_mps, steering_->radpm(steered->inner_rad));
    motion.steering_rad = steering_->middle_rad(steered->inner_rad);
  }
  ++good_;
  motion_ = motion.twist;
  last_motion_ = received;
  motion_told_ = true;
  out.report({received, received, motion});
}

void AgilexV2Driver::on_tick(Time now, DriverOut& out) {
  const StatusInWords current = status(now);
  if (told_.is_due(current, false)) report_heard<AxisStatus>(current, now, out);
  if (motion_told_ && now - last_motion_ > kMotionStale) {
    motion_told_ = false;
    out.report({now, now, BodyMotion{}});
  }
}

/// What does not come; empty: it says all that it should.
std::string_view AgilexV2Driver::missing(Time now) const {
  if (now - last_motion_ > kMotionStale) return "no motion (0x221)";
  if (now - last_state_ > kStateStale) return "no state (0x211)";
  return {};
}

bool AgilexV2Driver::at_rest(Time now) const {
  return now - last_motion_ <= kMotionStale && stands(motion_);
}

AxisState AgilexV2Driver::mode_state() const {
  const bool drives = request_ == AxisRequest::run && !held_off_;
  if (state_.mode == Mode::can)
    return drives && state_.brake_locked ? AxisState::arming : AxisState::running;
  const bool wanted = request_ == AxisRequest::run || request_ == AxisRequest::hold;
  return wanted && !held_off_ ? AxisState::arming : AxisState::idle;
}

/// Of one that is well, and does not run; empty: nothing is odd with that.
std::string_view AgilexV2Driver::why_not_running(AxisState state, Time now) const {
  if (state == AxisState::idle && held_off_)
    return "the chassis fell back to standby: a new start switches it to CAN again";
  if (state != AxisState::arming || now - asked_since_ < kStarts) return {};
  return state_.mode == Mode::can
             ? "its brake is locked, and does not come free"
             : "the chassis stays in standby, though it was asked for CAN mode";
}

StatusInWords AgilexV2Driver::status(Time now) const {
  StatusInWords status;
  status.axis = axis_;
  if (!state_known_ || !talks(now)) {
    status.reason = "the chassis was never heard";
    if (ever_heard()) status.reason.assign(talks(now) ? "no state (0x211)" : missing(now));
    return status;
  }
  status.error_code = state_.error;
  status.state = AxisState::fault;
  if (state_.vehicle == Vehicle::estop) {
    status.stops_all = true;
    status.reason = "the chassis' emergency stop is pressed";
  } else if (state_.vehicle == Vehicle::exception) {
    const ErrorWords told = error_words(state_.error, model());
    const std::string_view text = told.text;
    status.reason.format("the chassis reports a fault, error %04X%s%.*s", state_.error,
                         text.empty() ? "" : ": ", static_cast<int>(text.size()), text.data());
  } else if (state_.mode == Mode::remote) {
    status.powered = true;
    status.reason = "its remote control drives the chassis: switch it off, or to command mode";
  } else if (state_.mode == Mode::serial) {
    status.powered = true;
    status.reason = "the chassis is commanded over its serial line: unplug that";
  } else if (foreign_.is_shown(now)) {
    status.powered = true;
    status.reason = foreign_.text();
  } else {
    status.state = mode_state();
    status.reason = why_not_running(status.state, now);
  }
  return status;
}

SourceHealth AgilexV2Driver::health(Time now) const {
  SourceHealth health;
  health.last_good = std::max(last_motion_, last_state_);
  health.good = good_;
  health.bad = bad_;
  if (now - last_v1_ < kV1Remembered) {
    health.reason = "speaks AgileX protocol v1 (0x151 heard): this driver is for v2";
  } else if (!ever_heard()) {
    health.reason = "never heard: is the chassis on, and the bus at 500 kbit/s?";
  } else if (now - last_motion_ > kMotionStale) {
    health.reason = silent_text(missing(now), last_motion_, now);
  } else if (!talks(now)) {
    health.reason = silent_text(missing(now), last_state_, now);
  } else {
    health.reason = oddity_of(state_.error, model());
  }
  if (ever_heard()) health.state = talks(now) ? SourceState::fresh : SourceState::stale;
  return health;
}

}  // namespace drover::agilex_v2
