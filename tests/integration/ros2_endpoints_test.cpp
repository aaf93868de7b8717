// What drover-ros2's writers and readers are and tell of themselves on the wire, and what they
// leave alone.
#include <moveit_msgs.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "integration/ros2_places.h"
#include "integration/ros2_rig.h"
#include "ros2/arena.h"
#include "ros2/samples.h"

namespace drover::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

constexpr std::int32_t kAtOnce = 32;

class Ros2Endpoints : public Ros2Rig {
 protected:
  explicit Ros2Endpoints(const std::string& cmd_vel = "twist")
      : Ros2Rig(User::humble, R"(, "inputs": {"e_stop": true, "cmd_vel": ")" + cmd_vel +
                                  R"(", "joint_command": true, "collision_object": true,
                                  "planning_constraints": true})") {}

  static std::string line(std::string_view topic, std::string_view type,
                          std::string_view user_data) {
    return std::string(topic) + " " + std::string(type) + " " + std::string(user_data);
  }
  /// As REP 2016 has it in the user data.
  static std::string line(const ros2::TopicKind& kind) {
    return line(kind.name, kind.type->m_typename,
                "typehash=RIHS01_" + std::string(kind.hash) + ";");
  }
  /// Of all that are there by `others`, DDS' topic of all writers or of all readers; the user has
  /// none.
  std::vector<std::string> told_by(dds_entity_t others) const {
    std::vector<std::string> lines;
    const auto look = [&lines](const void* sample, const dds_sample_info_t&) {
      const auto& other = *static_cast<const dds_builtintopic_endpoint_t*>(sample);
      if (std::string_view(other.topic_name).starts_with("DCPS")) return;  // the one that looks
      void* told = nullptr;
      std::size_t size = 0;
      (void)dds_qget_userdata(other.qos, &told, &size);
      lines.push_back(
          line(other.topic_name, other.type_name, {static_cast<const char*>(told), size}));
      dds_free(told);
    };
    const dds_entity_t all = dds_create_reader(participant(), others, nullptr, nullptr);
    while (ros2::take_samples<kAtOnce>(all, look) == kAtOnce) {
    }
    dds_delete(all);
    std::sort(lines.begin(), lines.end());
    return lines;
  }
  void expect_hashes(const ros2::TopicKind& cmd_vel) {
    std::vector<std::string> written;
    for (const auto& kind : ros2::topic_kinds()) written.push_back(line(kind));
    std::sort(written.begin(), written.end());
    // The stop is heard by two.
    std::vector<std::string> heard{line(ros2::stop_kind()),
                                   line(ros2::stop_kind()),
                                   line(cmd_vel),
                                   line(ros2::joint_command_kind()),
                                   line(ros2::collision_object_kind()),
                                   line(ros2::planning_constraints_kind())};
    std::sort(heard.begin(), heard.end());
    open_daemon();
    start_program();
    (void)play_until([&] {
      return told_by(DDS_BUILTIN_TOPIC_DCPSPUBLICATION).size() >= written.size() &&
             told_by(DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION).size() >= heard.size();
    });
    EXPECT_EQ(told_by(DDS_BUILTIN_TOPIC_DCPSPUBLICATION), written) << log();
    EXPECT_EQ(told_by(DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION), heard) << log();
  }
};

TEST_F(Ros2Endpoints, EachTellTheHashOfTheirType) {
  expect_hashes(ros2::cmd_vel_kind(false));
}

class Ros2StampedEndpoints : public Ros2Endpoints {
 protected:
  Ros2StampedEndpoints() : Ros2Endpoints("twist_stamped") {}
};

TEST_F(Ros2StampedEndpoints, EachTellTheHashOfTheirType) {
  expect_hashes(ros2::cmd_vel_kind(true));
}

/// A second scanner, behind, and behind the first one in the configuration.
class Ros2TwoScanners : public Ros2Rig {
 protected:
  Ros2TwoScanners() {
    edit("\"lidar\": {\"serial\"", "\"rear\": {\"serial\": \"/dev/drover/rear\"}, ");
    edit("\"estop\": {", R"("rear": {"driver": "ld06", "link": "rear", "options": {
      "mount_x_m": -0.3, "mount_y_m": 0.1, "mount_z_m": 0.25, "mount_yaw_deg": 180}}, )");
    turns_.push_back(turns_[0]);
    turns_[1].device = "rear";
    turns_[1].scan.points.clear();
    (void)turns_[1].scan.points.push_back({0.5, 1.5, 9});
  }
  /// Puts `more` before the first `where` of its configuration.
  void edit(std::string_view where, const std::string& more) const {
    const auto path = folder_ / "drover.json";
    std::ifstream file(path);
    std::string config(std::istreambuf_iterator<char>(file), {});
    ASSERT_NE(config.find(where), std::string::npos) << where;
    config.insert(config.find(where), more);
    std::ofstream(path) << config;
  }
  static float nearest(const sensor_msgs_msg_dds__LaserScan_& scan) {
    float least = INFINITY;
    for (std::uint32_t i = 0; i < scan.ranges_._length; ++i)
      least = std::fmin(least, scan.ranges_._buffer[i]);
    return least;
  }
  /// Each message on `topic` is of `scanner`, which sees one thing so far away.
  void expect_scans(const char* topic, const std::string& scanner, float range_m) {
    ros2::TopicKind kind = ros2::topic_kinds().at(static_cast<std::size_t>(ros2::Topic::scan));
    kind.name = topic;
    const dds_entity_t from = make_reader(participant(), kind, DDS_RELIABILITY_RELIABLE);
    int count = 0;
    EXPECT_TRUE(play_until([&] {
      take_each<sensor_msgs_msg_dds__LaserScan_>(from, [&](const auto& scan) {
        EXPECT_EQ(scan.header_.frame_id_, scanner) << topic;
        EXPECT_FLOAT_EQ(nearest(scan), range_m) << topic;
        ++count;
      });
      return count >= 20;
    })) << topic
        << log();
  }
};

