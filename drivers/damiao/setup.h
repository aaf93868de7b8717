// What has to be so in the motor before it is enabled: read register by register, and its time-out
// set.
#pragma once

#include "drivers/damiao/settings.h"
#include "drover/driver_out.h"
#include "drover/fixed_text.h"

namespace drover::damiao {

class Setup final {
 public:
  explicit Setup(const Settings& settings) : settings_(settings) {}

  /// From the start, whatever was known.
  void begin();
  /// Nothing is known, and nothing is asked.
  void forget() { state_ = State::waiting; }
  /// At most one request.
  void on_tick(Time now, DriverOut& out);
  void on_reply(const RegisterReply& reply);

  bool under_way() const { return state_ == State::asking; }
  bool done() const { return state_ == State::done; }
  bool failed() const { return state_ == State::failed; }
  /// Of a failure, for operators.
  const Reason& reason() const { return reason_; }

 private:
  enum class State : std::uint8_t { waiting, asking, done, failed };
  void ask(Time now, DriverOut& out);
  bool judge(const RegisterReply& reply);
  void fail();

  Settings settings_;
  State state_ = State::waiting;
  std::size_t at_ = 0;   ///< which register
  bool asked_ = false;   ///< and its answer has not come
  bool writes_ = false;  ///< the time-out is written next
  bool written_ = false;
  int attempts_ = 0;
  Time asked_at_ = kNever;
  Reason reason_;
};

}  // namespace drover::damiao
