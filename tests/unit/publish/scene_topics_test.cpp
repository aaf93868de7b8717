// Messages of the planning scene and their answers.
#include "json/located_json.h"
#include "tests/unit/publish/scene_outlet_fixture.h"

namespace drover::publish {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

std::string ball(const std::string& id, int seq = 0) {
  return R"({"header":{"seq":)" + std::to_string(seq) + R"(,"frame_id":"map"},"id":")" + id +
         R"(","primitives":[{"type":2,"dimensions":[0.5]}],"primitive_poses":[{}]})";
}
std::string list_of(int count) {
  std::string text = "[";
  for (int i = 0; i < count; ++i) text += (i > 0 ? "," : "") + ball("b" + std::to_string(i));
  return text + "]";
}
/// Longer than what is read at once.
std::string long_ball(const std::string& id) {
  return ball(id) + std::string(5000, ' ');
}

class SceneTopicsTest : public SceneOutletTest {
 protected:
  SceneTopicsTest() {
    make(true);
    restore();
  }
};

TEST_F(SceneTopicsTest, AreHeardAtLeastOnce) {
  const auto wants = outlet_->wants();
  ASSERT_EQ(wants.size(), 2U);
  EXPECT_EQ(wants[0].name, "collision_object");
  EXPECT_EQ(wants[1].name, "planning_constraints");
  EXPECT_EQ(wants[0].qos + wants[1].qos, 2);
  Actions actions;
  EXPECT_FALSE(outlet_->on_message("mqtt_control", "{}", {}, now_, actions));
}

TEST_F(SceneTopicsTest, AnswerWhatIsOnTheDiskAndNotBefore) {
  hear(ball("a", 3));
  ASSERT_THAT(jobs_, SizeIs(1));
  const auto& apply = std::get<ApplyMessages>(jobs_.front().what);
  EXPECT_EQ(apply.arrived.at, now_);
  EXPECT_EQ(apply.arrived.wall_ahead, kWall);
  EXPECT_THAT(answers(), IsEmpty());
  follow();
  EXPECT_THAT(answers(), IsEmpty());
  ASSERT_THAT(disk_, SizeIs(1));
  store();
  EXPECT_THAT(
      answers(),
      ElementsAre(
          R"({"topic":"collision_object","id":"a","seq":3,"operation":"ADD","result":"done",)"
          R"("notes":["it was followed"]})"));
}

TEST_F(SceneTopicsTest, HandOnThatABrokerHeldTheMessageBack) {
  hear(ball("a"));
  hear(ball("b"), kTopicCollisionObject, Retain::no, "the broker was late just now");
  hear(long_ball("c"), kTopicCollisionObject, Retain::no, "the broker was late just now");
  parse();
  ASSERT_THAT(jobs_, SizeIs(3));
  EXPECT_EQ(std::get<ApplyMessages>(jobs_[0].what).arrived.late, "");
  for (const int i : {1, 2})
    EXPECT_EQ(std::get<ApplyMessages>(jobs_[i].what).arrived.late, "the broker was late just now");
}

TEST_F(SceneTopicsTest, TakeConstraintsAsTheyTakeObjects) {
  hear(R"({"name":"row","joint_constraints":[{"joint_name":"base/y","position":1,)"
       R"("tolerance_above":0.5,"tolerance_below":0.5}]})",
       kTopicPlanningConstraints);
  follow();
  store();
  EXPECT_THAT(answers(),
              ElementsAre(R"({"topic":"planning_constraints","name":"row","result":"done"})"));
}

TEST_F(SceneTopicsTest, AnswerWhatIsRefusedWithPathAndReason) {
  hear(R"({"header":{"frame_id":"map"},"id":"a","primitives":[{"type":2,"dimensions":[1,1]}]})");
  EXPECT_THAT(jobs_, IsEmpty());
  hear(ball("nobody"));
  follow();
  EXPECT_THAT(disk_, IsEmpty()) << "nothing has changed";
  EXPECT_THAT(answers(),
              ElementsAre(AllOf(HasSubstr("refused"), HasSubstr("primitives[0].dimensions")),
                          AllOf(HasSubstr("refused"), HasSubstr("is not liked"))));
}

