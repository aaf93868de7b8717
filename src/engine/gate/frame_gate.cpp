// The second gate: which messages may leave on which link.
#include "engine/gate/frame_gate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>

namespace drover::engine {
namespace {

/// Set points travel in single precision.
constexpr double kRounding = 1 + 1e-6;

constexpr double kNoRamp = std::numeric_limits<double>::infinity();

bool same_identity(const FrameRule& a, const FrameRule& b) {
  return a.id == b.id && a.extended == b.extended && a.remote == b.remote;
}

/// As candump and data sheets write it.
std::string hex(const FrameRule& rule) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), rule.extended ? "0x%08X" : "0x%03X",
                static_cast<unsigned>(rule.id));
  return text.data();
}

bool listed(const Message& message, const Actuator& from) {
  if (message.frame() == nullptr) return true;  // a packet is judged by what is in it alone
  const CanFrame& frame = *message.frame();
  if (frame.error) return false;
  const auto rules = from.rules();
  return std::any_of(rules.begin(), rules.end(),
                     [&](const FrameRule& rule) { return matches(rule, frame); });
}

bool is_slowed(const Permission& permission, std::size_t channel) {
  return !permission.guard_has_bus && channel < permission.slowing.size() &&
         permission.slowing[channel].permitted;
}

bool takes_twist(const Actuator& driver, std::size_t channel) {
  return driver.channels()[channel].mode == ChannelMode::twist;
}

}  // namespace

void FrameGate::add(std::size_t link, const Actuator& driver) {
  if (link >= kMaxLinks) throw std::runtime_error("more links than the frame gate holds");
  for (const Sender& other : senders_) {
    if (other.link != link) continue;
    for (const FrameRule& mine : driver.rules()) {
      for (const FrameRule& theirs : other.driver->rules()) {
        if (!same_identity(mine, theirs) || (mine.shared && theirs.shared)) continue;
        throw std::runtime_error("two drives of one bus send CAN id " + hex(mine) +
                                 ": their node numbers are equal");
      }
    }
  }
  slowest_[std::min(senders_.size(), kMaxAxes - 1)].fill({kNoRamp, kNoRamp});
  if (!senders_.push_back({link, &driver})) {
    throw std::runtime_error("more drives than the frame gate holds");
  }
}

/// senders_.size(): it was never told of it.
std::size_t FrameGate::place_of(const Actuator& driver) const {
  const auto is = [&](const Sender& each) { return each.driver == &driver; };
  // They speak in turn: it is the one of before, or the next.
  for (const std::size_t guess : {asked_, asked_ + 1})
    if (guess < senders_.size() && is(senders_[guess])) return asked_ = guess;
  const auto* const it = std::find_if(senders_.begin(), senders_.end(), is);
  return asked_ = static_cast<std::size_t>(it - senders_.begin());
}

void FrameGate::end_slowing(const Actuator& driver, std::size_t channel) {
  const std::size_t place = place_of(driver);
  if (place < senders_.size() && channel < kMaxChannels)
    slowest_[place][channel] = {kNoRamp, kNoRamp};
}

FrameGate::Parts FrameGate::asked_of(const Actuator& driver, const Message& message,
                                     std::size_t channel) {
  if (!takes_twist(driver, channel)) return {driver.setpoint_radps(message, channel), 0};
  const Twist asked = driver.setpoint_twist(message, channel);
  return {asked.vx_mps, asked.wz_radps};
}

/// No faster than the wheel or the base, in its direction, and than the set point before. False for
/// what is not a number.
bool FrameGate::is_slower(const Parts& asked, const Actuator& driver, std::size_t channel,
                          const Slowing& slowing, const Parts& slowest) {
  const Parts measured = takes_twist(driver, channel)
                             ? Parts{slowing.measured.vx_mps, slowing.measured.wz_radps}
                             : Parts{slowing.measured_radps, 0};
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const double size = std::abs(asked[i]);
    const bool slower = size <= kRounding * std::abs(measured[i]) &&
                        size <= kRounding * slowest[i] && asked[i] * measured[i] >= 0;
    if (!slower && asked[i] != 0) return false;
  }
  return true;
}

/// The next set point of a ramp is no faster.
void FrameGate::note(std::size_t sender, std::size_t channel, const Parts& asked) {
  Parts& slowest = slowest_[sender][channel];
  for (std::size_t i = 0; i < asked.size(); ++i)
    slowest[i] = std::min(std::abs(asked[i]), slowest[i]);
}

/// Each channel is permitted, or slowed.
bool FrameGate::may_move(std::size_t sender, const Message& message, ChannelMask moves,
                         const Permission& permission) {
  const ChannelMask permitted = permission.guard_has_bus ? ChannelMask{0} : permission.motion;
  const auto others = static_cast<ChannelMask>(moves & ~permitted);
  if (others != 0 && !may_slow(sender, message, others, permission)) return false;
  note_zeros(sender, message, permission);
  return true;
}

/// Each of them is slowed: a ramp that has begun only falls.
bool FrameGate::may_slow(std::size_t sender, const Message& message, ChannelMask moves,
                         const Permission& permission) {
  const Actuator& driver = *senders_[sender].driver;
  std::array<Parts, kMaxChannels> asked{};
  for (std::size_t channel = 0; channel < kMaxChannels; ++channel) {
    if ((moves & channel_bit(channel)) == 0) continue;
    if (!is_slowed(permission, channel)) return false;
    asked[channel] = asked_of(driver, message, channel);
    if (!is_slower(asked[channel], driver, channel, permission.slowing[channel],
                   slowest_[sender][channel]))
      return false;
  }
  for (std::size_t channel = 0; channel < kMaxChannels; ++channel)
    if ((moves & channel_bit(channel)) != 0) note(sender, channel, asked[channel]);
  return true;
}

/// What is asked to rest ends its ramp there, be it by a stop or beside a motion of the others.
void FrameGate::note_zeros(std::size_t sender, const Message& message,
                           const Permission& permission) {
  const Actuator& driver = *senders_[sender].driver;
  const std::size_t channels = std::min(permission.slowing.size(), driver.channels().size());
  for (std::size_t channel = 0; channel < channels; ++channel) {
    if (!is_slowed(permission, channel)) continue;
    const Parts asked = asked_of(driver, message, channel);
    if (asked == Parts{}) note(sender, channel, asked);
  }
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
