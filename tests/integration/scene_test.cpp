// What is around the robot, as it comes from the broker and the command line's socket: real
// processes, in real time.
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

#include "integration/robot_rig.h"
#include "json/json_text.h"
#include "json/located_json.h"
#include "support/protoc.h"

namespace drover::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kScene = R"("scene": {
  "footprint": [{"x_m": 0.45, "y_m": 0.35}, {"x_m": -0.415, "y_m": 0.35},
                {"x_m": -0.415, "y_m": -0.35}, {"x_m": 0.45, "y_m": -0.35}],
  "ground_clearance_m": 0.05, "height_m": 1})";

std::string removed(const std::string& id) {
  return R"({"id":")" + id + R"(","operation":1})";
}

class Scene : public RobotRig {
 protected:
  Scene() { add_section(kScene); }

  /// A box so far ahead of where the robot believes to be, across its way.
  std::string box_ahead(const std::string& id, double ahead_m) const {
    json::JsonText text;
    text.open('{').key("header").open('{').key("frame_id").text("map").close('}');
    text.key("id").text(id).key("primitives").open('[').open('{').key("type").integer(1);
    text.key("dimensions").open('[').number(0.4).number(2).number(1).close(']').close('}');
    text.close(']').key("primitive_poses").open('[').open('{').key("position").open('{');
    text.key("x").number(status_number("pose", "x") + ahead_m);
    text.key("y").number(status_number("pose", "y")).key("z").number(0.5);
    return text.close('}').close('}').close(']').close('}').take();
  }
  /// Says it and gives the answer.
  std::string tell(const std::string& text, bool retained = false) {
    const auto before = client().heard().size();
    client().publish("collision_object", text, retained);
    std::string answer;
    EXPECT_TRUE(wait_until([&] {
      for (auto i = before; i < client().heard().size(); ++i)
        if (client().heard()[i].topic == "scene_feedback") answer = client().heard()[i].text;
      return !answer.empty();
    })) << text;
    return answer;
  }
  /// A request by the daemon's socket, as `drover` sends it.
  std::string ask(const std::string& line) const {
    const int fd = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, (folder() / "run" / "drover.sock").c_str());
    EXPECT_EQ(::connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    const std::string text = line + "\n";
    EXPECT_EQ(::send(fd, text.data(), text.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(text.size()));
    std::string answer;
    char byte = 0;
    while (::recv(fd, &byte, 1, 0) == 1 && byte != '\n') answer += byte;
    ::close(fd);
    return answer;
  }
  /// The reason of the last refusal on `feedback`.
  std::string refusal_of_start(const std::string& name, int id) {
    const auto before = client().heard().size();
    start_task(name, id);
    EXPECT_TRUE(wait_for_feedback("start_task_failse", before));
    return client().last("feedback");
  }
};

TEST_F(Scene, IsAnsweredStoredAndThereAgainAfterARestart) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  EXPECT_THAT(tell(box_ahead("box1", 20)), AllOf(HasSubstr("box1"), HasSubstr("done")));
  EXPECT_THAT(ask(R"({"cmd":"scene_list"})"), HasSubstr("box1"));
  daemon().signal(SIGKILL);  // what was answered is on the disk
  (void)daemon().wait(std::chrono::seconds(20));
  start_daemon();
  EXPECT_TRUE(wait_until([this] { return drover({"status"}).code == 0; }));
  EXPECT_TRUE(wait_until(
      [this] { return ask(R"({"cmd":"scene_list"})").find("box1") != std::string::npos; }));
  EXPECT_THAT(ask(R"({"cmd":"scene_show","name":"box1"})"), HasSubstr(R"("dimensions":[0.4,2,1])"));
  EXPECT_THAT(ask(R"({"cmd":"scene_clear"})"), HasSubstr(R"("ok":true)"));
  EXPECT_THAT(ask(R"({"cmd":"scene_list"})"), Not(HasSubstr("box1")));
}

TEST_F(Scene, RefusesATrackThatMeetsAnObjectUntilItIsRemoved) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  wait_until_believed();
  ASSERT_NO_FATAL_FAILURE(save_track("row", 8));
  ASSERT_THAT(tell(box_ahead("box1", 5)), HasSubstr("done"));
  EXPECT_THAT(refusal_of_start("row", 17),
              AllOf(HasSubstr("box1"), HasSubstr("m ahead"), HasSubstr("after point")));
  EXPECT_TRUE(at_rest());
  const auto before = client().heard().size();
  (void)start_until_accepted("row", 4);  // ends before it
  EXPECT_TRUE(wait_for_feedback("start_nav_success", before));
  EXPECT_TRUE(wait_for_status("NAV_SUCCESS"));
  ASSERT_THAT(tell(removed("box1")), HasSubstr("done"));
  (void)start_until_accepted("row", 17);
  EXPECT_TRUE(wait_until([this] { return true_speed_mps() > 0.1; }));
  EXPECT_TRUE(wait_for_status("NAV_SUCCESS"));
}

TEST_F(Scene, StopsBeforeWhatAppearsOnTheWayAndGoesOnWithoutIt) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  wait_until_believed();
  ASSERT_NO_FATAL_FAILURE(drive(8));
  ASSERT_THAT(tell(box_ahead("box1", 3)), HasSubstr("done"));
  EXPECT_TRUE(wait_until([this] { return status_text("nav", "obstacle") == "true"; }))
      << client().last("base_status");
  EXPECT_TRUE(wait_until([this] { return at_rest(); }));
  EXPECT_EQ(status_text("nav", "status"), "NAV_RUN");
  EXPECT_THAT(client().last("base_status"), HasSubstr("box1"));
  EXPECT_THAT(ask(R"({"cmd":"scene_clear"})"), HasSubstr(R"("ok":false)")) << "a task runs";
  ASSERT_THAT(tell(removed("box1")), HasSubstr("done"));
  EXPECT_TRUE(wait_until([this] { return true_speed_mps() > 0.1; })) << "it goes on by itself";
  EXPECT_TRUE(wait_for_status("NAV_SUCCESS"));
}

