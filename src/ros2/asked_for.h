// What ROS 2 users ask for, until droverd is told: a stop, twists, and what was refused of them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "drover/time.h"
#include "ros2/twists_heard.h"

namespace drover::ros2 {

/// A stop goes before everything else, and is told again and again until it has left, and on each
/// new way until droverd has answered. Of twists the newest goes on, and what was refused, neither
/// faster than droverd takes them. Pure.
class AskedFor final {
 public:
  /// `name`: nobody else's, so that droverd does each stop once, however often it is told; empty:
  /// it cannot know.
  explicit AskedFor(std::string name = {}) : name_(std::move(name)) {}

  /// An emergency stop; of more that come in rows ten a second are told, and the last one.
  void stop() {
    stop_waits_ = true;
    ++stop_number_;
  }
  void hear(const TwistsHeard& heard);
  /// droverd has done what a line asked for, which it says of stops only, in their order.
  void answered();
  /// droverd could not do it: it is told again.
  void stop_refused();
  std::uint64_t stops_refused() const { return stops_refused_; }
  /// The way to droverd is lost: a stop that it has not answered it may not have read. True: there
  /// is one, and it is told again.
  bool way_lost();
  /// A stop that droverd has not answered, or that has not left.
  bool stop_is_open() const { return stop_waits_ || unanswered_ > 0; }
  /// There is no later: what waits to be told ten times a second is due now.
  void hurry() { stop_tried_ = kNever; }
  /// There is nobody any more who asked. A stop stays.
  void forget_twists();

  /// A stop has not left yet.
  bool stop_waits() const { return stop_waits_; }
  /// And tell() tries it now.
  bool stop_is_due(Time now) const;
  /// When tell() has something to send; none: it has nothing.
  std::optional<Time> due() const;
  /// Hands what is due to `send`, which says whether it has left.
  void tell(Time now, const std::function<bool(const std::string&)>& send);

 private:
  struct Waiting {
    Twist twist;
    Time said = kNever;
  };
  std::string stop_line() const;

  std::string name_;
  std::int64_t stop_number_ = 0;  ///< of the newest; one that is told again has its own again
  bool stop_waits_ = false;
  Time stop_tried_ = kNever;
  unsigned unanswered_ = 0;  ///< stops that have left
  std::uint64_t stops_refused_ = 0;
  std::optional<Waiting> twist_;
  bool moved_ = false;  ///< one since the last that was handed on was no zero
  Time handed_on_ = kNever;
  std::string refused_;  ///< the newest reason, not told yet
  bool rivals_ = false;
  Time refused_told_ = kNever;
};

}  // namespace drover::ros2
