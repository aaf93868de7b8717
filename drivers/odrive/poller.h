// Asks a drive for what it does not send by itself: rarely, one frame at a time.
#pragma once

#include "drivers/odrive/rules.h"

namespace drover::odrive {

class Poller {
 public:
  explicit Poller(const Settings& settings)
      : node_(settings.node),
        commands_(polled_commands(settings.firmware)),
        errors_(error_commands(settings.firmware)),
        interval_(settings.poll_period / static_cast<int>(commands_.size())) {}

  /// Asks for the errors with the next ticks: something went wrong.
  void hurry() { urgent_ = 0; }
  /// Starts over, with the nodes of a bus spread in time.
  void restart(Time now) {
    next_ = now + interval_ * (node_ % 8) / 8;
    urgent_ = errors_.size();
  }
  void on_tick(Time now, DriverOut& out) {
    if (urgent_ < errors_.size()) {
      out.send(encode_poll(node_, errors_[urgent_++]));
      return;
    }
    if (interval_ <= Duration{} || now < next_) return;
    next_ = now + interval_;
    out.send(encode_poll(node_, commands_[position_]));
    position_ = (position_ + 1) % commands_.size();
  }

 private:
  std::uint8_t node_;
  std::span<const std::uint8_t> commands_;
  std::span<const std::uint8_t> errors_;
  Duration interval_;
  std::size_t urgent_ = SIZE_MAX;
  std::size_t position_ = 0;
  Time next_ = kNever;
};

}  // namespace drover::odrive
