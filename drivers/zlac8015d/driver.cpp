// The state machine: when the node is set up, and its wheels are armed, fed, commanded, given up.
#include "drivers/zlac8015d/driver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drover::zlac8015d {
namespace {

using std::chrono::milliseconds;
constexpr Duration kAskEach = milliseconds(100);
constexpr Duration kSetUpAgain = milliseconds(2000);
constexpr int kFeedsInSilence = 4;  ///< of its time-out
/// To write an object and to read it back, a cycle of 5 ms for either.
constexpr Duration kStepTakes = milliseconds(10);
constexpr Duration kStepEach = milliseconds(20);
/// A status that was under way when the request left tells nothing of it.
constexpr Duration kSettle = milliseconds(20);
constexpr Duration kClearTime = milliseconds(250);
constexpr double kSlow_radps = 0.1;
constexpr Duration kIdleAtLast = milliseconds(1000);

/// NMT, and all function codes that its node has: neither 0x000 + node nor 0x100 + node, which are
/// free for devices that are no CANopen.
std::array<FrameFilter, 5> all_of(std::uint8_t node) {
  const std::uint32_t id = node;
  return {FrameFilter{0x000}, FrameFilter{0x080 + id}, FrameFilter{0x180 + id},
          FrameFilter{0x200 + id, 0x67F}, FrameFilter{0x400 + id, 0x47F}};
}

/// One controlword is for both wheels: what both ask for. While one is caught the other may be at
/// rest already: it holds at zero, and the catch goes on.
AxisRequest common(std::span<const Setpoint> wanted) {
  const auto all = [wanted](auto fits) {
    return std::all_of(wanted.begin(), wanted.end(),
                       [&](const Setpoint& each) { return fits(each.request); });
  };
  const auto is = [](AxisRequest request) {
    return [request](AxisRequest each) { return each == request; };
  };
  if (all(is(AxisRequest::run))) return AxisRequest::run;
  if (all(is(AxisRequest::idle))) return AxisRequest::idle;
  if (all(is(AxisRequest::rest))) return AxisRequest::rest;
  const bool held = all(arms);
  const bool caught =
      all([](AxisRequest each) { return each == AxisRequest::hold || each == AxisRequest::rest; });
  return held || caught ? AxisRequest::hold : AxisRequest::rest;
}

/// Enabled at zero it holds. The node's service channel is asked beside the PDO, which a node that
/// was restarted does not take; one question in two rounds, as it answers one at a time.
StopRecipe recipe_of(std::uint8_t node) {
  StopRecipe recipe;
  for (const std::uint8_t sub : kSubs) {
    StopRound zero;
    static_cast<void>(zero.frames.push_back(encode_targets(node, {})));
    static_cast<void>(recipe.rounds.push_back(zero));
    StopRound question;
    static_cast<void>(question.frames.push_back(
        canopen::encode_sdo_write(node, {canopen::kTargetVelocity, sub}, canopen::i32(0))));
    static_cast<void>(recipe.rounds.push_back(question));
  }
  recipe.period = milliseconds(10);
  recipe.ends = StopEnds::holds;
  return recipe;
}

}  // namespace

Zlac8015dDriver::Zlac8015dDriver(const Settings& settings, std::array<AxisId, kWheels> axes)
    : settings_(settings),
      axes_(axes),
      hears_(all_of(settings.node)),
      rules_(rules_of(settings)),
      steps_(steps_of(settings)),
      fed_steps_(fed_steps_of(settings)),
      setup_(settings.node, {steps_.data(), steps_.size()}),
      recipe_(recipe_of(settings.node)) {
  no_status_.format("no status (%03X)", static_cast<unsigned>(id_of(Cob::status, settings.node)));
  if (settings.silence_ms > 0) {
    silence_text_.format(
        "%s after %.3f s (its time-out, set and read back at each start)",
        settings.silence_holds ? "stops and holds" : "lets go, as far as is known,",
        settings.silence_ms / 1000.0);
  } else {
    silence_text_ = "keeps its last velocity for ever: silence_ms is 0";
  }
}

bool Zlac8015dDriver::silent(Time now) const {
  return heard_.last_alive == kNever || now - heard_.last_alive > settings_.heartbeat_timeout;
}

/// Its heartbeat and its speeds say nothing of a fault, or of the emergency stop on its connector.
bool Zlac8015dDriver::lacks_status(Duration limit, Time now) const {
  return link_ == Link::ready && now - last_status_ > limit;
}

void Zlac8015dDriver::lock(std::string_view why) {
  phase_ = Phase::locked;
  fault_ = true;
  lock_reason_.assign(why);
}

/// Whatever was known may be of before a loss of its power. One that just booted holds nothing; any
/// other may.
void Zlac8015dDriver::begin_setup(bool booted, Time now) {
  const StepList& steps = booted ? steps_ : fed_steps_;
  setup_ = canopen::SdoSetup(settings_.node, {steps.data(), steps.size()});
  link_ = Link::setting_up;
  link_since_ = now;
  setup_.begin();
  status_ = {};
  target_ = {};
  last_speeds_ = last_status_ = kNever;
  positions_known_ = false;
  emergency_ = 0;
  may_hold_ = !booted && (may_hold_ || held_);
}

