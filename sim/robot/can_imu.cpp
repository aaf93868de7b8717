#include "sim/robot/can_imu.h"

namespace drover::sim {

void CanImu::on_frame(std::size_t bus, const CanFrame& frame, Time now) {
  if (plugged_ && bus == bus_ && !frame.error) twin_->on_frame(frame, now, answers_);
}

void CanImu::step(Time now, const ImuTruth& truth) {
  sent_ = answers_;
  answers_.clear();
  if (plugged_) twin_->on_tick(now, truth, sent_);
}

// Its supply comes with its bus, in one cable.
bool CanImu::command(std::string_view what, Time now) {
  if (what == "unplug") {
    plugged_ = false;
    answers_.clear();
    return true;
  }
  if (what != "plug") return twin_->set_state(what == "well" ? "" : what, now);
  plugged_ = true;
  return twin_->set_state("restart", now);
}

}  // namespace drover::sim