TEST_F(Scene, StopsAJointCommandBeforeAnObject) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  wait_until_believed();
  ASSERT_THAT(tell(box_ahead("box1", 2.5)), HasSubstr("done"));
  const auto command = [this](const char* velocity) {
    std::string text;
    for (const char* name : {"front_left", "rear_left", "front_right", "rear_right"})
      text += "joints { name: \"" + std::string(name) + "\" velocity: " + velocity + " } ";
    client().publish("/channel/%2Fjoint_command/pb%3Aaimrt.protocols.sensor.JointCommand",
                     std::string("\x02pb\0", 4) + protoc_encoded("JointCommand", text));
  };
  const double begun_s = now_s();
  const auto go = [&] { command(now_s() < begun_s + 2.5 ? "0" : "2"); };
  ASSERT_TRUE(wait_until([&] {
    go();
    return true_speed_mps() > 0.1;
  })) << daemon().output();
  ASSERT_TRUE(wait_until([&] {
    go();
    return at_rest();
  })) << "before it";
  const double stopped_s = now_s();
  (void)wait_until([&] {
    go();
    return now_s() > stopped_s + 2;
  });
  EXPECT_TRUE(at_rest()) << "though it is told to go on";
  EXPECT_LT(status_number("pose", "x"), 2.5);
}

TEST_F(Scene, RefusesWhatIsNotExactlyAMessage) {
  ASSERT_NO_FATAL_FAILURE(start_broker());
  client().publish("collision_object", removed("old"), true);  // lies there since some other day
  ASSERT_NO_FATAL_FAILURE(start_sim());
  ASSERT_NO_FATAL_FAILURE(start_guard());
  start_daemon();
  ASSERT_TRUE(wait_for_locate());
  EXPECT_EQ(client().last("scene_feedback").find("done"), std::string::npos);
  EXPECT_THAT(tell(box_ahead("box1", 5), true), AllOf(HasSubstr("refused"), HasSubstr("retain")));
  EXPECT_THAT(tell(R"({"header":{"frame_id":"map"},"id":"a",
                       "primitives":[{"type":2,"dimensions":[1,1]}]})"),
              AllOf(HasSubstr("refused"), HasSubstr(R"("path":"primitives[0].dimensions")")));
  EXPECT_THAT(tell("{"), HasSubstr("refused"));
  EXPECT_THAT(tell(removed("nobody")), HasSubstr("refused"));
  EXPECT_THAT(ask(R"({"cmd":"scene_list"})"), HasSubstr(R"("objects":[])"));
}

TEST_F(Scene, KeepsAZoneThatNoMessageCanRemove) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  wait_until_believed();
  // About the simulated field's origin, and far off: the robot is not in it.
  const std::string import =
      R"({"cmd":"zone_import","name":"yard","kind":"keep_in","source":"yard.geojson",)"
      R"("text":"{\"type\":\"Polygon\",\"coordinates\":[[[113.03,23.15],[113.031,23.15],)"
      R"([113.031,23.151],[113.03,23.15]]]}"})";
  EXPECT_THAT(ask(import), AllOf(HasSubstr(R"("ok":true)"), HasSubstr("area_m2")));
  ASSERT_NO_FATAL_FAILURE(save_track("row", 3));
  EXPECT_THAT(refusal_of_start("row", 7), HasSubstr("yard"));
  EXPECT_THAT(tell(removed("yard")), HasSubstr("refused"));
  stop_daemon();
  start_daemon();
  ASSERT_TRUE(wait_until([this] { return drover({"status"}).code == 0; }));
  EXPECT_TRUE(wait_until(
      [this] { return ask(R"({"cmd":"zone_list"})").find("yard") != std::string::npos; }));
  EXPECT_THAT(ask(R"({"cmd":"zone_delete","name":"yard"})"), HasSubstr(R"("ok":true)"));
  ASSERT_TRUE(wait_for_locate());
  wait_until_believed();
  (void)start_until_accepted("row", 7);
  EXPECT_TRUE(wait_for_status("NAV_SUCCESS"));
}

TEST_F(Scene, DoesNotMoveWhileWhatWasStoredCannotBeRead) {
  std::filesystem::create_directories(folder() / "state");
  std::ofstream(folder() / "state" / "zones.texts") << "noise";
  ASSERT_NO_FATAL_FAILURE(start_all());
  wait_until_believed();
  ASSERT_NO_FATAL_FAILURE(save_track("row", 3));
  EXPECT_THAT(refusal_of_start("row", 7), HasSubstr("zones"));
  EXPECT_THAT(drover({"status"}).text, HasSubstr("zones"));
  EXPECT_THAT(ask(R"({"cmd":"zone_forget_unreadable"})"), HasSubstr(R"("ok":true)"));
  (void)start_until_accepted("row", 7);
  EXPECT_TRUE(wait_for_status("NAV_SUCCESS"));
}

class NoScene : public RobotRig {};

TEST_F(NoScene, SaysThatTheRobotHasNone) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  client().publish("collision_object", removed("a"));
  EXPECT_TRUE(wait_until([this] { return !client().last("scene_feedback").empty(); }));
  EXPECT_THAT(client().last("scene_feedback"), HasSubstr("no section scene"));
}

}  // namespace
}  // namespace drover::test
