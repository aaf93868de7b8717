// What the scene's thread does of its jobs in a turn.
#include "runtime/scene_work.h"

#include <gmock/gmock.h>

#include <cmath>

#include "publish/scene/stored_text.h"
#include "scene/zone/import_zone.h"
#include "scene/zone/zone_text.h"

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr GeodeticPoint kField{23.1496524965, 113.0196366456667, 20};

scene::KeeperSettings settings() {
  scene::KeeperSettings made;
  made.look.footprint = {{-0.45, -0.35}, {0.45, -0.35}, {0.45, 0.35}, {-0.45, 0.35}};
  made.heights = {0.05, 1};
  return made;
}

scene::CollisionObject box(const std::string& id, double x_m, double y_m = 0) {
  scene::CollisionObject object;
  object.header.frame_id = "map";
  object.id = id;
  object.primitives.push_back({scene::SolidPrimitive::BOX, {0.4, 0.4, 1}});
  object.primitive_poses.push_back({{x_m, y_m, 0.5}, {}});
  object.primitive_poses.back().orientation.w = 1;
  return object;
}

scene::CollisionObject removed(const std::string& id) {
  scene::CollisionObject object;
  object.id = id;
  object.operation = scene::CollisionObject::REMOVE;
  return object;
}

store::NamedText stored(const scene::CollisionObject& object) {
  return {std::string(store::kObjectKind), object.id, 1,
          publish::stored_text(scene::StoredObject{{object}, kField})};
}

std::shared_ptr<const Path> straight(std::uint64_t number, double length_m) {
  auto path = std::make_shared<Path>();
  path->number = number;
  for (double x_m = 0; x_m <= length_m; x_m += 0.5) path->points.push_back({x_m, 0});
  return path;
}

class SceneWorkTest : public testing::Test {
 protected:
  void make(store::StoredScene stored = {}) {
    exchange_ = std::make_unique<SceneExchange>();
    work_ = std::make_unique<SceneWork>(
        settings(), *exchange_, std::make_shared<const store::StoredScene>(std::move(stored)));
  }
  /// At the origin, looking east, at rest.
  Viewpoint here() {
    Viewpoint from;
    from.t = now_ += 25ms;
    from.pose.time = from.t;
    from.pose.position_sigma_m = 0.01;
    from.pose.yaw_sigma_rad = 0.01;
    from.origin_set = true;
    from.origin = kField;
    return from;
  }
  void see() { work_->see(here()); }
  void work() {
    work_->work([] { return true; });
    work_->check([] { return true; });
    take_replies();
  }
  void take_replies() {
    work_->send_replies();
    publish::SceneReply reply;
    while (exchange_->replies.pop(reply)) replies_.push_back(std::move(reply));
  }
  void give(decltype(publish::SceneJob::what) what) {
    ASSERT_TRUE(exchange_->jobs.push(publish::SceneJob{++last_, std::move(what)}));
  }
  void apply(std::vector<publish::SceneValue> messages) {
    give(publish::ApplyMessages{std::move(messages), {now_, 0s}});
  }
  template <class Reply>
  Reply take() {
    if (replies_.empty() || !std::holds_alternative<Reply>(replies_.front().what)) {
      ADD_FAILURE() << "no such reply";
      return {};
    }
    auto reply = std::get<Reply>(std::move(replies_.front().what));
    replies_.erase(replies_.begin());
    return reply;
  }

  std::unique_ptr<SceneExchange> exchange_;
  std::unique_ptr<SceneWork> work_;
  std::vector<publish::SceneReply> replies_;
  std::uint64_t last_ = 0;
  Time now_{100s};
};

TEST_F(SceneWorkTest, KeepsHowWellAPlaceIsKnownOverARestart) {
  store::StoredScene before;
  before.texts = {{std::string(store::kObjectKind), "box1", 1,
                   publish::stored_text(scene::StoredObject{{box("box1", 2)}, kField, 0.15})}};
  make(std::move(before));
  work();
  see();
  const double wider_m = 2 * 0.15;
  EXPECT_NEAR(work_->look().ahead_m, 1.8 - 0.45 - 0.1 - wider_m, 0.08) << "its own error is small";
  replies_.clear();
  // What it places by itself is told to the store.
  auto seen = box("seen", 5);
  seen.header.frame_id = "base_link";
  apply({seen});
  work();
  const auto applied = take<publish::MessagesApplied>();
  ASSERT_THAT(applied.changes, SizeIs(1));
  const double kept_m = std::get<scene::StoredObject>(*applied.changes[0].content).place_sigma_m;
  EXPECT_NEAR(kept_m, 0.01 + 0.01 * std::hypot(5.2, 0.2), 1e-6);
}

