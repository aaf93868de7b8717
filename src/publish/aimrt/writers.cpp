#include "publish/aimrt/writers.h"

#include <algorithm>
#include <cmath>

#include "json/located_json.h"

namespace drover::publish::aimrt {

namespace {

constexpr Duration kShownFor = std::chrono::seconds(1);
constexpr double kMostMessages_Hz = 1000;  // a count that jumps further is another program's
constexpr double kJump_radps = 0.5;
constexpr double kSame_radps = 0.25;
// A fifth of a radian in a hundredth of a second is no joint's way.
constexpr double kJump_rad = 0.2;
constexpr double kSame_rad = 0.1;

/// "JointCommandArray (json)", and the frame where there is one; or the writer of DDS.
std::string shown(const Writer& writer, bool with_frame) {
  if (!writer.guid.empty()) return json::shown(writer.guid, 48);
  std::string text(type_name(Role::joint_command, writer.names));
  text += " (" + std::string(spelling(writer.content));
  if (with_frame) text += ", frame_id '" + json::shown(writer.frame_id, 12) + "'";
  return text + ")";
}

std::string both(const Writer& owner, const Writer& other) {
  const bool of_broker = owner.guid.empty() && other.guid.empty();
  const bool same_form = of_broker && owner.names == other.names && owner.content == other.content;
  const bool same_frame = owner.frame_id == other.frame_id;
  if (!same_form || !same_frame) {
    return "two programs write joint commands: " + shown(owner, !same_frame) + " has the joints, " +
           shown(other, !same_frame) + " is refused";
  }
  const bool stamps = (owner.stamp_ns == 0) != (other.stamp_ns == 0);
  return "two programs write joint commands as " + shown(owner, false) +
         (stamps ? ", one with time_stamp and one without" : ", each with its sequence_num") +
         ": the one that has the joints goes on";
}

/// The same program's count, or neither counts. `counts`: `last` was not its first message, which
/// may have had number 0. `missed`: how many in between may have been lost.
bool continues(std::uint64_t last, bool counts, std::uint64_t next, std::uint64_t missed) {
  if (next == 0) return last == 0;
  if (last == 0 && counts) return false;
  return next >= last && next - last <= missed + 1;
}

}  // namespace

bool Writers::is_owner(const Writer& writer) const {
  if (!owner_ || owner_->guid != writer.guid) return false;
  if (!writer.guid.empty()) return true;
  return owner_->names == writer.names && owner_->content == writer.content &&
         owner_->frame_id == writer.frame_id && (owner_->stamp_ns == 0) == (writer.stamp_ns == 0) &&
         continues(owner_->sequence, counts_, writer.sequence,
                   static_cast<std::uint64_t>(kMostMessages_Hz * to_s(silence_)));
}

Reason Writers::refuse(std::string why, Time now) {
  text_ = std::move(why);
  told_ = now;
  ++refused_;
  return Reason(text_);
}

Reason Writers::hindrance(const Writer& writer, bool rests, Time now) {
  if (!owner_) return {};
  if (is_owner(writer)) {
    // An old message after a newer one that was followed: one program sends in order.
    const bool late = writer.guid.empty() && writer.stamp_ns < owner_->stamp_ns;
    if (!late || !std::exchange(followed_since_late_, false) || oddities_.take(now)) return {};
    return refuse("two programs seem to write joint commands as " + shown(writer, false) +
                      ": their time stamps interleave, the older ones are refused",
                  now);
  }
  if (now - heard_ <= silence_) return refuse(both(*owner_, writer), now);
  // Else it could drive on in the middle of what the first one began.
  if (!rests) return "a stream of joint commands begins with velocity 0";
  return {};
}

/// Up and down again within three messages: two programs by turns, one of which may be at rest. Of
/// a joint that a message does not name it says nothing.
bool Writers::jumps_to_and_fro(const JointTargets& targets) {
  const auto apart = [](const std::optional<Asked>& then, const Asked& now, double radps,
                        double rad) {
    return then && (std::abs(then->velocity_radps - now.velocity_radps) >= radps ||
                    std::abs(then->position_rad - now.position_rad) >= rad);
  };
  const auto near = [&](const std::optional<Asked>& then, const Asked& now) {
    return then && !apart(then, now, kSame_radps, kSame_rad);
  };
  bool jumps = false;
  for (const auto& joint : targets.joints) {
    const Asked now{joint.velocity_radps, joint.position_rad};
    Asks& before = before_[joint.axis];
    const bool jump = apart(before[0], now, kJump_radps, kJump_rad);
    jumps = jumps || (jump && (near(before[1], now) || near(before[2], now)));
    before = {now, before[0], before[1]};
  }
  return jumps;
}

Reason Writers::weigh(const Writer& writer, const JointTargets& targets, Time now) {
  const bool goes_on = is_owner(writer);
  if (!goes_on || now - heard_ > silence_) before_.fill({});
  // Two that began together count alike: each number comes twice, and not from one program.
  const bool again = goes_on && writer.sequence != 0 && writer.sequence == owner_->sequence;
  const bool twice = again && writer.stamp_ns != owner_->stamp_ns;
  if (twice) counted_twice_ = now;
  const bool told_apart =
      !writer.guid.empty() || (writer.sequence != 0 && now - counted_twice_ > kShownFor);
  if (jumps_to_and_fro(targets) && !told_apart && !oddities_.take(now))
    mixed_until_ = now + kShownFor;
  if (now >= mixed_until_) {
    if (!twice || !writer.guid.empty() || oddities_.take(now)) return {};
    return refuse("two programs seem to write joint commands as " + shown(writer, false) +
                      ": each sequence_num comes twice, the second is refused",
                  now);
  }
  return refuse("two programs seem to write joint commands as " + shown(writer, false) +
                    ": the velocities jump to and fro, none is followed",
                now);
}

void Writers::take(const Writer& writer, Time now) {
  counts_ = is_owner(writer);
  owner_ = writer;
  heard_ = now;
  followed_since_late_ = true;
}

std::string_view Writers::rivals(Time now) const {
  return told_ != kNever && now - told_ <= kShownFor ? std::string_view(text_) : "";
}

}  // namespace drover::publish::aimrt
