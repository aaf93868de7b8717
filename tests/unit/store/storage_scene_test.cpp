// The scene's jobs of the storage thread.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "store/storage.h"
#include "tests/unit/store/fault_files.h"

namespace drover::store {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

SceneText object(const std::string& name, const std::string& text, double arrived_s = 1) {
  return {std::string(kObjectKind), name, arrived_s, std::make_shared<LazyText>(text)};
}

std::vector<std::string> names_of(const std::vector<NamedText>& texts) {
  std::vector<std::string> names;
  for (const auto& text : texts) names.push_back(text.name);
  return names;
}

TEST(StorageOfTheScene, KeepsTextsThatAreMadeWhenTheyAreFirstNeeded) {
  FaultFiles files;
  Storage storage(files, "/state");
  int made = 0;
  const SceneText lazy{std::string(kObjectKind), "box", 5, std::make_shared<LazyText>([&made] {
                         ++made;
                         return std::string("a box");
                       })};
  EXPECT_EQ(made, 0);
  ASSERT_TRUE(storage.run({{}, SaveScene{{lazy}}}).ok);
  ASSERT_TRUE(storage.run({{}, SaveScene{{lazy, object("pole", "a pole")}}}).ok);
  EXPECT_EQ(made, 1) << "what has not changed is not written anew";
  const auto found = Storage(files, "/state").load(SceneAge{}).scene;
  ASSERT_NE(found, nullptr);
  ASSERT_THAT(names_of(found->texts), ElementsAre("box", "pole"));
  EXPECT_EQ(found->texts[0].text, "a box");
  EXPECT_EQ(found->texts[0].arrived_s, 5);
  EXPECT_EQ(found->problem, "");
  EXPECT_EQ(found->zones_problem, "");
}

TEST(StorageOfTheScene, IsLeftAloneWhereNobodyAsksForIt) {
  FaultFiles files;
  files.put("/state/scene.texts", "noise");
  const auto before = files.contents();
  EXPECT_EQ(Storage(files, "/state").load().scene, nullptr);
  EXPECT_EQ(files.contents(), before);
}

TEST(StorageOfTheScene, LeavesOutWhatIsTooOldAtTheStartOnly) {
  FaultFiles files;
  Storage storage(files, "/state");
  ASSERT_TRUE(storage.run({{}, SaveScene{{object("old", "a", 10), object("new", "b", 90)}}}).ok);
  const auto found = storage.load(SceneAge{100, 20}).scene;
  EXPECT_THAT(names_of(found->texts), ElementsAre("new"));
}

TEST(StorageOfTheScene, KeepsTellingOfALossUntilAPersonAcceptsIt) {
  FaultFiles files;
  files.put("/state/scene.texts", "noise");
  Storage storage(files, "/state");
  EXPECT_THAT(storage.load(SceneAge{}).scene->problem, HasSubstr("lost"));
  ASSERT_TRUE(storage.run({{}, SaveScene{{object("box", "a")}}}).ok);
  EXPECT_THAT(Storage(files, "/state").load(SceneAge{}).scene->problem, HasSubstr("lost"));
  ASSERT_TRUE(storage.run({{}, AcceptLoss{{object("box", "a")}}}).ok);
  const auto found = Storage(files, "/state").load(SceneAge{}).scene;
  EXPECT_EQ(found->problem, "");
  EXPECT_THAT(names_of(found->texts), ElementsAre("box"));
}

TEST(StorageOfTheScene, KeepsAndDeletesZones) {
  FaultFiles files;
  Storage storage(files, "/state");
  (void)storage.load(SceneAge{});
  ASSERT_TRUE(storage.run({{}, SaveZone{"yard", "north", 7}}).ok);
  ASSERT_TRUE(storage.run({{}, SaveZone{"pond", "south", 8}}).ok);
  EXPECT_THAT(names_of(Storage(files, "/state").load(SceneAge{}).scene->zones),
              ElementsAre("yard", "pond"));
  EXPECT_FALSE(storage.run({{}, DeleteZone{"nobody"}}).ok);
  ASSERT_TRUE(storage.run({{}, DeleteZone{"yard"}}).ok);
  EXPECT_THAT(names_of(Storage(files, "/state").load(SceneAge{}).scene->zones),
              ElementsAre("pond"));
}

TEST(StorageOfTheScene, ForgetsZonesThatCannotBeReadWhenToldTo) {
  FaultFiles files;
  files.put("/state/zones.texts", "noise");
  Storage storage(files, "/state");
  EXPECT_THAT(storage.load(SceneAge{}).scene->zones_problem, HasSubstr("not known"));
  EXPECT_FALSE(storage.run({{}, SaveZone{"yard", "north", 7}}).ok);
  ASSERT_TRUE(storage.run({{}, ForgetUnreadableZones{}}).ok);
  EXPECT_EQ(Storage(files, "/state").load(SceneAge{}).scene->zones_problem, "");
}

TEST(StorageOfTheScene, SaysWhoseItsAnswersAre) {
  FaultFiles files;
  Storage storage(files, "/state");
  EXPECT_EQ(storage.run({{}, SaveScene{}}).whose, StoredFor::scene);
  EXPECT_EQ(storage.run({{}, DeleteZone{"a"}}).whose, StoredFor::scene);
  EXPECT_EQ(storage.run({{}, DeleteTrack{"a"}}).whose, StoredFor::tracks);
}

TEST(StorageOfTheScene, SaysWhyItIsNotStored) {
  FaultFiles files;
  Storage storage(files, "/state");
  files.plan(FaultFiles::Fault::fail, 1, ENOSPC);
  const auto reply = storage.run({{}, SaveScene{{object("box", "a")}}});
  EXPECT_FALSE(reply.ok);
  EXPECT_THAT(reply.reason, HasSubstr("No space left"));
}

}  // namespace
}  // namespace drover::store