TEST_F(SceneWorkTest, KnowsNothingBeforeWhatIsStoredIsRead) {
  make();
  see();
  EXPECT_FALSE(work_->look().unknown.empty());
  work_->work([] { return false; });
  see();
  EXPECT_FALSE(work_->look().unknown.empty()) << "there was no time for it";
  work();
  see();
  EXPECT_EQ(work_->look().unknown, "");
  EXPECT_GT(work_->look().ahead_m, 1);
  const auto restored = take<publish::SceneRestored>();
  EXPECT_EQ(restored.problem, "");
  EXPECT_EQ(restored.zones_problem, "");
  ASSERT_NE(restored.zones, nullptr);
  EXPECT_THAT(*restored.zones, IsEmpty());
}

TEST_F(SceneWorkTest, BeginsWithWhatIsStored) {
  make({{stored(box("near", 1.5)), stored(box("far", 20))}, "", {}, ""});
  work();
  see();
  const auto found = work_->look();
  EXPECT_EQ(found.unknown, "");
  EXPECT_LT(found.ahead_m, 1);
  EXPECT_THAT(std::string(found.first.view()), HasSubstr("near"));
}

TEST_F(SceneWorkTest, TellsWhatOfTheStoredCannotBeReadAndFreesNothing) {
  make({{stored(box("good", 20)), {std::string(store::kObjectKind), "bad", 1, "noise"}},
        "",
        {},
        ""});
  work();
  const auto restored = take<publish::SceneRestored>();
  ASSERT_THAT(restored.lost, SizeIs(1));
  EXPECT_EQ(restored.lost[0].name, "bad");
  EXPECT_THAT(restored.problem, HasSubstr("\"bad\" cannot be read"));
  see();
  EXPECT_FALSE(work_->look().unknown.empty());
  give(publish::AcceptSceneLoss{});
  work();
  see();
  EXPECT_EQ(work_->look().unknown, "");
}

TEST_F(SceneWorkTest, FreesNothingWhileAStoredZoneCannotBeRead) {
  make({{}, "", {{"zone", "yard", 1, "noise"}}, ""});
  work();
  const auto restored = take<publish::SceneRestored>();
  ASSERT_THAT(restored.unreadable, SizeIs(1));
  EXPECT_EQ(restored.unreadable[0].name, "yard");
  see();
  EXPECT_FALSE(work_->look().unknown.empty());
  give(publish::SetZones{std::make_shared<const std::vector<scene::Zone>>(), ""});
  work();
  see();
  EXPECT_EQ(work_->look().unknown, "");
}

TEST_F(SceneWorkTest, FollowsMessagesAndTellsWhatIsToBeStored) {
  make();
  see();
  work();
  (void)take<publish::SceneRestored>();
  apply({box("a", 5), box("b", 6), removed("a"), removed("nobody")});
  work();
  const auto applied = take<publish::MessagesApplied>();
  ASSERT_THAT(applied.results, SizeIs(4));
  EXPECT_FALSE(applied.results[0].refusal);
  EXPECT_FALSE(applied.results[2].refusal);
  EXPECT_TRUE(applied.results[3].refusal);
  ASSERT_THAT(applied.changes, SizeIs(2));
  EXPECT_EQ(applied.changes[0].name, "a");
  EXPECT_EQ(applied.changes[0].content, nullptr) << "what came of all of it";
  EXPECT_EQ(applied.changes[1].name, "b");
  ASSERT_NE(applied.changes[1].content, nullptr);
  EXPECT_EQ(std::get<scene::StoredObject>(*applied.changes[1].content).origin.latitude_deg,
            kField.latitude_deg);
  see();
  EXPECT_LT(work_->look().ahead_m, 6);
}

TEST_F(SceneWorkTest, DoesALargeJobInParts) {
  make();
  see();
  work();
  replies_.clear();
  std::vector<publish::SceneValue> many;
  for (int i = 0; i < 100; ++i) many.emplace_back(box("b" + std::to_string(i), 5 + i));
  apply(std::move(many));
  int steps = 0;
  while (replies_.empty() && steps < 1000) {
    ++steps;
    bool first = true;
    work_->work([&first] { return std::exchange(first, false); });
    take_replies();
  }
  EXPECT_GT(steps, 50);
  EXPECT_THAT(take<publish::MessagesApplied>().results, SizeIs(100));
}

