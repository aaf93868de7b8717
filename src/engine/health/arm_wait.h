// Waiting until the drives that were asked to run do.
#pragma once

#include <cstdint>

namespace drover::engine {

enum class Drives : std::uint8_t {
  asked,   ///< in this cycle: what they report says nothing of it yet
  arming,  ///< and not for too long
  armed,
  late,  ///< they did not run in time
  lost,  ///< they ran, and do no more
};

/// Everybody who moves the base waits by the same rule. A drive that still holds from the one
/// before reports that it runs, and arms anew for this one.
class ArmWait final {
 public:
  void begin() { asked_ = armed_ = false; }
  /// Once a cycle, from the one in which they are asked.
  Drives look(bool run, bool late) {
    if (!asked_) {
      asked_ = true;
      return Drives::asked;
    }
    if (run) {
      armed_ = true;
      return Drives::armed;
    }
    return armed_ ? Drives::lost : late ? Drives::late : Drives::arming;
  }

 private:
  bool asked_ = false;
  bool armed_ = false;
};

}  // namespace drover::engine
