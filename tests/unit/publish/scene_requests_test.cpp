// What persons ask of the scene by the daemon's socket.
#include "json/located_json.h"
#include "publish/not_while.h"
#include "tests/unit/publish/scene_outlet_fixture.h"

namespace drover::publish {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr GeodeticPoint kField{48.0005, 11.0005, 500};

/// About 74 m by 111 m.
std::string import_line(const std::string& name, const std::string& kind = "keep_in") {
  return R"({"cmd":"zone_import","name":")" + name + R"(","kind":")" + kind +
         R"(","source":"yard.geojson","text":"{\"type\":\"Polygon\",\"coordinates\":)"
         R"([[[11,48],[11.001,48],[11.001,48.001],[11,48.001],[11,48]]]}"})";
}
std::string member(const std::string& line, std::string_view name) {
  const auto read = json::parse(line);
  if (!read) return "no JSON: " + line;
  const auto* node = read->root.find(name);
  if (node == nullptr) return "";
  if (const auto* text = node->text()) return *text;
  if (const auto* said = node->boolean()) return *said ? "true" : "false";
  return "another thing";
}

class SceneRequestsTest : public SceneOutletTest {
 protected:
  SceneRequestsTest() {
    make(true);
    robot_.place = {kField, scene::Point2{0, 0}};
  }
  std::string only_reply() {
    const auto all = replies();
    EXPECT_THAT(all, SizeIs(1));
    return all.empty() ? "" : all[0];
  }
  void import(const std::string& name) {
    ask(import_line(name));
    parse();
    store();
    follow();
    EXPECT_EQ(member(only_reply(), "ok"), "true");
  }
};

TEST_F(SceneRequestsTest, LeaveTheLinesOfOthersAlone) {
  restore();
  Actions actions;
  for (const char* line : {R"({"cmd":"status"})", "{", R"({"name":"scene_list"})", ""})
    EXPECT_FALSE(outlet_->on_line(7, line, now_, actions)) << line;
}

TEST_F(SceneRequestsTest, AreRefusedUntilWhatIsStoredIsRead) {
  ask(R"({"cmd":"scene_list"})");
  EXPECT_THAT(only_reply(), AllOf(HasSubstr(R"("ok":false)"), HasSubstr("being read")));
}

TEST_F(SceneRequestsTest, ListWhatIsThere) {
  restore();
  ask(R"({"cmd":"scene_list"})");
  ASSERT_THAT(jobs_, SizeIs(1));
  SceneRow box{store::kObjectKind, "box"};
  box.shapes = 2;
  box.in_map = scene::Point2{3, 4};
  SceneRow row{store::kConstraintKind, "row"};
  row.joint = 1;
  reply(jobs_.front().number, SceneListed{{box, row}});
  EXPECT_EQ(only_reply(),
            R"({"ok":true,"objects":[{"id":"box","shapes":2,"triangles":0,"x_m":3,"y_m":4,)"
            R"("distance_m":5,"arrived_s":null}],"constraints":[{"name":"row","joint":1,)"
            R"("position":0,"orientation":0,"visibility":0,"arrived_s":null}],"problem":""})");
}

TEST_F(SceneRequestsTest, TellTheDistanceToWhatIsNearestOfALargeThing) {
  restore();
  ask(R"({"cmd":"scene_list"})");
  SceneRow wall{store::kObjectKind, "wall"};
  wall.in_map = scene::Point2{30, 40};
  wall.nearest = scene::Point2{0, 2};
  reply(jobs_.front().number, SceneListed{{wall}});
  EXPECT_THAT(only_reply(), HasSubstr(R"("x_m":30,"y_m":40,"distance_m":2,)"));
}

TEST_F(SceneRequestsTest, ShowAnObjectAsAMessage) {
  restore();
  ask(R"({"cmd":"scene_show","name":"box"})");
  scene::CollisionObject box;
  box.id = "box";
  box.header.frame_id = "map";
  box.primitives.push_back({scene::SolidPrimitive::SPHERE, {1}});
  box.primitive_poses.emplace_back();
  reply(jobs_.front().number,
        SceneShown{std::make_shared<const SceneContent>(scene::StoredObject{{box}, {}}), nullptr});
  parse();
  const auto line = only_reply();
  EXPECT_THAT(line, AllOf(HasSubstr(R"("ok":true,"object":[{)"), HasSubstr(R"("id":"box")")));
  EXPECT_TRUE(json::parse(line).ok());
  ask(R"({"cmd":"scene_show","name":"nobody"})");
  reply(jobs_.back().number, SceneShown{});
  EXPECT_THAT(only_reply(), HasSubstr("nothing named"));
}