TEST_F(SceneWorkTest, ListsShowsAndClears) {
  make();
  see();
  work();
  apply({box("a", 5), box("b", 6)});
  give(publish::ListScene{});
  give(publish::ShowScene{"b"});
  give(publish::ShowScene{"nobody"});
  give(publish::ClearScene{});
  give(publish::ListScene{});
  work();
  replies_.erase(replies_.begin(), replies_.begin() + 2);
  const auto rows = take<publish::SceneListed>().rows;
  ASSERT_THAT(rows, SizeIs(2));
  EXPECT_EQ(rows[0].name, "a");
  EXPECT_EQ(rows[0].shapes, 1U);
  ASSERT_TRUE(rows[0].in_map.has_value());
  EXPECT_NEAR(rows[0].in_map->x_m, 5, 1e-9);
  ASSERT_TRUE(rows[0].nearest.has_value());
  EXPECT_LT(rows[0].nearest->x_m, 5 - 0.05) << "its near side";
  EXPECT_NE(take<publish::SceneShown>().object, nullptr);
  EXPECT_EQ(take<publish::SceneShown>().object, nullptr);
  (void)take<publish::SceneDone>();
  EXPECT_THAT(take<publish::SceneListed>().rows, IsEmpty());
}

TEST_F(SceneWorkTest, LooksAlongATrackThatIsToBeStarted) {
  make();
  see();
  work();
  replies_.clear();
  give(publish::CheckTrack{straight(1, 10), 20});
  work();
  EXPECT_FALSE(take<publish::TrackChecked>().offence);
  apply({box("box1", 5)});
  give(publish::CheckTrack{straight(2, 10), 20});
  give(publish::CheckTrack{straight(3, 3), 6});
  work();
  (void)take<publish::MessagesApplied>();
  const auto offence = take<publish::TrackChecked>().offence;
  ASSERT_TRUE(offence.has_value());
  EXPECT_THAT(offence->what, HasSubstr("box1"));
  EXPECT_NEAR(offence->way_m, 4.2, 0.3);
  EXPECT_NEAR(static_cast<double>(offence->point), 8, 1);
  EXPECT_FALSE(take<publish::TrackChecked>().offence) << "it ends before";
}

TEST_F(SceneWorkTest, KeepsThePathThatIsDriven) {
  make();
  see();
  work();
  give(publish::CheckTrack{straight(1, 10), 20});
  work();
  auto driving = here();
  driving.way = {1, true, 20, 0, 0};
  for (std::uint64_t number = 2; number < 40; ++number) {
    work_->see(driving);
    EXPECT_GT(work_->look().along_m, 1) << number;
    EXPECT_EQ(work_->look().path, 1U);
    give(publish::CheckTrack{straight(number, 10), 20});
    work();
    driving.t = driving.pose.time = now_ += 25ms;
  }
}

scene::CollisionObject moved(const std::string& id, double x_m, double y_m) {
  auto object = box(id, x_m, y_m);
  object.operation = scene::CollisionObject::MOVE;
  object.primitives.clear();
  return object;
}

/// Each message would make it begin anew, and after some it would be given up.
TEST_F(SceneWorkTest, BeginsALookAlongATrackOnceForAllThatChangedInATurn) {
  make();
  see();
  work();
  apply({box("a", 5, 30)});
  work();
  replies_.clear();
  give(publish::CheckTrack{straight(1, 1000), 2000});
  work_->work([] { return true; });
  work_->check([] { return false; });
  for (int i = 0; i < 200; ++i) apply({moved("a", 5, 30 + 0.01 * i)});
  work();
  ASSERT_THAT(replies_, SizeIs(201));
  EXPECT_EQ(std::get<publish::TrackChecked>(replies_.back().what).offence, std::nullopt);
}

TEST_F(SceneWorkTest, AnswersWhatTheNextLookTellsOf) {
  make();
  see();
  work();
  replies_.clear();
  apply({box("near", 1.5)});
  work_->work([] { return true; });
  publish::SceneReply reply;
  EXPECT_FALSE(exchange_->replies.pop(reply));
  see();
  EXPECT_LT(work_->look().ahead_m, 1);
  take_replies();
  (void)take<publish::MessagesApplied>();
}

