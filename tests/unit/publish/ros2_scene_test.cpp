// Objects and constraints of ROS 2 users, as drover-ros2 hands them on.
#include "json/json_text.h"
#include "publish/ros2_outlet.h"
#include "tests/unit/publish/scene_outlet_fixture.h"

namespace drover::publish {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

std::string ball(const std::string& id, const std::string& frame = "map") {
  return R"({"header":{"frame_id":")" + frame + R"("},"id":")" + id +
         R"(","primitives":[{"type":2,"dimensions":[0.5]}],"primitive_poses":[{}]})";
}

class Ros2Scene : public SceneOutletTest {
 protected:
  Ros2Scene() {
    make(true);
    restore();
    open(true, true);
  }
  void open(bool objects, bool constraints) {
    ros2_ = std::make_unique<Ros2Outlet>(
        50, [] { return std::vector<const scene::sensor::SeenTurn*>(); },
        Ros2Inputs{.scene = &outlet_->topics(),
                   .collision_object = objects,
                   .planning_constraints = constraints});
    tell(R"({"cmd":"ros2_follow","mode":"localhost"})");
    act([&](Actions& out) {
      std::vector<OutMessage> none = ros2_->on_snapshot({}, {now_, kWall}, out);
      out.clear();
    });
  }
  void tell(const std::string& line, ClientId client = 7) {
    act([&](Actions& out) { EXPECT_TRUE(ros2_->on_line(client, line, now_, out)) << line; });
  }
  std::string line(const std::string& message, std::string_view topic = kTopicCollisionObject,
                   Duration ago = 0s) const {
    json::JsonText text;
    text.open('{').key("cmd").text("scene_message").key("topic").text(topic);
    text.key("at_ns").integer((now_ - ago).time_since_epoch().count());
    return text.key("message").text(message).close('}').take();
  }
  std::string refused(const std::string& path, const std::string& why) const {
    json::JsonText text;
    text.open('{').key("cmd").text("scene_message").key("topic").text(kTopicCollisionObject);
    text.key("at_ns").integer(now_.time_since_epoch().count()).key("name").text("box1");
    return text.key("path").text(path).key("refused").text(why).close('}').take();
  }
  Ros2Status counted() const {
    DaemonStatus status;
    outlet_->count(status);
    return status.ros2;
  }

  std::unique_ptr<Ros2Outlet> ros2_;
};

/// A thousand wait for a scene that is behind: of the other way one is followed all the same.
TEST_F(Ros2Scene, FindsRoomHoweverManyOfTheBrokerWait) {
  for (int i = 0; i < 1100; ++i) {
    hear(ball("b" + std::to_string(i)));
    pass(20ms);
  }
  ASSERT_EQ(jobs_.size(), 1000U);
  tell(R"({"cmd":"ros2_follow","mode":"localhost"})");
  tell(line(ball("mine")));
  EXPECT_EQ(jobs_.size(), 1001U);
  EXPECT_EQ(counted().scene_refused, 0U);
}

TEST_F(Ros2Scene, TakesNoRoomOfTheBrokersHoweverManyWait) {
  for (int i = 0; i < 1100; ++i) {
    tell(line(ball("r" + std::to_string(i))));
    pass(20ms);
    if (i % 100 == 0) tell(R"({"cmd":"ros2_follow","mode":"localhost"})");
  }
  ASSERT_EQ(jobs_.size(), 1000U);
  hear(ball("theirs"));
  EXPECT_EQ(jobs_.size(), 1001U);
}

TEST_F(Ros2Scene, IsFollowedStoredAndAnsweredAsThatOfTheBroker) {
  tell(line(ball("a")));
  ASSERT_THAT(jobs_, SizeIs(1));
  const auto& apply = std::get<ApplyMessages>(jobs_.front().what);
  EXPECT_EQ(std::get<scene::CollisionObject>(apply.messages.at(0)).id, "a");
  EXPECT_EQ(apply.arrived.at, now_);
  EXPECT_EQ(apply.arrived.wall_ahead, kWall);
  EXPECT_EQ(apply.arrived.late, "");
  follow();
  EXPECT_THAT(replies(), IsEmpty()) << "it is not on the disk yet";
  store();
  EXPECT_THAT(replies(), ElementsAre(R"({"scene_feedback":{"topic":"collision_object","id":"a",)"
                                     R"("operation":"ADD","result":"done","notes":["it was )"
                                     R"(followed"]}})"));
  EXPECT_THAT(answers(), IsEmpty()) << "the broker's clients did not say it";
  tell(line(R"({"name":"row"})", kTopicPlanningConstraints));
  follow();
  store();
  EXPECT_THAT(replies(), ElementsAre(AllOf(HasSubstr("planning_constraints"), HasSubstr("done"))));
  EXPECT_EQ(counted().scene_done, 2U);
  EXPECT_EQ(counted().scene_refused, 0U);
}

