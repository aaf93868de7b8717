// What ROS 2 users see of the robot: writers of all topics, and what they write of each line.
#pragma once

#include <dds/dds.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "ros2/convert.h"
#include "ros2/topics.h"
#include "ros2/unmet.h"

namespace drover::ros2 {

struct ScannerFrame {
  FixedFrame frame;
  RangeLimits limits;
  std::size_t angles = 0;  ///< in each of its messages
};

/// What does not change while the robot runs.
struct Robot {
  std::string name;
  std::vector<FixedFrame> frames;  ///< of sensors and what else is on the base
  std::vector<ScannerFrame> scanners;
};

/// How the readers are.
struct Readers {
  std::int64_t matched = 0;
  Unmet unmet;
};

class Shown final {
 public:
  /// `at_ns`: now. Throws NoDomain when a writer cannot be made.
  Shown(dds_entity_t participant, const Robot& robot, Stamp_ns at_ns);

  /// Writes what is new. The writers' entities go with their participant.
  void show(const Told& told);
  void show_diagnostics(Stamp_ns at_ns, std::span<const DiagnosticTold> told);
  Readers readers();
  /// Samples that DDS did not take.
  std::uint64_t failed() const { return failed_; }

 private:
  struct Writer {
    const char* topic = "";
    dds_entity_t entity = 0;
    std::uint32_t unmet = 0;
  };
  Writer make(const TopicKind& kind, const std::string& name);
  void count(Writer& writer, Readers& readers);
  template <class Message>
  void send(const Writer& writer, const Message& message);
  const Writer& writer(Topic topic) const { return writers_[static_cast<std::size_t>(topic)]; }
  void show_scan(const ScanTold& scan);

  dds_entity_t participant_;
  Robot robot_;
  std::array<Writer, kTopicCount> writers_;
  std::map<std::string, std::string> names_;  ///< of further scanners' topics
  std::map<std::string, Writer> more_scans_;  ///< by scanner
  Arena arena_;
  std::uint32_t joint_sequence_ = 0;
  std::uint32_t touch_sequence_ = 0;
  std::uint64_t failed_ = 0;
};

}  // namespace drover::ros2