/// A request may have waited since before that.
TEST_F(SceneWorkTest, TakesNothingAwayWhileSomebodyMovesTheRobot) {
  make();
  see();
  work();
  apply({box("a", 5)});
  work();
  const auto zones = std::make_shared<const std::vector<scene::Zone>>();
  auto driven = here();
  driven.way = {1, true, 20, 0, 0};
  for (const Owner owner : {Owner::task, Owner::manual, Owner::joint_command, Owner::nobody}) {
    driven.owner = owner;
    work_->see(driven);
    replies_.clear();
    give(publish::ClearScene{});
    give(publish::SetZones{zones, "", true});
    give(publish::SetZones{zones, "", false});
    give(publish::ListScene{});
    work();
    EXPECT_THAT(take<publish::SceneRefused>().why, HasSubstr("not while"));
    (void)take<publish::SceneRefused>();
    (void)take<publish::SceneDone>();
    EXPECT_THAT(take<publish::SceneListed>().rows, SizeIs(1));
    if (owner == Owner::manual) driven.way = {};
    if (owner == Owner::joint_command) driven.way = {1, true, 20, 0, 0};  // and no owner
  }
  driven.way = {};
  work_->see(driven);
  replies_.clear();
  give(publish::CheckTrack{straight(1, 3), 6});
  give(publish::ClearScene{});
  work();
  EXPECT_THAT(take<publish::SceneRefused>().why, HasSubstr("about to be moved"));
  EXPECT_FALSE(take<publish::TrackChecked>().offence);
  give(publish::ClearScene{});
  work();
  EXPECT_THAT(take<publish::SceneRefused>().why, HasSubstr("about to be moved"));
  now_ += 1s;
  see();
  give(publish::ClearScene{});
  work();
  (void)take<publish::SceneDone>();
}

/// An ADD that is there and an APPEND for which there is no room would be half an object.
TEST_F(SceneWorkTest, LosesAStoredObjectAsAWhole) {
  auto many = box("many", 1.5);
  many.primitives.assign(1000, many.primitives.front());
  many.primitive_poses.assign(1000, many.primitive_poses.front());
  scene::StoredObject whole{{many}, kField};
  many.operation = scene::CollisionObject::APPEND;
  whole.messages.resize(11, many);
  scene::StoredObject strange{{box("b", 20), box("a", 21)}, kField};
  make({{{std::string(store::kObjectKind), "many", 1, publish::stored_text(whole)},
         {std::string(store::kObjectKind), "b", 1, publish::stored_text(strange)},
         stored(box("good", 30))},
        "",
        {},
        ""});
  work();
  const auto restored = take<publish::SceneRestored>();
  ASSERT_THAT(restored.lost, SizeIs(2));
  EXPECT_EQ(restored.lost[0].name, "many");
  EXPECT_EQ(restored.lost[1].name, "b");
  give(publish::ListScene{});
  work();
  EXPECT_THAT(take<publish::SceneListed>().rows, SizeIs(1)) << "nothing of them is there";

  see();
  many.primitives.resize(1);
  many.primitive_poses.resize(1);
  apply({many});
  work();
  auto applied = take<publish::MessagesApplied>();
  ASSERT_TRUE(applied.results[0].refusal) << "half of it was told";
  EXPECT_THAT(applied.results[0].refusal->why, HasSubstr("accept-loss"));
  EXPECT_THAT(applied.changes, IsEmpty()) << "what is stored stays";
  apply({box("many", 9), many});
  work();
  applied = take<publish::MessagesApplied>();
  EXPECT_FALSE(applied.results[0].refusal) << "all of it";
  EXPECT_FALSE(applied.results[1].refusal) << "more of that";
  give(publish::AcceptSceneLoss{});
  work();
  (void)take<publish::SceneDone>();
  give(publish::ListScene{});
  work();
  EXPECT_THAT(take<publish::SceneListed>().rows, SizeIs(2));
}

TEST_F(SceneWorkTest, LosesNoReplyWhenNobodyTakesThem) {
  make();
  see();
  std::size_t given = 0;
  for (int turn = 0; turn < 10; ++turn) {
    while (exchange_->jobs.push(publish::SceneJob{++last_, publish::ListScene{}})) ++given;
    work_->work([] { return true; });
    work_->send_replies();
  }
  EXPECT_LT(given, 1000U) << "no new job is begun while replies wait";
  for (int turn = 0; turn < 10; ++turn) work();
  EXPECT_EQ(replies_.size(), given + 1) << "and that of the start";
}

}  // namespace
}  // namespace drover::runtime
