// A robot that is moved by a ROS 2 user: drover-ros2, droverd and the simulated robot as they are
// shipped, and writers that are plain DDS.
#pragma once

#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include "integration/own_domain.h"
#include "integration/robot_rig.h"
#include "integration/ros2_user.h"
#include "ros2/topics.h"

namespace drover::test {

class MovedFromRos2 : public RobotRig {
 protected:
  /// `inputs`: members of ros2.inputs; `more`: of ros2, each with a comma before it.
  explicit MovedFromRos2(const std::string& inputs, const std::string& more = "") {
    add_section("\"ros2\": {\"domain\": " + std::to_string(domain_) + ", \"inputs\": {" + inputs +
                "}" + more + "}");
    dds_ =
        dds_create_domain(static_cast<dds_domainid_t>(domain_), settings_of(User::humble).c_str());
    participant_ = dds_create_participant(static_cast<dds_domainid_t>(domain_), nullptr, nullptr);
    EXPECT_GT(participant_, 0);
  }
  ~MovedFromRos2() override {
    program_ = {};
    dds_delete(dds_);
  }

  void start_program() {
    program_ = Process({DROVER_ROS2_PROGRAM, "--config", (folder() / "drover.json").string()},
                       (folder() / "ros2.log").string());
  }
  dds_entity_t writer(const ros2::TopicKind& kind) {
    return make_writer(participant_, kind, DDS_RELIABILITY_RELIABLE);
  }
  bool is_heard(dds_entity_t by) {
    return wait_until([&] {
      dds_publication_matched_status_t matched{};
      (void)dds_get_publication_matched_status(by, &matched);
      return matched.current_count > 0;
    });
  }
  void start_robot(const ros2::TopicKind& kind) {
    ASSERT_NO_FATAL_FAILURE(start_all());
    start_program();
    writer_ = writer(kind);
    ASSERT_TRUE(is_heard(writer_)) << program_.output();
    // It says each second that it is there.
    ASSERT_TRUE(wait_until([this] {
      return program_.output().find("droverd tells of the robot") != std::string::npos;
    })) << program_.output();
  }
  /// Says it again and again until `done`; false: not within `longest`.
  bool repeat_until(const std::function<void()>& say, std::chrono::milliseconds apart,
                    const std::function<bool()>& done,
                    std::chrono::nanoseconds longest = std::chrono::seconds(20)) {
    const double begin_s = now_s();
    while (!done()) {
      if (now_s() - begin_s > std::chrono::duration<double>(longest).count()) return false;
      say();
      (void)wait_until([] { return false; }, apart);
    }
    return true;
  }
  std::string status() { return drover({"status"}).text; }
  /// No set point but 0 from then on.
  void expect_rest_on_the_bus_from(double from_s) {
    stop_daemon();
    bool moved = false;
    for (const SetPoint& point : set_points_on_the_bus()) {
      moved = moved || point.velocity_turnps != 0;
      if (point.time_s > from_s) {
        ASSERT_EQ(point.velocity_turnps, 0) << point.time_s - from_s << " s later";
      }
    }
    EXPECT_TRUE(moved) << "it moved before";
  }

  OwnDomain own_domain_;
  int domain_ = own_domain_.number();
  Process program_;
  dds_entity_t dds_ = 0;
  dds_entity_t participant_ = 0;
  dds_entity_t writer_ = 0;
};

}  // namespace drover::test