TEST_F(SceneTopicsTest, AnswerAListInItsOrderAndFollowWhatIsGood) {
  hear("[" + ball("a") + "," + ball("nobody") + R"(,{"id":"b"},)" + ball("c") + "]");
  ASSERT_THAT(jobs_, SizeIs(1));
  EXPECT_THAT(std::get<ApplyMessages>(jobs_.front().what).messages, SizeIs(3));
  follow();
  store();
  const auto all = answers();
  ASSERT_THAT(all, SizeIs(1));
  const auto read = json::parse(all[0]);
  ASSERT_TRUE(read.ok());
  std::string results;
  for (const auto& answer : *read->root.list())
    results += *answer.find("id")->text() + ":" + *answer.find("result")->text() + " ";
  EXPECT_EQ(results, "a:done nobody:refused b:refused c:done ");
}

TEST_F(SceneTopicsTest, AnswerInTheOrderOfWhatIsAnswered) {
  hear(ball("a"));
  hear("{");  // could be answered at once
  EXPECT_THAT(answers(), IsEmpty());
  follow();
  store();
  EXPECT_THAT(answers(), ElementsAre(HasSubstr("\"a\""), HasSubstr("refused")));
}

TEST_F(SceneTopicsTest, RefuseWhatIsRetainedWithoutReadingIt) {
  hear(ball("a"), kTopicCollisionObject, Retain::stored);
  hear(long_ball("a"), kTopicCollisionObject, Retain::asked);
  EXPECT_THAT(jobs_, IsEmpty());
  EXPECT_THAT(texts_, IsEmpty());
  EXPECT_THAT(answers(), AllOf(SizeIs(2), Each(HasSubstr("retain"))));
  hear("", kTopicCollisionObject, Retain::asked);
  EXPECT_THAT(answers(), IsEmpty()) << "how one is taken back";
}

TEST_F(SceneTopicsTest, HaveLargeMessagesReadElsewhereAndFollowThemInTheirOrder) {
  hear(long_ball("large"));
  hear(ball("small"));
  EXPECT_THAT(jobs_, IsEmpty()) << "it came after the other";
  ASSERT_THAT(texts_, SizeIs(2));
  parse();
  ASSERT_THAT(jobs_, SizeIs(2));
  hear(ball("next"));
  EXPECT_THAT(texts_, IsEmpty());
  follow();
  store();
  store();
  EXPECT_THAT(answers(), ElementsAre(HasSubstr("large"), HasSubstr("small"), HasSubstr("next")));
}

TEST_F(SceneTopicsTest, RefuseWhatIsTooLargeAtOnce) {
  hear(std::string((std::size_t{2} << 20) + 1, ' '));
  EXPECT_THAT(texts_, IsEmpty());
  EXPECT_THAT(answers(), ElementsAre(HasSubstr("refused")));
}

TEST_F(SceneTopicsTest, RefuseInWordsWhatFindsNoRoom) {
  hear(long_ball("a"));
  Actions actions;
  outlet_->on_unparsed(texts_.front().number, actions);
  ASSERT_THAT(actions, SizeIs(1));
  EXPECT_THAT(std::get<PublishText>(actions[0]).text,
              HasSubstr("64 large messages, or 8 MiB of them, wait"));
  texts_.clear();
  hear(ball("b"));
  ASSERT_THAT(jobs_, SizeIs(1)) << "nothing is being parsed any more";
  actions.clear();
  outlet_->on_unasked(jobs_.front(), actions);
  ASSERT_THAT(actions, SizeIs(1));
  EXPECT_THAT(std::get<PublishText>(actions[0]).text,
              AllOf(HasSubstr("\"b\""), HasSubstr("refused"), HasSubstr("behind")));
}

TEST_F(SceneTopicsTest, GatherWhatComesWhileTheDiskWrites) {
  hear(ball("a"));
  follow();
  ASSERT_THAT(disk_, SizeIs(1));
  for (int i = 0; i < 50; ++i) hear(ball("b"));
  follow();
  EXPECT_THAT(disk_, SizeIs(1)) << "one at a time";
  store();
  EXPECT_THAT(answers(), SizeIs(1));
  ASSERT_THAT(disk_, SizeIs(1)) << "one for all";
  EXPECT_THAT(std::get<store::SaveScene>(disk_[0].what).texts, SizeIs(2));
  store();
  EXPECT_THAT(answers(), SizeIs(50));
  EXPECT_THAT(disk_, IsEmpty());
}

