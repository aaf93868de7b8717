// drover-ros2's end of DDS alone, in a process of its own: as it is shipped, and as it could have
// been made. For tests of whom it meets.
#pragma once

#include <sys/types.h>

#include <cstdint>

#include "ros2/topics.h"

namespace drover::test {

constexpr int kMeetingDomain = 42;  ///< nobody else is in such a test's network

enum class Ours : std::uint8_t {
  shipped_localhost,
  shipped_network,
  loopback_only,
  automatic_only,
  automatic_bound,  ///< and its sockets to loopback
};

/// It writes this topic for ever.
const ros2::TopicKind& meeting_topic();

/// Ends with its owner. Construct it before any thread is started.
class OurSide {
 public:
  /// `before`: so many programs of DDS on this computer, which look for nobody, came before it.
  explicit OurSide(Ours ours, int before = 0);
  ~OurSide();
  OurSide(const OurSide&) = delete;
  OurSide& operator=(const OurSide&) = delete;

  bool alive() const;

 private:
  pid_t process_ = -1;
};

}  // namespace drover::test
