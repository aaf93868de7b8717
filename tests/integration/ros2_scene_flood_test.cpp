// More of the planning scene than can be followed: nothing vanishes without a count, drover-ros2
// keeps its memory, and a stop goes before it.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <fstream>
#include <optional>
#include <thread>

#include "cli/client.h"
#include "integration/ros2_scene_rig.h"
#include "json/located_json.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr double kMostOfRos2_kB = 40'000;

class FloodFromRos2 : public SceneFromRos2 {
 protected:
  FloodFromRos2()
      : SceneFromRos2(R"("collision_object": true, "planning_constraints": true, "e_stop": true)") {
  }
  /// Nothing that it took is given up before it was heard.
  dds_entity_t keeping_writer(const ros2::TopicKind& kind) {
    const dds_entity_t topic =
        dds_create_topic(participant_, kind.type, kind.name, nullptr, nullptr);
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
    dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
    const dds_entity_t made = dds_create_writer(participant_, topic, qos, nullptr);
    dds_delete_qos(qos);
    EXPECT_GT(made, 0);
    return made;
  }
  /// Of what droverd says of the scene of ROS 2.
  static double counted(const std::string& status, std::string_view key) {
    const auto told = json::parse(status);
    if (!told) return 0;
    const auto* node = told->root.find("status");
    for (const auto* member : {"ros2", "scene"}) node = node ? node->find(member) : nullptr;
    node = node ? node->find(key) : nullptr;
    return node ? node->number().value_or(0) : 0;
  }
  /// As the journal has it.
  double lost() const {
    const std::string journal = program_.output();
    constexpr std::string_view kWords = " messages of the planning scene were lost";
    double all = 0;
    for (auto at = journal.find(kWords); at != std::string::npos;
         at = journal.find(kWords, at + 1)) {
      const auto begin = journal.rfind(' ', at - 1) + 1;
      all += std::strtod(journal.c_str() + begin, nullptr);
    }
    return all;
  }
  /// Looked at by droverd, refused by it, or lost.
  double told_of() {
    const std::string status = state();
    return counted(status, "done") + counted(status, "refused") + counted(status, "unanswered") +
           lost();
  }
  double memory_kB(std::string_view key) const {
    std::ifstream told("/proc/" + std::to_string(program_.pid()) + "/status");
    for (std::string word; told >> word;)
      if (double kB = 0; word == key && told >> kB) return kB;
    return 0;
  }
};

/// While it lives `write` is called again and again in a thread of its own.
class Flood final {
 public:
  explicit Flood(std::function<void()> write)
      : thread_([this, again = std::move(write)] {
          while (!ended_) again();
        }) {}
  ~Flood() {
    ended_ = true;
    thread_.join();
  }
  Flood(const Flood&) = delete;
  Flood& operator=(const Flood&) = delete;

 private:
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

TEST_F(FloodFromRos2, IsToldOfToTheLastObjectThatCameWhileItsProgramHung) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::collision_object_kind()));
  const dds_entity_t objects = keeping_writer(ros2::collision_object_kind());
  ASSERT_TRUE(is_heard(objects));
  const double before = told_of();
  program_.signal(SIGSTOP);
  int written = 0;
  for (int i = 0; i < 600; ++i)
    written += put_box(objects, "box" + std::to_string(i), "map", 100) ? 1 : 0;
  program_.signal(SIGCONT);
  EXPECT_GT(written, 300);
  EXPECT_TRUE(wait_until([&] { return told_of() - before >= written; }, 20s))
      << program_.output() << state();
  EXPECT_EQ(told_of() - before, written) << state();
  std::printf("  of %d objects %.0f done, %.0f refused, %.0f lost\n", written,
              counted(state(), "done"), counted(state(), "refused"), lost());
}