TEST_F(SceneTopicsTest, TellWhatTheDiskDidNotTakeThoughItCounts) {
  hear(ball("a"));
  follow();
  store("the disk is full");
  EXPECT_THAT(answers(), ElementsAre(AllOf(HasSubstr("done"), HasSubstr("the disk is full"))));
  EXPECT_THAT(outlet_->trouble(now_), HasSubstr("the disk is full"));
  pass(5s);
  store();
  EXPECT_EQ(outlet_->trouble(now_), "") << "it is tried again";
  EXPECT_THAT(answers(), IsEmpty());
}

TEST_F(SceneTopicsTest, DoNotWaitForADiskThatNeverAnswers) {
  hear(ball("a"));
  follow();
  pass(4s);
  EXPECT_THAT(answers(), IsEmpty());
  pass(2s);
  EXPECT_THAT(answers(), ElementsAre(AllOf(HasSubstr("done"), HasSubstr("not taken it yet"))));
  store();
  EXPECT_THAT(answers(), IsEmpty()) << "answered once";
}

TEST_F(SceneTopicsTest, TakeAHundredMessagesASecondAndABurst) {
  for (int i = 0; i < 250; ++i) hear(ball("a"));
  EXPECT_THAT(jobs_, SizeIs(200));
  jobs_.clear();
  now_ += 500ms;
  for (int i = 0; i < 250; ++i) hear(ball("a"));
  EXPECT_THAT(jobs_, SizeIs(50));
}

TEST_F(SceneTopicsTest, CountEachMessageOfAListInPart) {
  hear(list_of(1000));
  parse();
  ASSERT_THAT(jobs_, SizeIs(1));
  jobs_.clear();
  for (int i = 0; i < 250; ++i) hear(ball("a"));
  EXPECT_THAT(jobs_, SizeIs(99)) << "200 less one and 999 tenths";
}

TEST_F(SceneTopicsTest, AnswerAFloodWithoutAFlood) {
  for (int i = 0; i < 10'000; ++i) {
    now_ += 1ms;
    hear(ball("a"));
    if (i % 100 == 0) {
      follow();
      store();
    }
  }
  follow();
  store();
  pass(1s);
  store();
  std::size_t refused = 0;
  const auto all = answers();
  for (const auto& answer : all) refused += answer.find("slow down") == std::string::npos ? 0 : 1;
  EXPECT_NEAR(static_cast<double>(all.size() - refused), 1200, 5) << "ten seconds and a burst";
  EXPECT_LT(refused, 130U);
  EXPECT_THAT(all, Contains(HasSubstr("slow down, or send them as a list: 100 messages a second "
                                      "are taken, and 200 at once")));
  DaemonStatus status;
  outlet_->count(status);
  EXPECT_EQ(status.scene_messages_unanswered + all.size(), 10'000U) << "and nothing is lost";
}

TEST_F(SceneTopicsTest, LetOnlySoManyWait) {
  for (int i = 0; i < 3000; ++i) {
    now_ += 10ms;  // within the rate
    hear(ball("a"));
  }
  EXPECT_LE(jobs_.size(), 1000U);
  EXPECT_GT(jobs_.size(), 900U);
}

TEST(SceneTopicsWithoutAScene, AreRefusedInWords) {
  SceneOutlet outlet(false, {}, [](Time) { return RobotNow{}; });
  EXPECT_EQ(outlet.wants().size(), 2U);
  Actions actions;
  EXPECT_TRUE(outlet.on_message(kTopicCollisionObject, ball("a"), {}, Time{1s}, actions));
  ASSERT_THAT(actions, SizeIs(1));
  EXPECT_THAT(std::get<PublishText>(actions[0]).text,
              AllOf(HasSubstr("refused"), HasSubstr("no section scene")));
  actions.clear();
  for (int i = 0; i < 1000; ++i)
    EXPECT_TRUE(outlet.on_message(kTopicCollisionObject, ball("a"), {}, Time{1s}, actions));
  EXPECT_LT(actions.size(), 30U);
}

}  // namespace
}  // namespace drover::publish
