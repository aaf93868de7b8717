// The second gate: which frames may leave on which bus.
#include "engine/gate/frame_gate.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace drover::engine {
namespace {

constexpr std::uint8_t kClassicLength = 8;

/// Set points travel in single precision.
constexpr double kRounding = 1 + 1e-6;

bool same_identity(const FrameRule& a, const FrameRule& b) {
  return a.id == b.id && a.extended == b.extended && a.remote == b.remote;
}

}  // namespace

bool matches(const FrameRule& rule, const CanFrame& frame) {
  // A rule that allows more than 8 bytes speaks of CAN FD; only then an FD frame is meant.
  return rule.id == frame.id && rule.extended == frame.extended && rule.remote == frame.remote &&
         frame.fd == (rule.max_len > kClassicLength) && frame.len >= rule.min_len &&
         frame.len <= rule.max_len;
}

void FrameGate::add(std::size_t bus, const Actuator& driver) {
  if (bus >= kMaxBuses) throw std::runtime_error("more CAN buses than the frame gate holds");
  for (const Sender& other : senders_) {
    if (other.bus != bus) continue;
    for (const FrameRule& mine : driver.rules()) {
      for (const FrameRule& theirs : other.driver->rules()) {
        if (!same_identity(mine, theirs)) continue;
        throw std::runtime_error("two drives of one bus send CAN id " + std::to_string(mine.id) +
                                 ": their node numbers are equal");
      }
    }
  }
  if (!senders_.push_back({bus, &driver})) {
    throw std::runtime_error("more CAN drives than the frame gate holds");
  }
}

void FrameGate::end_slowing(const Actuator& driver) {
  for (Sender& sender : senders_)
    if (sender.driver == &driver) sender.slowest_radps = std::numeric_limits<double>::infinity();
}

/// It never makes a wheel faster, and a ramp that has begun only falls.
bool FrameGate::slows(Sender& sender, const CanFrame& frame, const Slowing& slowing) {
  const double asked_radps = sender.driver->setpoint_radps(frame);
  const double size_radps = std::abs(asked_radps);
  const bool slower = size_radps <= kRounding * std::abs(slowing.measured_radps) &&
                      size_radps <= kRounding * sender.slowest_radps &&
                      asked_radps * slowing.measured_radps >= 0;
  if (slower) sender.slowest_radps = std::min(size_radps, sender.slowest_radps);
  return slower;  // false for what is not a number
}

FrameVerdict FrameGate::judge(std::size_t bus, const CanFrame& frame, const Actuator& from,
                              bool motion_possible, const Slowing& slowing) {
  if (frame.error) return FrameVerdict::refused_not_allowed;
  auto* const sender = std::find_if(senders_.begin(), senders_.end(), [&](const Sender& each) {
    return each.bus == bus && each.driver == &from;
  });
  if (sender == senders_.end()) return FrameVerdict::refused_not_allowed;
  const auto rules = from.rules();
  const bool listed = std::any_of(rules.begin(), rules.end(),
                                  [&](const FrameRule& rule) { return matches(rule, frame); });
  if (!listed) return FrameVerdict::refused_not_allowed;
  switch (from.effect(frame)) {
    case FrameEffect::stop:
      // The zeros of rest, before anything is caught, are no part of a ramp.
      if (slowing.permitted && from.setpoint_radps(frame) == 0) sender->slowest_radps = 0;
      return FrameVerdict::pass;
    case FrameEffect::harmless: return FrameVerdict::pass;
    case FrameEffect::motion:
      return motion_possible || (slowing.permitted && slows(*sender, frame, slowing))
                 ? FrameVerdict::pass
                 : FrameVerdict::refused_motion;
    case FrameEffect::forbidden: break;
  }
  return FrameVerdict::refused_not_allowed;
}

FrameVerdict FrameGate::admit(std::size_t bus, const CanFrame& frame, const Actuator& from,
                              bool motion_permitted, bool guard_has_bus, const Slowing& slowing) {
  if (bus >= kMaxBuses) return FrameVerdict::refused_not_allowed;
  const Slowing allowed{slowing.permitted && !guard_has_bus, slowing.measured_radps};
  const FrameVerdict verdict = judge(bus, frame, from, motion_permitted && !guard_has_bus, allowed);
  Counts& counts = counts_[bus];
  switch (verdict) {
    case FrameVerdict::pass: ++counts.passed; break;
    case FrameVerdict::refused_not_allowed: ++counts.not_allowed; break;
    case FrameVerdict::refused_motion: ++counts.motion; break;
  }
  return verdict;
}

}  // namespace drover::engine
