// The second gate: which messages may leave on which link.
#include "engine/gate/frame_gate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace drover::engine {
namespace {

constexpr std::uint8_t kClassicLength = 8;

/// Set points travel in single precision.
constexpr double kRounding = 1 + 1e-6;

constexpr double kNoRamp = std::numeric_limits<double>::infinity();

bool same_identity(const FrameRule& a, const FrameRule& b) {
  return a.id == b.id && a.extended == b.extended && a.remote == b.remote;
}

bool listed(const Message& message, const Actuator& from) {
  if (message.frame() == nullptr) return true;  // a packet is judged by what is in it alone
  const CanFrame& frame = *message.frame();
  if (frame.error) return false;
  const auto rules = from.rules();
  return std::any_of(rules.begin(), rules.end(),
                     [&](const FrameRule& rule) { return matches(rule, frame); });
}

/// No faster than the wheel, in its direction, and than the set point before.
bool is_slower(double asked_radps, const Slowing& slowing, double slowest_radps) {
  const double size_radps = std::abs(asked_radps);
  return size_radps <= kRounding * std::abs(slowing.measured_radps) &&
         size_radps <= kRounding * slowest_radps &&
         asked_radps * slowing.measured_radps >= 0;  // false for what is not a number
}

bool is_slowed(const Permission& permission, std::size_t channel) {
  return !permission.guard_has_bus && channel < permission.slowing.size() &&
         permission.slowing[channel].permitted;
}

}  // namespace

bool matches(const FrameRule& rule, const CanFrame& frame) {
  // A rule that allows more than 8 bytes speaks of CAN FD; only then an FD frame is meant.
  return rule.id == frame.id && rule.extended == frame.extended && rule.remote == frame.remote &&
         frame.fd == (rule.max_len > kClassicLength) && frame.len >= rule.min_len &&
         frame.len <= rule.max_len;
}

void FrameGate::add(std::size_t link, const Actuator& driver) {
  if (link >= kMaxLinks) throw std::runtime_error("more links than the frame gate holds");
  for (const Sender& other : senders_) {
    if (other.link != link) continue;
    for (const FrameRule& mine : driver.rules()) {
      for (const FrameRule& theirs : other.driver->rules()) {
        if (!same_identity(mine, theirs) || (mine.shared && theirs.shared)) continue;
        throw std::runtime_error("two drives of one bus send CAN id " + std::to_string(mine.id) +
                                 ": their node numbers are equal");
      }
    }
  }
  slowest_radps_[std::min(senders_.size(), kMaxAxes - 1)].fill(kNoRamp);
  if (!senders_.push_back({link, &driver})) {
    throw std::runtime_error("more drives than the frame gate holds");
  }
}

/// senders_.size(): it was never told of it.
std::size_t FrameGate::place_of(const Actuator& driver) const {
  const auto* const it = std::find_if(senders_.begin(), senders_.end(),
                                      [&](const Sender& each) { return each.driver == &driver; });
  return static_cast<std::size_t>(it - senders_.begin());
}

void FrameGate::end_slowing(const Actuator& driver, std::size_t channel) {
  const std::size_t place = place_of(driver);
  if (place < senders_.size() && channel < kMaxChannels) slowest_radps_[place][channel] = kNoRamp;
}

/// Each channel is permitted, or slowed: a ramp that has begun only falls.
bool FrameGate::may_move(std::size_t sender, const Message& message, ChannelMask moves,
                         const Permission& permission) {
  const Actuator& driver = *senders_[sender].driver;
  Slowest asked_radps{};
  ChannelMask slowed = 0;
  for (std::size_t channel = 0; channel < driver.channels().size(); ++channel) {
    const ChannelMask bit = channel_bit(channel);
    if ((moves & bit) == 0) continue;
    if ((permission.motion & bit) != 0 && !permission.guard_has_bus) continue;
    if (!is_slowed(permission, channel)) return false;
    asked_radps[channel] = driver.setpoint_radps(message, channel);
    if (!is_slower(asked_radps[channel], permission.slowing[channel],
                   slowest_radps_[sender][channel]))
      return false;
    slowed |= bit;
  }
  for (std::size_t channel = 0; slowed != 0 && channel < kMaxChannels; ++channel) {
    double& slowest = slowest_radps_[sender][channel];
    if ((slowed & channel_bit(channel)) != 0)
      slowest = std::min(std::abs(asked_radps[channel]), slowest);
  }
  return true;
}

/// The zeros of rest, before anything is caught, are no part of a ramp.
void FrameGate::note_zeros(std::size_t sender, const Message& message,
                           const Permission& permission) {
  for (std::size_t channel = 0; channel < permission.slowing.size(); ++channel)
    if (is_slowed(permission, channel) &&
        senders_[sender].driver->setpoint_radps(message, channel) == 0)
      slowest_radps_[sender][channel] = 0;
}

FrameVerdict FrameGate::judge(std::size_t link, const Message& message, const Actuator& from,
                              const Permission& permission, Time now) {
  const std::size_t sender = place_of(from);
  if (sender == senders_.size() || senders_[sender].link != link || !listed(message, from))
    return FrameVerdict::refused_not_allowed;
  const Effect effect = from.effect(message, now);
  switch (effect.kind) {
    case FrameEffect::stop: note_zeros(sender, message, permission); return FrameVerdict::pass;
    case FrameEffect::harmless: return FrameVerdict::pass;
    case FrameEffect::motion:
      // A motion of nothing, or of what it does not have, is a mistake of the driver's.
      if (effect.moves == 0 || effect.moves >> from.channels().size() != 0) break;
      return may_move(sender, message, effect.moves, permission) ? FrameVerdict::pass
                                                                 : FrameVerdict::refused_motion;
    case FrameEffect::forbidden: break;
  }
  return FrameVerdict::refused_not_allowed;
}

FrameVerdict FrameGate::admit(std::size_t link, const Message& message, const Actuator& from,
                              const Permission& permission, Time now) {
  if (link >= kMaxLinks) return FrameVerdict::refused_not_allowed;
  const FrameVerdict verdict = judge(link, message, from, permission, now);
  Counts& counts = counts_[link];
  switch (verdict) {
    case FrameVerdict::pass: ++counts.passed; break;
    case FrameVerdict::refused_not_allowed: ++counts.not_allowed; break;
    case FrameVerdict::refused_motion: ++counts.motion; break;
  }
  return verdict;
}

}  // namespace drover::engine
