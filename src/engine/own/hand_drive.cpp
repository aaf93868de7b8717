// A person drives with a key that is held down: the dead-man, and when he may begin.
#include "engine/own/hand_drive.h"

#include <algorithm>
#include <cmath>

namespace drover::engine {
namespace {

constexpr const char* kOthers = "somebody else drives by hand";

}  // namespace

HandDrive::Rival& HandDrive::rival(std::uint64_t hand) {
  const auto his = std::find_if(rivals_.begin(), rivals_.end(),
                                [&](const Rival& each) { return each.hand == hand; });
  if (his != rivals_.end()) return *his;
  return *std::min_element(rivals_.begin(), rivals_.end(),
                           [](const Rival& a, const Rival& b) { return a.key < b.key; });
}

/// Another one begins anew, as everybody: he takes nothing over. A key of his that was turned away
/// is none before it is let go.
void HandDrive::change_hands(std::uint64_t to, Time at) {
  const Rival& his = rival(to);
  const bool pressed = his.hand == to && his.key != kNever && at - his.key <= kHeld;
  hand_ = to;
  active_ = moves_ = false;
  row_ = key_ = pressed ? his.key : kNever;
  spoiled_ = pressed;
  ended_ = kOthers;
}

/// A key, or one more of a row.
void HandDrive::press(const Reason& busy, Time at) {
  if (!holds(at)) {
    row_ = at;
    spoiled_ = false;
  }
  if (row_ == kNever) row_ = at;  // he said meanwhile that the key is up
  key_ = at;
  if (!busy.empty() && !spoiled_) {
    spoiled_ = true;
    ended_ = busy;
  }
}

void HandDrive::take(const Command& command, const DriveByHand& wanted, const Reason& busy,
                     const Reason& note, Time now, EventQueue& events) {
  const auto refuse = [&](const Reason& why) { events.push(now, CommandRefused{command.id, why}); };
  const bool finite = std::isfinite(wanted.twist.vx_mps) && std::isfinite(wanted.twist.wz_radps);
  if (!finite) return refuse("a speed that cannot be");
  const Time at = command.received == kNever ? now : std::min(command.received, now);
  if (now - at > kHeld) return refuse("it came too late to be a key that is held");
  const bool others = hand_ != wanted.hand && heard_ != kNever && now - heard_ <= kLasts;
  if (others) {
    if (!is_zero(wanted.twist)) rival(wanted.hand) = {wanted.hand, at};
    return refuse(kOthers);
  }
  if (hand_ != wanted.hand) change_hands(wanted.hand, at);
  heard_ = at;
  if (is_zero(wanted.twist)) {
    moves_ = false;
    row_ = kNever;
    if (!busy.empty()) return refuse(busy);
    return events.push(now, CommandAccepted{command.id, note});
  }
  press(busy, at);
  if (!busy.empty()) return refuse(busy);
  if (spoiled_) {
    Reason why;
    const std::string_view what = ended_;
    why.format("let the key go first: %.*s", static_cast<int>(what.size()), what.data());
    return refuse(why);
  }
  active_ = true;
  wanted_ = wanted.twist;
  moves_ = at - row_ >= kHeld;
  events.push(now, CommandAccepted{command.id, note});
}

void HandDrive::end(const Reason& why, Time now, EventQueue& events) {
  if (holds(now) && !spoiled_) {
    spoiled_ = true;
    ended_ = why;
  }
  if (!active_) return;
  const bool moved = moves_;
  active_ = moves_ = false;
  if (!moved) return;
  Reason text;
  const std::string_view what = why;
  text.format("no longer driven by hand: %.*s", static_cast<int>(what.size()), what.data());
  events.notice(now, Notice::Level::warning, text);
}

void HandDrive::step(Time now) {
  if (!holds(now)) moves_ = false;
  if (active_ && now - heard_ > kLasts) active_ = moves_ = false;
}

}  // namespace drover::engine
