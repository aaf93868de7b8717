#include "gateway/foreign_watch.h"

namespace drover::gateway {
namespace {

using namespace std::chrono_literals;

constexpr Duration kHabit = 300ms;     // of frames that follow each other
constexpr Duration kGap = 200ms;       // longer between two: another story
constexpr Duration kOver = 1s;         // nothing more for so long
constexpr Duration kGuardEchoes = 1s;  // the guard's frames wait in queues, too

}  // namespace

void ForeignWatch::on_stop_frame(std::uint32_t id, std::string_view bus, Time at) {
  if (guard_at_ != kNever && at - guard_at_ < kGuardEchoes) return;
  if (since_ == kNever || at - last_ > kGap) since_ = at;
  last_ = at;
  id_ = id;
  bus_ = Name(bus);
}

void ForeignWatch::update(Time now, bool guard_may_send) {
  if (guard_may_send) {
    guard_at_ = now;
    since_ = kNever;
  }
  if (since_ == kNever || now - last_ > kOver) {
    since_ = kNever;
    reason_.clear();
    return;
  }
  if (last_ - since_ < kHabit) return;
  const std::string_view bus = bus_;
  reason_.format("somebody else commands the drives: id 0x%03X on %.*s; is there a second gateway?",
                 static_cast<unsigned>(id_), static_cast<int>(bus.size()), bus.data());
}

}  // namespace drover::gateway
