// The state machine: when the node is set up, armed, fed, commanded, given up.
#include "drivers/cia402/driver.h"

#include <cmath>
#include <numbers>

namespace drover::cia402 {
namespace {

using canopen::DriveState;
using std::chrono::milliseconds;
constexpr Duration kAskEach = milliseconds(100);
constexpr Duration kSetUpAgain = milliseconds(2000);
constexpr Duration kStepEach = milliseconds(20);
/// A status that was under way when the request left tells nothing of it.
constexpr Duration kSettle = milliseconds(20);
constexpr Duration kClearTime = milliseconds(250);
constexpr double kSlow_radps = 0.1;
constexpr Duration kIdleAtLast = milliseconds(1000);
/// Nobody says that it heard it: so long it is told.
constexpr Duration kToldOff = milliseconds(300);
constexpr int kFeedsInSilence = 4;

/// NMT, the gateway's own heartbeat, and all function codes that its node has, but neither 0x000 +
/// node nor 0x100 + node, which are free for devices that are no CANopen.
std::array<FrameFilter, 6> all_of(const Settings& settings) {
  const std::uint32_t id = settings.node;
  return {FrameFilter{0x000},
          FrameFilter{0x080 + id},
          FrameFilter{0x180 + id},
          FrameFilter{0x200 + id, 0x67F},
          FrameFilter{0x400 + id, 0x47F},
          FrameFilter{id_of(Cob::heartbeat, settings.gateway_node)}};
}

/// Zero while it is enabled, and not a quick stop: closed loop at zero holds on a slope whatever
/// 605A of the drive ends in. The node's service channel is asked beside the PDO, which a node that
/// was restarted does not take.
StopRecipe recipe_of(const Settings& settings) {
  StopRecipe recipe;
  StopRound zero;
  static_cast<void>(
      zero.frames.push_back(encode_command(settings.node, {canopen::kEnableOperation, 0})));
  StopRound question;
  static_cast<void>(question.frames.push_back(
      canopen::encode_sdo_write(settings.node, {canopen::kTargetVelocity, 0}, canopen::i32(0))));
  static_cast<void>(recipe.rounds.push_back(zero));
  static_cast<void>(recipe.rounds.push_back(question));
  recipe.period = milliseconds(10);
  // The guard sends no heartbeat. A drive that watches one and was not told how to stop without it
  // may fault, and lets go then.
  const bool may_fault = settings.watches() && !settings.has_abort_option;
  recipe.ends = may_fault ? StopEnds::coasts : StopEnds::holds;
  return recipe;
}

}  // namespace

Cia402Driver::Cia402Driver(const Settings& settings, AxisId axis)
    : settings_(settings),
      axis_(axis),
      hears_(all_of(settings)),
      rules_(rules_of(settings)),
      steps_(steps_of(settings)),
      setup_(settings.node, {steps_.data(), steps_.size()}),
      recipe_(recipe_of(settings)) {
  no_status_.format("no status (%03X)", static_cast<unsigned>(id_of(Cob::status, settings.node)));
  if (settings.stops_by_itself()) {
    silence_text_.format(
        "quick stop after %.3f s without a heartbeat (1016, 6007; set and read back at each start)",
        settings.silence_ms / 1000.0);
  } else if (!settings.has_consumer) {
    silence_text_ = "keeps its last velocity for ever: no_consumer_heartbeat";
  } else if (settings.silence_ms == 0) {
    silence_text_ = "keeps its last velocity for ever: silence_ms is 0";
  } else {
    silence_text_ = "does what its maker chose: no_abort_option";
  }
}

bool Cia402Driver::silent(Time now) const {
  return heard_.last_alive == kNever || now - heard_.last_alive > settings_.heartbeat_timeout;
}

bool Cia402Driver::lacks_status(Duration limit, Time now) const {
  return link_ == Link::ready && (last_status_ == kNever || now - last_status_ > limit);
}

void Cia402Driver::lock(std::string_view why) {
  phase_ = Phase::locked;
  fault_ = true;
  lock_reason_.assign(why);
}

/// Whatever was known may be of before a loss of its power.
void Cia402Driver::begin_setup(Time now) {
  link_ = Link::setting_up;
  link_since_ = now;
  may_hold_ = may_hold_ || held_;
  setup_.begin();
  status_ = {};
  command_ = {};
  last_status_ = kNever;
  position_.reset();
  error_ = 0;
}

/// Its answers alone may be lost: the gateway's heartbeat goes on, so a drive that was driving
/// would follow its last target for ever. What a person lets go of is told that, and is not enabled
/// again.
void Cia402Driver::feed_blindly(Time now, DriverOut& out) {
  // Told so, it may run though nobody heard that it does.
  may_hold_ = may_hold_ || command_.controlword == canopen::kEnableOperation;
  was_held_ = was_held_ || held_;
  if (request_ == AxisRequest::idle && now - phase_since_ > kIdleAtLast) {
    lets_go_ = lets_go_ || may_hold_ || was_held_ || canopen::is_powered(status_.state());
    may_hold_ = was_held_ = held_ = false;
    if (lets_go_ && now - phase_since_ <= kIdleAtLast + kToldOff)
      send({canopen::kDisableVoltage, 0}, now, out);
    return;
  }
  lets_go_ = false;
  if (may_hold_ || held_) send({canopen::kEnableOperation, 0}, now, out);
}

/// From silence to a node whose every object was read back and that says so.
void Cia402Driver::keep_link(Time now, DriverOut& out) {
  if (silent(now) && link_ != Link::silent) {
    link_ = Link::silent;
    next_question_ = now;
    if (attempts_to_run()) lock("heartbeat ceased while armed");
  }
  if (phase_ == Phase::running && lacks_status(settings_.heartbeat_timeout, now))
    lock(silent_text(no_status_.view(), settings_.heartbeat_timeout).view());
  if (link_ == Link::setting_up && setup_.failed() && now - link_since_ > kSetUpAgain)
    begin_setup(now);
  switch (link_) {
    case Link::silent:
      feed_blindly(now, out);
      // It may have been started long ago and say nothing unless it is asked.
      if (now < next_question_) return;
      next_question_ = now + kAskEach;
      out.send(canopen::encode_sdo_read(settings_.node, {canopen::kStatusword, 0}));
      return;
    case Link::setting_up:
      if (const auto frame = setup_.on_tick(now)) out.send(*frame);
      if (!setup_.done()) return;
      link_ = Link::starting;
      next_question_ = now;
      return;
    case Link::starting:
      if (now < next_question_) return;
      next_question_ = now + kAskEach;
      if (const auto start = canopen::encode_nmt(canopen::NmtCommand::operational, settings_.node))
        out.send(*start);
      return;
    case Link::ready: return ask_for_the_error(now, out);
  }
}

/// An emergency message is sent once; who missed it reads the error.
void Cia402Driver::ask_for_the_error(Time now, DriverOut& out) {
  if (status_.state() != DriveState::fault || error_ != 0 || now < next_question_) return;
  next_question_ = now + kAskEach;
  out.send(canopen::encode_sdo_read(settings_.node, {canopen::kErrorCode, 0}));
}

/// The gateway's heartbeat. After a pause of its own that was longer than the drive's patience the
/// drive has stopped, and the next word that enables would set it going.
void Cia402Driver::feed(Time now, DriverOut& out) {
  if (!settings_.watches()) return;
  const Duration patience = milliseconds(settings_.silence_ms);
  if (last_tick_ != kNever && now - last_tick_ > patience && attempts_to_run())
    lock("the gateway paused for longer than silence_ms");
  last_tick_ = now;
  if (last_fed_ != kNever && now - last_fed_ < patience / kFeedsInSilence) return;
  last_fed_ = now;
  out.send(canopen::encode_heartbeat(settings_.gateway_node, canopen::NodeState::operational));
}

/// What the newest status means for what is under way.
void Cia402Driver::follow_status(Time now) {
  const DriveState state = status_.state();
  const bool enabled = state == DriveState::operation_enabled;
  if (phase_ == Phase::running && !enabled) {
    lock(state == DriveState::fault ? "drive reports a fault" : "is no longer enabled");
  } else if (phase_ == Phase::arming) {
    if (enabled && now - phase_since_ >= kSettle) phase_ = Phase::running;
    if (state == DriveState::fault && reset_at_ != kNever && now - reset_at_ > kClearTime)
      lock("fault does not clear");
  }
}

/// Never more than was asked for: a ramp down to rest only falls.
std::int32_t Cia402Driver::target_of(double velocity_radps) {
  double rps = velocity_radps * settings_.gear_ratio * settings_.sign / (2 * std::numbers::pi);
  if (!std::isfinite(rps)) {
    ++bad_setpoints_;
    return 0;
  }
  const double most_rps = settings_.max_rpm / 60;
  if (std::abs(rps) > most_rps) {
    ++bad_setpoints_;
    rps = std::copysign(most_rps, rps);
  }
  return static_cast<std::int32_t>(rps * settings_.units_per_rps);
}

double Cia402Driver::radps_of(double units) const {
  return units / settings_.units_per_rps * 2 * std::numbers::pi * settings_.sign /
         settings_.gear_ratio;
}

void Cia402Driver::send(const Command& command, Time now, DriverOut& out) {
  const bool stops = command.target == 0 && command_.target != 0;
  const bool same_word = command.controlword == command_.controlword;
  if (same_word && !stops && now - last_command_ < settings_.setpoint_period) return;
  last_command_ = now;
  command_ = command;
  out.send(encode_command(settings_.node, command));
}

/// One transition at a time, each until the status tells of it.
void Cia402Driver::step_towards(canopen::DriveGoal goal, std::int32_t target, Time now,
                                DriverOut& out) {
  if (last_step_ != kNever && now - last_step_ < kStepEach) return;
  last_step_ = now;
  const bool may_reset = reset_at_ == kNever || now - reset_at_ <= kClearTime;
  const std::uint16_t word =
      canopen::next_controlword(goal, status_.state(), command_.controlword, may_reset);
  if (word == canopen::kFaultReset && reset_at_ == kNever) {
    reset_at_ = now;
    error_ = 0;
  }
  send({word, word == canopen::kEnableOperation ? target : 0}, now, out);
}

void Cia402Driver::control(std::int32_t target, Time now, DriverOut& out) {
  if (phase_ == Phase::arming && now - phase_since_ > settings_.arming_timeout)
    lock(setup_.failed() ? setup_.reason().view() : "does not become enabled");
  // Which word leaves it as it is, is known by its status only.
  if (link_ != Link::ready || last_status_ == kNever) return;
  switch (phase_) {
    case Phase::arming:
      // With the word that enables: one that rolls is caught at its own speed.
      return step_towards(canopen::DriveGoal::enabled, request_ == AxisRequest::hold ? target : 0,
                          now, out);
    case Phase::running: return send({canopen::kEnableOperation, target}, now, out);
    case Phase::idling: {
      const bool slow = std::abs(velocity_radps_) < kSlow_radps;
      if (slow || now - phase_since_ > kIdleAtLast)
        return step_towards(canopen::DriveGoal::off, 0, now, out);
      break;
    }
    case Phase::resting:
    case Phase::locked: break;
  }
  if (status_.state() != DriveState::unknown)
    send({keeping_controlword(status_.state()), 0}, now, out);
}

void Cia402Driver::take(AxisRequest request, Time now) {
  if (request == request_) return;
  const AxisRequest before = request_;
  request_ = request;
  phase_since_ = now;
  if (arms(request)) {
    fault_ = false;
    lock_reason_.clear();
    reset_at_ = kNever;
    phase_ = Phase::arming;
    if (silent(now)) lock("asked to run while the drive was silent");
    return;
  }
  phase_ = request == AxisRequest::idle ? Phase::idling : Phase::resting;
  if (!arms(before)) return;
  fault_ = false;
  lock_reason_.clear();
}

void Cia402Driver::on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut& out) {
  if (wanted.empty()) return;
  commanded_ = true;
  // What was heard knows more.
  held_ = wanted[0].held && heard_.last_alive == kNever;
  take(wanted[0].request, now);
  control(arms(wanted[0].request) ? target_of(wanted[0].velocity_radps) : 0, now, out);
}

