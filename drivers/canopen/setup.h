// Sets up a node's objects one after the other, and believes only what it reads back.
#pragma once

#include <span>

#include "drivers/canopen/sdo_client.h"
#include "drover/fixed_text.h"

namespace drover::canopen {

/// One object to be written.
struct SdoStep {
  Object object;
  SdoNumber value;
  /// Some objects cannot be read, or tell something else than was written into them.
  bool read_back = true;
  /// A node that does not have the object, or lets nobody write it, is well all the same.
  bool may_be_refused = false;
};

/// Writes each object and reads it again before the next. A question without an answer is asked
/// three times; a refusal, or another value than was written, ends it. All is forgotten with
/// `begin`, which belongs after each boot-up of the node: what was set is gone then.
class SdoSetup {
 public:
  /// `steps` outlive it.
  SdoSetup(std::uint8_t node, std::span<const SdoStep> steps) : client_(node), steps_(steps) {}

  void begin();
  std::optional<CanFrame> on_frame(const CanFrame& frame, Time now);
  std::optional<CanFrame> on_tick(Time now);
  bool done() const { return next_ == steps_.size(); }
  bool failed() const { return !reason_.empty(); }
  /// For people, when it failed: which object, and why.
  const Reason& reason() const { return reason_; }

 private:
  std::optional<CanFrame> ask(Time now);
  void judge(const SdoOutcome& outcome);
  void next_step();

  SdoClient client_;
  std::span<const SdoStep> steps_;
  std::size_t next_ = 0;
  bool written_ = false;  ///< this step's value: now it is read
  int silences_ = 0;
  Reason reason_;
};

}  // namespace drover::canopen