TEST_F(FloodFromRos2, OfLargeMessagesOnBothTopicsKeepsItsMemoryBounded) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::collision_object_kind()));
  ros2::Arena arena;
  auto mesh = object(arena, "mesh", "map");
  arena.fill(mesh.mesh_poses_, 1)->orientation_.w_ = 1;
  auto* shape = arena.fill(mesh.meshes_, 1);
  auto* corners = arena.fill(shape->vertices_, 2450);
  for (int i = 0; i < 2450; ++i) corners[i] = {i / 7.0, i / 11.0, i / 13.0};
  moveit_msgs_msg_dds__Constraints_ many{};
  many.name_ = arena.text("many");
  auto* joints = arena.fill(many.joint_constraints_, 1250);
  for (int i = 0; i < 1250; ++i) joints[i] = {arena.text("a/y"), i / 7.0, i / 11.0, i / 13.0, 1};

  const auto kB = memory_kB("VmHWM:");
  const double before = told_of();
  std::atomic<int> written{0};
  {
    const auto flood_of = [&](const ros2::TopicKind& kind, const void* message) {
      const dds_entity_t by = keeping_writer(kind);
      EXPECT_TRUE(is_heard(by));
      return [&written, by, message] {
        if (dds_write(by, message) == DDS_RETCODE_OK) ++written;
      };
    };
    const Flood objects(flood_of(ros2::collision_object_kind(), &mesh));
    const Flood constraints(flood_of(ros2::planning_constraints_kind(), &many));
    (void)wait_until([] { return false; }, 3s);
    program_.signal(SIGSTOP);
    (void)wait_until([] { return false; }, 500ms);
    program_.signal(SIGCONT);
    (void)wait_until([] { return false; }, 3s);
  }
  std::printf("  drover-ros2 had %.0f kB before and %.0f kB at most, of %d messages %.0f lost\n",
              kB, memory_kB("VmHWM:"), written.load(), lost());
  EXPECT_GT(written, 500);
  EXPECT_TRUE(wait_until([&] { return told_of() - before >= written; }, 20s))
      << told_of() - before << " of " << written;
  EXPECT_GT(memory_kB("VmHWM:"), kB);
  EXPECT_LT(memory_kB("VmHWM:"), kMostOfRos2_kB);
}

TEST_F(FloodFromRos2, DoesNotHoldUpAStop) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::collision_object_kind()));
  const dds_entity_t stop = writer(ros2::stop_kind());
  ASSERT_TRUE(is_heard(stop));
  ros2::Arena arena;
  auto made = object(arena, "boxes", "map");
  // As much as goes on to droverd.
  constexpr int kBoxes = 280;
  auto* boxes = arena.fill(made.primitives_, kBoxes);
  auto* poses = arena.fill(made.primitive_poses_, kBoxes);
  for (int i = 0; i < kBoxes; ++i) {
    boxes[i].type_ = 1;
    auto* size = arena.fill(boxes[i].dimensions_, 3);
    size[0] = size[1] = size[2] = 1;
    poses[i].position_ = {100.0 + i, 0, 0.5};
    poses[i].orientation_.w_ = 1;
  }
  const dds_entity_t objects = keeping_writer(ros2::collision_object_kind());
  ASSERT_TRUE(is_heard(objects));
  cli::Connection daemon((folder() / "run" / "drover.sock").string());
  const auto stopped = [&daemon] {
    return daemon.ask(R"({"cmd":"status"})").find(R"("stopped_until_told":true)") !=
           std::string::npos;
  };
  const auto median_ms = [&](bool flooded) {
    std::vector<double> took_ms;
    for (int round = 0; round < 10; ++round) {
      EXPECT_TRUE(
          repeat_until([this] { (void)drover({"reset"}); }, 10ms, [&] { return !stopped(); }));
      std::optional<Flood> flood;
      if (flooded) flood.emplace([&] { dds_write(objects, &made); });
      // Not always at the same point of it.
      (void)wait_until([] { return false; }, std::chrono::milliseconds(300 + 37 * round));
      const std_msgs_msg_dds__Bool_ message{true};
      const double begin_s = now_s();
      dds_write(stop, &message);
      while (!stopped() && now_s() - begin_s < 20) std::this_thread::sleep_for(1ms);
      took_ms.push_back(1e3 * (now_s() - begin_s));
    }
    std::sort(took_ms.begin(), took_ms.end());
    std::printf("  a stop %s took %.0f ms, at most %.0f ms\n", flooded ? "amid objects" : "alone",
                took_ms[took_ms.size() / 2], took_ms.back());
    EXPECT_LT(took_ms.back(), 20'000);
    return took_ms[took_ms.size() / 2];
  };
  EXPECT_LT(median_ms(false), 1000);
  EXPECT_LT(median_ms(true), 1000);
  EXPECT_GT(counted(state(), "done"), 0) << "objects went on meanwhile";
}

}  // namespace
}  // namespace drover::test
