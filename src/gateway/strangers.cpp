#include "gateway/strangers.h"

#include <algorithm>

namespace drover::gateway {
namespace {

using namespace std::chrono_literals;

constexpr Duration kSilent = 3s;  // longer than a device takes to come up behind its line
constexpr Duration kSpeaks = 1s;  // ago, at most

}  // namespace

bool Strangers::knows(const CanFrame& frame) const {
  const auto is_it = [&](const Id& id) {
    return id.id == frame.id && id.extended == frame.extended;
  };
  return ids_.size() == ids_.capacity() || std::any_of(ids_.begin(), ids_.end(), is_it);
}

void Strangers::on_frame(const CanFrame& frame, Time received) {
  if (since_ == kNever || received - last_ > kSpeaks) {
    clear();
    since_ = received;
  }
  last_ = received;
  if (!knows(frame)) (void)ids_.push_back({frame.id, frame.extended});
}

void Strangers::clear() {
  ids_.clear();
  since_ = last_ = kNever;
}

Reason Strangers::text(std::string_view bus, Time last_heard, bool others_heard, Time now) const {
  if (since_ == kNever || now - since_ < kSilent || now - last_ > kSpeaks) return {};
  const bool never = last_heard == kNever;
  if (!never && now - last_heard < kSilent) return {};
  Name ids;
  constexpr std::size_t kShown = 3;
  for (std::size_t i = 0; i < std::min(ids_.size(), kShown); ++i) {
    Name id;
    id.format(ids_[i].extended ? "%s0x%08X" : "%s0x%03X", i == 0 ? "" : ", ",
              static_cast<unsigned>(ids_[i].id));
    ids.append(id);
  }
  if (ids_.size() > kShown) ids.append(", …");
  Reason text;
  text.format("%s; frames of other devices come on %.*s (%.*s): %s",
              never ? "never heard" : "silent", static_cast<int>(bus.size()), bus.data(),
              static_cast<int>(ids.view().size()), ids.view().data(),
              others_heard ? "is its id another one?" : "are the buses swapped, or its id wrong?");
  return text;
}

}  // namespace drover::gateway
