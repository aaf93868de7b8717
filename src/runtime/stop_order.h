// The order of stops: which of them were heard on both connections, what came after one that has
// overtaken it, and which are obeyed and to be answered. Publish thread's; neither waits nor sends.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "drover/command.h"
#include "publish/arrival.h"
#include "runtime/heard_twice.h"
#include "runtime/stop_requests.h"

namespace drover::runtime {

/// A stop that was asked for already; its answer is the publish thread's.
struct HeardStop {
  std::string payload;
  publish::Retain retain = publish::Retain::no;
  StopCounts asked;  ///< what must be obeyed before it is
};

/// Whoever hears nothing but stops: StopListener.
class HearsStops {
 public:
  virtual ~HearsStops() = default;
  virtual bool connected() const = 0;
  virtual bool take(HeardStop& heard) = 0;
  /// Of a flood of stops some are not told by take(): they were asked for all the same.
  virtual std::uint64_t lost() const = 0;
  /// Whether a stop was, or is about to be, asked for that take() has not told yet. Read it after
  /// StopRequests::asked(): then each stop that is counted there is known here.
  virtual bool knows_more() const = 0;
};

class StopOrder final {
 public:
  /// `alone`: nullptr where there is no second connection.
  explicit StopOrder(HearsStops* alone) : alone_(alone) {}

  /// A stop of this text came with all other messages. When it was heard alone before, and was
  /// carried out then: when that was.
  std::optional<Time> heard_before(std::string_view payload, Time now) {
    return heard_twice_.again(Way::with_others, payload, now);
  }
  /// Whether what comes with the others may have been sent before a stop that was heard alone.
  bool overtaken(Time now) {
    hear(now);
    return (alone_ != nullptr && alone_->knows_more()) || heard_twice_.overtook(now);
  }
  /// Whether a stop that came with the others just now is still to be heard alone.
  bool expects_other_self(Time now) {
    if (alone_ == nullptr || !alone_->connected()) return false;
    hear(now);
    return heard_twice_.expects(now);
  }
  /// Takes over what was heard alone.
  void hear(Time now) {
    if (alone_ == nullptr) return;
    HeardStop heard;
    while (alone_->take(heard))
      if (!heard_twice_.again(Way::alone, heard.payload, now)) heard_.push_back(std::move(heard));
    if (const auto lost = alone_->lost(); lost != lost_) {
      lost_ = lost;
      heard_twice_.lost(now);
    }
  }
  /// The connection with all other messages is a new one: what was heard alone until now was lost
  /// there.
  void begin_anew(Time now) {
    hear(now);
    heard_twice_.begin_anew();
  }
  /// The next one of those that came alone first: to be answered.
  std::optional<HeardStop> next_heard() {
    if (heard_.empty()) return std::nullopt;
    auto stop = std::move(heard_.front());
    heard_.pop_front();
    return stop;
  }

  /// It waits to be obeyed. Returns the oldest when there are too many: the control thread hangs;
  /// the flag stays set for it, the answer does not wait.
  std::optional<Command> asked(const StopCounts& counts, const Command& stop) {
    asked_.emplace_back(counts, stop);
    if (asked_.size() <= kMostAsked) return std::nullopt;
    const Command oldest = asked_.front().second;
    asked_.pop_front();
    return oldest;
  }
  /// The next one that is obeyed with these, in the order in which they were asked for.
  std::optional<RequestId> next_obeyed(const StopCounts& obeyed) {
    if (asked_.empty() || !obeyed.include(asked_.front().first)) return std::nullopt;
    const auto id = asked_.front().second.id;
    asked_.pop_front();
    return id;
  }

  /// True once, when nobody has heard stops alone for long though the broker is there.
  bool became_deaf(bool broker_connected, Time now) {
    if (alone_ == nullptr) return false;
    if (alone_->connected() || !broker_connected || last_heard_ == kNever) last_heard_ = now;
    const bool deaf = now - last_heard_ > kDeafFor;
    return !std::exchange(deaf_, deaf) && deaf;
  }

 private:
  static constexpr std::size_t kMostAsked = 256;
  static constexpr Duration kDeafFor = std::chrono::seconds(5);

  HearsStops* alone_;
  HeardTwice heard_twice_;
  std::deque<HeardStop> heard_;                       ///< alone first: to be answered
  std::deque<std::pair<StopCounts, Command>> asked_;  ///< not obeyed yet, oldest first
  std::uint64_t lost_ = 0;
  Time last_heard_ = kNever;  ///< the last time at which they were, or the broker was away
  bool deaf_ = false;
};

}  // namespace drover::runtime