void Cia402Driver::on_tick(Time now, DriverOut& out) {
  feed(now, out);
  if (!commanded_) control(0, now, out);  // nobody decided: zero, as at rest
  commanded_ = false;
  keep_link(now, out);
  report_status(now, false, out);
}

void Cia402Driver::on_link_up(Time now) {
  heard_.last_alive = last_status_ = kNever;
  link_ = Link::silent;
  next_question_ = now;
  status_ = {};
  command_ = {};
  position_.reset();
  if (arms(request_)) lock("the link was lost while armed");
}

Effect Cia402Driver::effect(const Message& message, Time) const {
  if (message.frame() == nullptr) return {};
  return cia402::effect(*message.frame(), settings_, steps_);
}

double Cia402Driver::setpoint_radps(const Message& message, std::size_t channel) const {
  if (message.frame() == nullptr || channel != 0) return kAbsent;
  const auto command = decode_command(*message.frame(), settings_.node);
  if (!command || command->controlword != canopen::kEnableOperation) return kAbsent;
  return radps_of(command->target);
}

/// A drive that calls the loss an error may let go after its stop, though 605A holds: the worse.
SilenceBehaviour Cia402Driver::silence() const {
  SilenceBehaviour behaviour;
  behaviour.stops = settings_.stops_by_itself();
  behaviour.after = milliseconds(behaviour.stops ? settings_.silence_ms : 0);
  behaviour.text = silence_text_.view();
  behaviour.ends = StopEnds::coasts;
  return behaviour;
}

}  // namespace drover::cia402