/// Its answers alone may be lost: a drive that holds the robot would let go by its time-out. Not
/// one that a person let go of.
void Zlac8015dDriver::feed_blindly(Time now, DriverOut& out) {
  if (request_ == AxisRequest::idle && now - phase_since_ > kIdleAtLast) may_hold_ = false;
  const Duration part = milliseconds(settings_.silence_ms) / kFeedsInSilence;
  const Duration each =
      part > Duration{} ? std::clamp<Duration>(part, kStepTakes, kAskEach) : kAskEach;
  if (!(may_hold_ || held_) || now - last_answer_ < each) return;
  if (link_ == Link::silent) send_targets({}, now, false, out);
  // Whose set-up was not ended takes targets by its service channel alone; this asks it, too.
  if (now < next_question_) return;
  next_question_ = now + each;
  out.send(canopen::encode_sdo_write(settings_.node, {canopen::kTargetVelocity, kSubs[0]},
                                     canopen::i32(0)));
}

/// From silence to a node whose every object was read back and that says so.
void Zlac8015dDriver::keep_link(Time now, DriverOut& out) {
  if (silent(now) && link_ != Link::silent) {
    link_ = Link::silent;
    next_question_ = now;
    if (attempts_to_run()) lock("heartbeat ceased while armed");
  }
  if (phase_ == Phase::running && lacks_status(settings_.heartbeat_timeout, now))
    lock(silent_text(no_status_.view(), settings_.heartbeat_timeout).view());
  if (link_ == Link::setting_up && setup_.failed() && now - link_since_ > kSetUpAgain)
    begin_setup(false, now);
  switch (link_) {
    case Link::silent:
      feed_blindly(now, out);
      // It may have been started long ago and say nothing unless it is asked.
      if (now < next_question_) return;
      next_question_ = now + kAskEach;
      out.send(canopen::encode_sdo_read(settings_.node, {canopen::kStatusword, 0}));
      return;
    case Link::setting_up:
      feed_blindly(now, out);
      if (const auto frame = setup_.on_tick(now)) out.send(*frame);
      if (!setup_.done()) return;
      link_ = Link::starting;
      next_question_ = now;
      return;
    case Link::starting:
      // What it holds it goes on holding: from here on by process data, as soon as it takes that.
      send_targets({}, now, false, out);
      if (now < next_question_) return;
      next_question_ = now + kAskEach;
      if (const auto start = canopen::encode_nmt(canopen::NmtCommand::operational, settings_.node))
        out.send(*start);
      return;
    case Link::ready: return;
  }
}

void Zlac8015dDriver::start_arming(Time now) {
  fault_ = false;
  lock_reason_.clear();
  reset_at_ = kNever;
  controlword_ = 0;
  phase_ = Phase::arming;
  phase_since_ = now;
  if (silent(now)) lock("asked to run while the drive was silent");
}

/// What the newest status means for what is under way.
void Zlac8015dDriver::follow_status(Time now) {
  const auto state = drive_state(status_);
  const bool enabled = state == canopen::DriveState::operation_enabled;
  if (phase_ == Phase::running && !enabled) {
    lock(state == canopen::DriveState::fault ? "drive reports a fault" : "is no longer enabled");
  } else if (phase_ == Phase::arming) {
    if (enabled && now - phase_since_ >= kSettle) phase_ = Phase::running;
    if (state == canopen::DriveState::fault && reset_at_ != kNever && now - reset_at_ > kClearTime)
      lock("fault does not clear");
  }
}

/// Never more than was asked for: a ramp down to rest only falls.
std::int32_t Zlac8015dDriver::target_of(std::size_t wheel, double velocity_radps) {
  double rpm =
      velocity_radps * settings_.gear_ratio * settings_.sign[wheel] * 60 / (2 * std::numbers::pi);
  if (!std::isfinite(rpm)) {
    ++bad_setpoints_;
    return 0;
  }
  if (std::abs(rpm) > settings_.max_rpm) {
    ++bad_setpoints_;
    rpm = std::copysign(settings_.max_rpm, rpm);
  }
  return static_cast<std::int32_t>(rpm * settings_.steps_per_rpm);
}

double Zlac8015dDriver::radps_of(std::size_t wheel, double rpm) const {
  return rpm * 2 * std::numbers::pi / 60 * settings_.sign[wheel] / settings_.gear_ratio;
}

Pair Zlac8015dDriver::targets_of(std::span<const Setpoint> wanted, AxisRequest request) {
  Pair targets{};
  if (!arms(request)) return targets;
  for (std::size_t wheel = 0; wheel < kWheels && wheel < wanted.size(); ++wheel)
    if (arms(wanted[wheel].request))
      targets[wheel] = target_of(wheel, wanted[wheel].velocity_radps);
  return targets;
}

