// How long the broker takes, by the acknowledgements of our own messages. Pure.
//
// A command carries no time: a start that was pressed while the broker hung comes when it goes on.
// Messages of our own are acknowledged by a broker that works, and need no right that an old list
// of rights lacks. What the operator's own link holds back cannot be seen here.
#pragma once

#include <cstdint>
#include <map>
#include <string_view>

#include "drover/time.h"

namespace drover::runtime {

class BrokerDelay final {
 public:
  /// An acknowledgement that takes longer is late.
  static constexpr Duration kLimit = std::chrono::milliseconds(500);
  /// What the broker held back comes within this time of what was late.
  static constexpr Duration kAfter = std::chrono::seconds(1);
  static constexpr Duration kAskEach = std::chrono::milliseconds(200);

  /// A connection that was asked for at `asked`. What a broker that was away, or that answers late,
  /// held back comes now.
  void on_connected(Time asked, Time now) {
    waiting_.clear();
    if (connected_ != kNever || now - asked > kLimit) last_late_ = now;
    connected_ = now;
    next_ = now;
  }
  /// Who writes now may have done so before, and not know that this program is another one.
  bool just_connected(Duration just, Time now) const {
    return connected_ != kNever && now - connected_ < just;
  }
  /// Whether to send a message now that measures. More than ten that wait measure nothing more.
  bool due(Time now) const { return now >= next_ && waiting_.size() < 10; }
  void on_sent(int message, Time now) {
    waiting_[message] = now;
    next_ = now + kAskEach;
  }
  /// Any acknowledged message; others than those of on_sent count for nothing.
  void on_acknowledged(int message, Time now) {
    const auto found = waiting_.find(message);
    if (found == waiting_.end()) return;
    if (now - found->second > kLimit) last_late_ = now;
    waiting_.erase(found);
  }
  /// Why nothing that comes now may move the robot; empty when the broker is prompt.
  std::string_view late(Time now) const {
    for (const auto& [message, sent] : waiting_)
      if (now - sent > kLimit) return "the broker is late: it holds messages back; try again";
    if (now - last_late_ >= kAfter) return {};
    return last_late_ == connected_
               ? "the broker has just come back, and might tell old messages; try again"
               : "the broker was late just now; try again";
  }

 private:
  std::map<int, Time> waiting_;  ///< by the library's number
  Time last_late_ = kNever;
  Time connected_ = kNever;
  Time next_ = kNever;
};

}  // namespace drover::runtime
