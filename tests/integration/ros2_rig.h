// drover-ros2 as a process, a droverd that is only a socket with lines, and a ROS 2 user on the
// same computer who is plain DDS.
#pragma once

#include <dds/dds.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "drover/command.h"
#include "drover/snapshot.h"
#include "integration/own_domain.h"
#include "integration/process.h"
#include "integration/ros2_user.h"
#include "publish/ros2_outlet.h"
#include "ros2/topics.h"
#include "support/temp_folder.h"

namespace drover::test {

class Ros2Rig : public ::testing::Test {
 protected:
  /// `more`: further members of the section ros2, each with a comma before it.
  explicit Ros2Rig(User user = User::humble, const std::string& more = "");
  ~Ros2Rig() override;

  void start_program();
  void open_daemon();
  void close_daemon();
  /// Plays droverd until `done`; false: not within thirty seconds. Fast DDS and Cyclone DDS take up
  /// to ten to know of each other.
  bool play_until(const std::function<bool()>& done);
  void play_for(std::chrono::milliseconds time);

  dds_entity_t stop_writer(dds_reliability_kind_t reliability) {
    return make_writer(participant_, ros2::stop_kind(), reliability);
  }
  dds_entity_t reader(ros2::Topic topic, dds_reliability_kind_t reliability,
                      dds_durability_kind_t durability = DDS_DURABILITY_VOLATILE);
  /// The newest sample, which is the caller's until the next call; nullptr: none.
  template <class Message>
  const Message* newest(dds_entity_t reader) {
    give_back();
    void* sample = nullptr;
    dds_sample_info_t info{};
    loan_of_ = reader;
    for (;;) {
      void* next = nullptr;
      if (dds_take(reader, &next, &info, 1, 1) != 1) break;
      if (sample != nullptr) dds_return_loan(reader, &sample, 1);
      sample = next;
    }
    loan_ = sample;
    return static_cast<const Message*>(sample);
  }
  std::string log() const { return program_.output(); }
  int domain() const { return domain_; }
  dds_entity_t participant() const { return participant_; }

  Snapshot seen_;                  ///< what droverd sees, at its own time
  std::string last_request_;       ///< of drover-ros2, to follow
  std::string last_scene_line_;    ///< likewise, of the planning scene
  std::string last_joint_line_;    ///< likewise a joint command
  int stops_ = 0;                  ///< that it asked for
  bool answers_stops_ = true;      ///< false: droverd has read them, no more
  int refused_stops_ = 0;          ///< so many of the next ones
  std::vector<Command> commands_;  ///< that it handed on, as droverd understands them
  /// Of each scanner, "lidar" first.
  std::vector<scene::sensor::SeenTurn> turns_;
  Process program_;
  TempFolder own_folder_;
  std::filesystem::path folder_{own_folder_.path()};

 private:
  void give_back();
  void hear();
  void tell(const std::string& line) const;
  void beat();

  OwnDomain own_domain_;
  int domain_ = own_domain_.number();
  dds_entity_t dds_ = 0;
  dds_entity_t participant_ = 0;
  dds_entity_t loan_of_ = 0;
  void* loan_ = nullptr;
  int listener_ = -1;
  int client_ = -1;
  std::string in_;
  std::unique_ptr<publish::Ros2Outlet> outlet_;
};

}  // namespace drover::test