TEST_F(Ros2Scene, IsRefusedByField) {
  tell(line(
      R"({"header":{"frame_id":"map"},"id":"ball","primitives":[{"type":2,"dimensions":[1,1]}]})"));
  EXPECT_THAT(replies(), ElementsAre(HasSubstr(R"("path":"primitives[0].dimensions")")));
  EXPECT_THAT(counted().scene_refusal,
              HasSubstr("collision_object 'ball': primitives[0].dimensions: "));
  tell(refused("primitive_poses[0].position.x", "is no finite number"));
  EXPECT_THAT(replies(), ElementsAre(R"({"scene_feedback":{"topic":"collision_object","id":"box1",)"
                                     R"("result":"refused","path":"primitive_poses[0].position.x",)"
                                     R"("reason":"is no finite number"}})"));
  EXPECT_EQ(counted().scene_refusal,
            "collision_object 'box1': primitive_poses[0].position.x: is no finite number");
  tell(line(ball("nobody")));
  follow();
  EXPECT_THAT(replies(), ElementsAre(HasSubstr("is not liked"))) << "by the scene's thread";
  EXPECT_EQ(counted().scene_refused, 3U);
  EXPECT_EQ(counted().scene_done, 0U);
  EXPECT_THAT(disk_, IsEmpty());
}

TEST_F(Ros2Scene, ThatWaitedIsNotOfNow) {
  tell(line(ball("a"), kTopicCollisionObject, 300ms));
  tell(line(ball("b"), kTopicCollisionObject, 301ms));
  ASSERT_THAT(jobs_, SizeIs(2));
  const auto arrived = [this](int i) { return std::get<ApplyMessages>(jobs_[i].what).arrived; };
  EXPECT_EQ(arrived(0).late, "");
  EXPECT_EQ(arrived(0).at, now_ - 300ms) << "where the robot was then";
  EXPECT_EQ(arrived(1).late, "it was said 301 ms ago");
  EXPECT_EQ(arrived(1).at, now_);
}

TEST_F(Ros2Scene, IsTakenOfDroverRos2OnlyAndWhereTheConfigurationOpensIt) {
  tell(R"({"cmd":"scene_message","topic":"mqtt_control","at_ns":1,"message":"{}"})");
  tell(R"({"cmd":"scene_message","topic":"collision_object","message":"{}"})");
  EXPECT_THAT(replies(), ElementsAre(HasSubstr("neither"), HasSubstr("at_ns is missing")));
  open(true, false);
  tell(line(R"({"name":"row"})", kTopicPlanningConstraints));
  EXPECT_THAT(replies(), ElementsAre(HasSubstr("ros2.inputs.planning_constraints")));
  open(false, true);
  tell(line(ball("a")));
  EXPECT_THAT(replies(), ElementsAre(HasSubstr("ros2.inputs.collision_object")));
  open(true, true);
  now_ += 4s;
  tell(line(ball("a")));
  EXPECT_THAT(replies(), ElementsAre(HasSubstr("only drover-ros2")))
      << "it has not said for so long that it is there";
  EXPECT_THAT(jobs_, IsEmpty());
}

TEST_F(Ros2Scene, OfAFloodIsBoundedAndTakesNothingFromTheBroker) {
  for (int i = 0; i < 1000; ++i) tell(line(ball("a")));
  EXPECT_THAT(jobs_, SizeIs(200));
  follow();
  for (int i = 0; i < 3; ++i) {  // saves are one at a time
    store();
    pass(1s);
  }
  const auto told = replies();
  EXPECT_THAT(told, SizeIs(220)) << "ten refusals a second, twenty at once";
  EXPECT_THAT(told.back(), HasSubstr("slow down: 100 messages a second are taken"));
  EXPECT_EQ(counted().scene_unanswered, 780U);
  hear(ball("b"));
  EXPECT_THAT(jobs_, SizeIs(1));
  DaemonStatus status;
  outlet_->count(status);
  EXPECT_EQ(status.scene_messages_unanswered, 0U);
}

TEST_F(Ros2Scene, OfALargeObjectIsReadWhereNobodyWaits) {
  tell(line(ball("large") + std::string(30'000, ' ')));
  EXPECT_THAT(jobs_, IsEmpty());
  parse();
  EXPECT_THAT(jobs_, SizeIs(1));
}

TEST_F(Ros2Scene, IsAnsweredInOneOrderWithTheBrokers) {
  tell(line(ball("a")));
  hear("{");
  EXPECT_THAT(answers(), IsEmpty());
  follow();
  store();
  EXPECT_THAT(answers(), SizeIs(1));
  EXPECT_THAT(replies(), SizeIs(1));
}

}  // namespace
}  // namespace drover::publish