TEST_F(SceneRequestsTest, ClearTheSceneOnTheDiskToo) {
  restore();
  ask(R"({"cmd":"scene_clear"})");
  ASSERT_TRUE(std::holds_alternative<ClearScene>(jobs_.front().what));
  follow();
  EXPECT_THAT(replies(), IsEmpty());
  ASSERT_THAT(disk_, SizeIs(1));
  EXPECT_THAT(std::get<store::SaveScene>(disk_[0].what).texts, IsEmpty());
  store();
  EXPECT_EQ(member(only_reply(), "ok"), "true");

  ask(R"({"cmd":"scene_clear"})");
  follow();
  store("the disk is full");
  EXPECT_THAT(only_reply(), AllOf(HasSubstr(R"("ok":false)"), HasSubstr("after a restart")));
}

TEST_F(SceneRequestsTest, TakeNothingAwayWhileATaskRuns) {
  SceneRestored restored;
  restored.problem = "the stored scene is lost";
  restored.zones_problem = "the zones are not known";
  restore(std::move(restored));
  robot_.busy = not_while(Owner::task, true);
  for (const char* cmd :
       {"scene_clear", "scene_accept_loss", "zone_delete", "zone_forget_unreadable"}) {
    ask(std::string(R"({"cmd":")") + cmd + R"(","name":"yard"})");
    EXPECT_THAT(only_reply(), AllOf(HasSubstr(R"("ok":false)"), HasSubstr("task"))) << cmd;
  }
  EXPECT_THAT(jobs_, IsEmpty());
  EXPECT_THAT(disk_, IsEmpty());
}

TEST_F(SceneRequestsTest, ImportAZoneThatIsStoredThenActsThenIsAcknowledged) {
  restore();
  robot_.busy = not_while(Owner::task, true);  // it may be
  ask(import_line("yard"));
  EXPECT_THAT(disk_, IsEmpty());
  parse();
  ASSERT_THAT(disk_, SizeIs(1));
  const auto& save = std::get<store::SaveZone>(disk_[0].what);
  EXPECT_EQ(save.name, "yard");
  EXPECT_EQ(save.wall_s, 1.7e9);
  EXPECT_THAT(jobs_, IsEmpty());
  store();
  ASSERT_THAT(jobs_, SizeIs(1));
  const auto& set = std::get<SetZones>(jobs_.front().what);
  ASSERT_THAT(*set.zones, SizeIs(1));
  EXPECT_EQ((*set.zones)[0].name, "yard");
  EXPECT_EQ(set.problem, "");
  EXPECT_THAT(replies(), IsEmpty());
  follow();
  const auto line = only_reply();
  const auto read = json::parse(line);
  ASSERT_TRUE(read.ok()) << line;
  EXPECT_EQ(member(line, "ok"), "true");
  EXPECT_EQ(member(line, "replaced"), "false");
  const auto* zone = read->root.find("zone");
  ASSERT_NE(zone, nullptr) << line;
  EXPECT_NEAR(*zone->find("area_m2")->number(), 74.5 * 111.2, 100);
  EXPECT_NEAR(*zone->find("perimeter_m")->number(), 371, 3);
  EXPECT_EQ(zone->find("distance_m")->number(), 0) << "the robot is inside";
  EXPECT_TRUE(zone->find("bearing_deg")->is_null());
  EXPECT_EQ(*zone->find("kind")->text(), "keep_in");
}

TEST_F(SceneRequestsTest, ListZonesWithTheirMeasures) {
  restore();
  import("yard");
  robot_.place.in_map = scene::Point2{200, 0};
  ask(R"({"cmd":"zone_list"})");
  parse();
  const auto line = only_reply();
  const auto read = json::parse(line);
  ASSERT_TRUE(read.ok()) << line;
  const auto& zone = read->root.find("zones")->list()->at(0);
  EXPECT_NEAR(*zone.find("distance_m")->number(), 200 - 37.3, 0.5);
  EXPECT_NEAR(*zone.find("bearing_deg")->number(), 270, 1);
}

TEST_F(SceneRequestsTest, RefuseAFileThatIsWrongWithItsPlace) {
  restore();
  ask(R"({"cmd":"zone_import","name":"a","kind":"keep_in","source":"a","text":"{\n\"type\":}"})");
  parse();
  EXPECT_THAT(only_reply(), AllOf(HasSubstr(R"("ok":false)"), HasSubstr("line 2")));
  ask(import_line("a", "keep"));
  parse();
  EXPECT_THAT(only_reply(), HasSubstr("keep_in or keep_out"));
  EXPECT_THAT(disk_, IsEmpty());
}

TEST_F(SceneRequestsTest, ChangeNoZoneThatIsNotStored) {
  restore();
  ask(import_line("yard"));
  parse();
  store("the disk is full");
  EXPECT_THAT(only_reply(), HasSubstr("the disk is full"));
  EXPECT_THAT(jobs_, IsEmpty());
  import("yard");
  ask(R"({"cmd":"zone_delete","name":"yard"})");
  store("the disk is full");
  EXPECT_THAT(only_reply(), HasSubstr("the disk is full"));
  EXPECT_THAT(jobs_, IsEmpty()) << "it acts on";
}

TEST_F(SceneRequestsTest, DeleteAZone) {
  restore();
  import("yard");
  import("pond");
  ask(R"({"cmd":"zone_delete","name":"yard"})");
  store();
  ASSERT_THAT(jobs_, SizeIs(1));
  const auto zones = std::get<SetZones>(jobs_.front().what).zones;
  ASSERT_THAT(*zones, SizeIs(1));
  EXPECT_EQ(zones->front().name, "pond");
  follow();
  EXPECT_EQ(member(only_reply(), "ok"), "true");
}

/// It is asked for while nobody moves the robot, and the disk is slow.
TEST_F(SceneRequestsTest, StoreAZoneAgainThatMayNotBeTakenAwayAnyMore) {
  restore();
  import("yard");
  const auto refuse_it = [this] {
    ask(R"({"cmd":"zone_delete","name":"yard"})");
    store();
    ASSERT_TRUE(std::get<SetZones>(jobs_.front().what).takes_away);
    const auto number = jobs_.front().number;
    jobs_.clear();
    reply(number, SceneRefused{not_while(Owner::joint_command, false)});
    ASSERT_THAT(disk_, SizeIs(1));
    const auto& save = std::get<store::SaveZone>(disk_[0].what);
    EXPECT_EQ(save.name, "yard");
    EXPECT_THAT(save.text, HasSubstr("yard"));
  };
  refuse_it();
  store();
  EXPECT_THAT(only_reply(), AllOf(HasSubstr(R"("ok":false)"), HasSubstr("joint commands")));
  EXPECT_THAT(jobs_, IsEmpty()) << "it acts on";
  refuse_it();
  store("the disk is full");
  EXPECT_THAT(only_reply(), AllOf(HasSubstr("joint commands"), HasSubstr("lost at a restart")));
  ask(R"({"cmd":"zone_list"})");
  parse();
  EXPECT_THAT(only_reply(), HasSubstr("yard"));
  ask(R"({"cmd":"zone_delete","name":"yard"})");
  store();
  follow();
  EXPECT_EQ(member(only_reply(), "ok"), "true");
}

TEST_F(SceneRequestsTest, SayThatTheSceneWasNotClearedWhenItWasToBe) {
  restore();
  ask(R"({"cmd":"scene_clear"})");
  const auto number = jobs_.front().number;
  jobs_.clear();
  reply(number, SceneRefused{not_while(Owner::task, true)});
  EXPECT_THAT(only_reply(), AllOf(HasSubstr(R"("ok":false)"), HasSubstr("task")));
  EXPECT_THAT(disk_, IsEmpty());
}

TEST_F(SceneRequestsTest, TakeNothingAwayWhoeverMovesTheRobot) {
  restore();
  for (const Owner owner : {Owner::manual, Owner::joint_command}) {
    robot_.busy = not_while(owner, false);
    for (const char* cmd : {"scene_clear", "zone_delete"}) {
      ask(std::string(R"({"cmd":")") + cmd + R"(","name":"yard"})");
      EXPECT_THAT(only_reply(), AllOf(HasSubstr(R"("ok":false)"), HasSubstr("not while")));
    }
  }
  EXPECT_TRUE(not_while(Owner::nobody, false).empty());
  EXPECT_TRUE(not_while(Owner::estop, false).empty());
  EXPECT_THAT(jobs_, IsEmpty());
}

TEST_F(SceneRequestsTest, ReplaceAZoneButNotUnderATask) {
  restore();
  import("yard");
  robot_.busy = not_while(Owner::task, true);
  ask(import_line("yard"));
  parse();
  EXPECT_THAT(only_reply(), AllOf(HasSubstr(R"("ok":false)"), HasSubstr("task")));
  robot_.busy = {};
  ask(import_line("yard"));
  parse();
  store();
  ASSERT_THAT(*std::get<SetZones>(jobs_.front().what).zones, SizeIs(1));
  follow();
  EXPECT_EQ(member(only_reply(), "replaced"), "true");
}

TEST_F(SceneRequestsTest, ChangeTheZonesOneAtATime) {
  restore();
  ask(import_line("a"));
  ask(import_line("b"));
  parse();  // both were being read at once
  EXPECT_THAT(only_reply(), HasSubstr("under way"));
  ask(R"({"cmd":"zone_delete","name":"a"})");
  EXPECT_THAT(only_reply(), HasSubstr("under way"));
  store();
  follow();
  EXPECT_EQ(member(only_reply(), "ok"), "true");
}

TEST_F(SceneRequestsTest, SetStoredZonesAgainWhenTheSceneHadNoRoom) {
  restore();
  ask(import_line("yard"));
  parse();
  store();
  const auto job = std::move(jobs_.front());
  jobs_.clear();
  Actions actions;
  outlet_->on_unasked(job, actions);
  EXPECT_THAT(actions, IsEmpty());
  pass(100ms);
  ASSERT_THAT(jobs_, SizeIs(1));
  follow();
  EXPECT_EQ(member(only_reply(), "ok"), "true");
}

TEST_F(SceneRequestsTest, TellOfZonesThatCannotBeReadUntilTheyAreDeleted) {
  SceneRestored restored;
  restored.unreadable = {{"yard", "it is damaged"}};
  restore(std::move(restored));
  EXPECT_THAT(outlet_->trouble(now_), AllOf(HasSubstr("yard"), HasSubstr("it is damaged")));
  EXPECT_THAT(log_, ElementsAre(HasSubstr("does not move")));
  ask(R"({"cmd":"zone_list"})");
  parse();
  EXPECT_THAT(only_reply(), HasSubstr(R"({"name":"yard","unreadable":"it is damaged"})"));
  ask(R"({"cmd":"zone_forget_unreadable"})");
  EXPECT_THAT(only_reply(), HasSubstr("one by one"));
  ask(R"({"cmd":"zone_delete","name":"yard"})");
  store();
  EXPECT_EQ(std::get<SetZones>(jobs_.front().what).problem, "");
  follow();
  EXPECT_EQ(outlet_->trouble(now_), "");
}

TEST_F(SceneRequestsTest, ForgetAFileOfZonesThatCannotBeRead) {
  SceneRestored restored;
  restored.zones_problem = "the stored zones are not known: noise";
  restore(std::move(restored));
  EXPECT_THAT(outlet_->trouble(now_), HasSubstr("noise"));
  ask(R"({"cmd":"zone_forget_unreadable"})");
  ASSERT_TRUE(std::holds_alternative<store::ForgetUnreadableZones>(disk_.at(0).what));
  store();
  EXPECT_EQ(std::get<SetZones>(jobs_.front().what).problem, "");
  follow();
  EXPECT_EQ(member(only_reply(), "ok"), "true");
  EXPECT_EQ(outlet_->trouble(now_), "");
}

TEST_F(SceneRequestsTest, AcceptALossOfTheScene) {
  make(true, {{std::string(store::kObjectKind), "good", 1, "x"},
              {std::string(store::kObjectKind), "bad", 1, "y"}});
  restore();
  ask(R"({"cmd":"scene_accept_loss"})");
  EXPECT_THAT(only_reply(), HasSubstr("nothing of the scene is lost"));

  SceneRestored restored;
  restored.problem = "the stored object \"bad\" cannot be read";
  restored.lost = {{std::string(store::kObjectKind), "bad"}};
  restore(std::move(restored));
  EXPECT_THAT(outlet_->trouble(now_), HasSubstr("bad"));
  ask(R"({"cmd":"scene_accept_loss"})");
  const auto& accept = std::get<store::AcceptLoss>(disk_.at(0).what);
  ASSERT_THAT(accept.texts, SizeIs(1));
  EXPECT_EQ(accept.texts[0].name, "good");
  EXPECT_THAT(jobs_, IsEmpty()) << "first it is durable";
  store();
  ASSERT_TRUE(std::holds_alternative<AcceptSceneLoss>(jobs_.front().what));
  follow();
  EXPECT_EQ(member(only_reply(), "ok"), "true");
  EXPECT_EQ(outlet_->trouble(now_), "");
}

TEST_F(SceneRequestsTest, SayWhenTheSceneIsBehind) {
  restore();
  ask(R"({"cmd":"scene_list"})");
  const auto job = std::move(jobs_.front());
  Actions actions;
  outlet_->on_unasked(job, actions);
  ASSERT_THAT(actions, SizeIs(1));
  EXPECT_THAT(std::get<Reply>(actions[0]).line, HasSubstr("behind"));
  ask(import_line("yard"));
  actions.clear();
  outlet_->on_unparsed(texts_.front().number, actions);
  ASSERT_THAT(actions, SizeIs(2)) << "it is logged, too";
  EXPECT_THAT(std::get<Reply>(actions[1]).line, HasSubstr("being read already"));
}

TEST(SceneRequestsWithoutAScene, AreRefusedInWords) {
  SceneOutlet outlet(false, {}, [](Time) { return RobotNow{}; });
  Actions actions;
  EXPECT_TRUE(outlet.on_line(7, R"({"cmd":"zone_list"})", Time{1s}, actions));
  ASSERT_THAT(actions, SizeIs(1));
  EXPECT_THAT(std::get<Reply>(actions[0]).line, HasSubstr("no section scene"));
}

}  // namespace
}  // namespace drover::publish
