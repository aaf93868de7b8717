// The second gate: which frames may leave on which bus.
#include "engine/gate/frame_gate.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace drover::engine {
namespace {

constexpr std::uint8_t kClassicLength = 8;

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

void FrameGate::add(std::size_t bus, const CanDriver& driver) {
  if (bus >= kMaxBuses) throw std::runtime_error("more CAN buses than the frame gate holds");
  for (const Sender& other : senders_) {
    if (other.bus != bus) continue;
    for (const FrameRule& mine : driver.allow_list()) {
      for (const FrameRule& theirs : other.driver->allow_list()) {
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

FrameVerdict FrameGate::judge(std::size_t bus, const CanFrame& frame, const CanDriver& from,
                              bool motion_possible) const {
  if (frame.error) return FrameVerdict::refused_not_allowed;
  const bool known = std::any_of(senders_.begin(), senders_.end(), [&](const Sender& sender) {
    return sender.bus == bus && sender.driver == &from;
  });
  if (!known) return FrameVerdict::refused_not_allowed;
  const auto rules = from.allow_list();
  const bool listed = std::any_of(rules.begin(), rules.end(),
                                  [&](const FrameRule& rule) { return matches(rule, frame); });
  if (!listed) return FrameVerdict::refused_not_allowed;
  switch (from.effect(frame)) {
    case FrameEffect::harmless:
    case FrameEffect::stop: return FrameVerdict::pass;
    case FrameEffect::motion:
      return motion_possible ? FrameVerdict::pass : FrameVerdict::refused_motion;
    case FrameEffect::forbidden: break;
  }
  return FrameVerdict::refused_not_allowed;
}

FrameVerdict FrameGate::admit(std::size_t bus, const CanFrame& frame, const CanDriver& from,
                              bool motion_permitted, bool guard_has_bus) {
  if (bus >= kMaxBuses) return FrameVerdict::refused_not_allowed;
  const FrameVerdict verdict = judge(bus, frame, from, motion_permitted && !guard_has_bus);
  Counts& counts = counts_[bus];
  switch (verdict) {
    case FrameVerdict::pass: ++counts.passed; break;
    case FrameVerdict::refused_not_allowed: ++counts.not_allowed; break;
    case FrameVerdict::refused_motion: ++counts.motion; break;
  }
  return verdict;
}

}  // namespace drover::engine