void Zlac8015dDriver::send_targets(const Pair& targets, Time now, bool at_once, DriverOut& out) {
  const bool stops = targets == Pair{} && target_ != Pair{};
  if (!at_once && !stops && now - last_targets_ < settings_.setpoint_period) return;
  last_targets_ = now;
  target_ = targets;
  out.send(encode_targets(settings_.node, targets));
}

/// One transition at a time, each until the status tells of it.
void Zlac8015dDriver::send_controlword(canopen::DriveGoal goal, Time now, DriverOut& out) {
  if (last_controlword_ != kNever && now - last_controlword_ < kStepEach) return;
  const bool may_reset = reset_at_ == kNever || now - reset_at_ <= kClearTime;
  controlword_ = canopen::next_controlword(goal, drive_state(status_), controlword_, may_reset);
  if (controlword_ == canopen::kFaultReset && reset_at_ == kNever) reset_at_ = now;
  last_controlword_ = now;
  out.send(encode_controlword(settings_.node, controlword_));
}

void Zlac8015dDriver::control(const Pair& targets, Time now, DriverOut& out) {
  if (phase_ == Phase::arming && now - phase_since_ > settings_.arming_timeout)
    lock(setup_.failed() ? setup_.reason().view() : "does not become enabled");
  if (link_ != Link::ready) return;
  switch (phase_) {
    case Phase::arming:
      // Before the word that enables: a wheel that rolls is caught at its own speed.
      send_targets(request_ == AxisRequest::hold ? targets : Pair{}, now, true, out);
      send_controlword(canopen::DriveGoal::enabled, now, out);
      return;
    case Phase::running: return send_targets(targets, now, false, out);
    case Phase::idling: {
      const bool slow = std::abs(velocity_radps_[kLeft]) < kSlow_radps &&
                        std::abs(velocity_radps_[kRight]) < kSlow_radps;
      if (drive_state(status_) != canopen::DriveState::switch_on_disabled &&
          (slow || now - phase_since_ > kIdleAtLast))
        send_controlword(canopen::DriveGoal::off, now, out);
      break;
    }
    case Phase::resting:
    case Phase::locked: break;
  }
  send_targets({}, now, false, out);
}

void Zlac8015dDriver::take(AxisRequest request, Time now) {
  if (request == request_) return;
  const AxisRequest before = request_;
  request_ = request;
  if (arms(request)) return start_arming(now);
  phase_ = request == AxisRequest::idle ? Phase::idling : Phase::resting;
  phase_since_ = now;
  if (!arms(before)) return;
  fault_ = false;
  lock_reason_.clear();
}

void Zlac8015dDriver::on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut& out) {
  commanded_ = true;
  const AxisRequest request = common(wanted);
  // What was heard knows more.
  held_ = heard_.last_alive == kNever && request != AxisRequest::idle &&
          std::any_of(wanted.begin(), wanted.end(), [](const Setpoint& each) { return each.held; });
  take(request, now);
  control(targets_of(wanted, request), now, out);
}

void Zlac8015dDriver::on_tick(Time now, DriverOut& out) {
  if (!commanded_) control({}, now, out);  // nobody decided: zero, as at rest
  commanded_ = false;
  keep_link(now, out);
  report_status(now, false, out);
}

void Zlac8015dDriver::on_link_up(Time now) {
  heard_.last_alive = last_answer_ = last_speeds_ = last_status_ = kNever;
  link_ = Link::silent;
  next_question_ = now;
  status_ = {};
  target_ = {};
  positions_known_ = false;
  if (arms(request_)) lock("the link was lost while armed");
}

Effect Zlac8015dDriver::effect(const Message& message, Time) const {
  if (message.frame() == nullptr) return {};
  return zlac8015d::effect(*message.frame(), settings_, steps_, target_);
}

/// The word that enables asks for what the targets before it said.
double Zlac8015dDriver::setpoint_radps(const Message& message, std::size_t channel) const {
  if (message.frame() == nullptr || channel >= kWheels) return kAbsent;
  auto targets = decode_pair(*message.frame(), Cob::targets, settings_.node);
  if (decode_controlword(*message.frame(), settings_.node) == canopen::kEnableOperation)
    targets = target_;
  if (!targets) return kAbsent;
  return radps_of(channel, static_cast<double>((*targets)[channel]) / settings_.steps_per_rpm);
}

SilenceBehaviour Zlac8015dDriver::silence() const {
  SilenceBehaviour behaviour;
  behaviour.stops = settings_.silence_ms > 0;
  behaviour.after = milliseconds(settings_.silence_ms);
  behaviour.text = silence_text_.view();
  behaviour.ends = settings_.silence_holds ? StopEnds::holds : StopEnds::coasts;
  behaviour.assumed = !settings_.silence_holds;
  return behaviour;
}

}  // namespace drover::zlac8015d