TEST_F(Ros2TwoScanners, HaveATopicEach) {
  open_daemon();
  start_program();
  expect_scans("rt/scan", "lidar", 2.5F);
  expect_scans("rt/rear/scan", "rear", 1.5F);
}

class Ros2Large : public Ros2Endpoints {
 protected:
  /// A command of so many joints, and a name to know it by.
  static void command(dds_entity_t by, std::size_t joints, const char* name) {
    ros2::Arena arena;
    aimrt_msgs_msg_dds__JointCommandArray_ message{};
    message.header_.frame_id_ = arena.text("");
    auto* all = arena.fill(message.joints_, joints);
    for (std::size_t i = 0; i < joints; ++i) all[i].name_ = arena.text(name);
    EXPECT_EQ(dds_write(by, &message), DDS_RETCODE_OK);
  }
  /// An object of the map, without a shape.
  static void object(dds_entity_t by, std::string_view id) {
    ros2::Arena arena;
    moveit_msgs_msg_dds__CollisionObject_ message{};
    message.header_.frame_id_ = arena.text("map");
    message.pose_.orientation_.w_ = 1;
    message.id_ = arena.text(id);
    message.type_ = {arena.text(""), arena.text("")};
    EXPECT_EQ(dds_write(by, &message), DDS_RETCODE_OK);
  }
  /// Says it until droverd is told of it.
  void expect_told(const std::string& line, std::string_view name,
                   const std::function<void()>& say) {
    EXPECT_TRUE(play_until([&] {
      say();
      return line.find(name) != std::string::npos;
    })) << log();
  }
  /// The line that the journal has of it.
  void expect_dropped(const std::string& topic) {
    EXPECT_TRUE(play_until([&] { return log().find("oversize") != std::string::npos; })) << log();
    EXPECT_THAT(log(), ContainsRegex("warning: DDS: dropping oversize \\([0-9]+ > 65536\\) "
                                     "sample [0-9]+ from remote writer [0-9a-f:]+ " +
                                     topic));
  }
};

TEST_F(Ros2Large, CommandsAreDroppedAndTheJournalSaysSo) {
  open_daemon();
  start_program();
  const dds_entity_t writer =
      make_writer(participant(), ros2::joint_command_kind(), DDS_RELIABILITY_RELIABLE);
  expect_told(last_joint_line_, "before", [&] { command(writer, 1, "before"); });
  EXPECT_THAT(log(), Not(HasSubstr("oversize")));
  command(writer, 2000, "large");
  expect_dropped("rt/joint_command/");
  expect_told(last_joint_line_, "after", [&] { command(writer, 1, "after"); });
}

TEST_F(Ros2Large, ObjectsAreDroppedAndTheJournalSaysSo) {
  open_daemon();
  start_program();
  const dds_entity_t writer =
      make_writer(participant(), ros2::collision_object_kind(), DDS_RELIABILITY_RELIABLE);
  expect_told(last_scene_line_, "before", [&] { object(writer, "before"); });
  EXPECT_THAT(log(), Not(HasSubstr("oversize")));
  object(writer, std::string(66'000, 'x'));
  expect_dropped("rt/collision_object/");
  expect_told(last_scene_line_, "after", [&] { object(writer, "after"); });
}

}  // namespace
class Ros2Latched : public Ros2Large {
 protected:
  dds_entity_t latched_writer(const ros2::TopicKind& kind) const {
    const dds_entity_t topic =
        dds_create_topic(participant(), kind.type, kind.name, nullptr, nullptr);
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, 0);
    dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
    const dds_entity_t writer = dds_create_writer(participant(), topic, qos, nullptr);
    dds_delete_qos(qos);
    EXPECT_GT(writer, 0);
    return writer;
  }
};

TEST_F(Ros2Latched, ObjectsOfBeforeAreNotAskedFor) {
  const auto& kind = ros2::collision_object_kind();
  const dds_entity_t writer = latched_writer(kind);
  object(writer, "before");
  // Who asks gets it.
  const dds_entity_t asks =
      make_reader(participant(), kind, DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_TRANSIENT_LOCAL);
  const auto* kept = newest<moveit_msgs_msg_dds__CollisionObject_>(asks);
  ASSERT_NE(kept, nullptr);
  EXPECT_STREQ(kept->id_, "before");

  open_daemon();
  start_program();
  ASSERT_TRUE(play_until([&] {
    dds_publication_matched_status_t matched{};
    (void)dds_get_publication_matched_status(writer, &matched);
    return matched.current_count > 0 && log().find("tells of the robot") != std::string::npos;
  })) << log();
  play_for(std::chrono::seconds(2));
  EXPECT_EQ(last_scene_line_, "");
  expect_told(last_scene_line_, "after", [&] { object(writer, "after"); });
}

// namespace
}  // namespace drover::test
