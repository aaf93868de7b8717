#include "publish/scene_saver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drover::publish {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr Time kNow{100s};

SceneChange added(const std::string& id) {
  scene::CollisionObject object;
  object.header.frame_id = "map";
  object.id = id;
  object.primitives.push_back({scene::SolidPrimitive::SPHERE, {1}});
  return {store::kObjectKind, id,
          std::make_shared<const SceneContent>(scene::StoredObject{{object}, {}})};
}
SceneChange gone(const std::string& id) {
  return {store::kObjectKind, id, nullptr};
}
std::vector<std::string> names(const std::vector<store::SceneText>& texts) {
  std::vector<std::string> all;
  for (const auto& text : texts) all.push_back(text.name);
  return all;
}
store::NamedText stored(const std::string& name) {
  return {std::string(store::kObjectKind), name, 1, "as it was"};
}

class ASceneSaver : public testing::Test {
 protected:
  std::uint64_t note(SceneChange change) { return saver_.note({&change, 1}, 50); }
  SceneSaver saver_{store::StoredScene{}};
};

TEST_F(ASceneSaver, HasNothingToDoUntilSomethingChanges) {
  EXPECT_FALSE(saver_.next(kNow));
}

TEST_F(ASceneSaver, SavesOneAtATimeAndGathersMeanwhile) {
  EXPECT_EQ(note(added("a")), 1U);
  auto first = saver_.next(kNow);
  ASSERT_TRUE(first);
  EXPECT_THAT(names(first->texts), ElementsAre("a"));
  for (int i = 0; i < 100; ++i) EXPECT_EQ(note(added("b")), 2U);
  EXPECT_EQ(note(added("c")), 2U);
  EXPECT_FALSE(saver_.next(kNow)) << "one runs";
  EXPECT_EQ(saver_.on_saved("", kNow), 1U);
  auto second = saver_.next(kNow);
  ASSERT_TRUE(second);
  EXPECT_THAT(names(second->texts), ElementsAre("a", "b", "c")) << "all that gathered, at once";
  EXPECT_EQ(saver_.on_saved("", kNow), 2U);
  EXPECT_FALSE(saver_.next(kNow));
}

TEST_F(ASceneSaver, WritesAnewOnlyWhatHasChanged) {
  note(added("a"));
  note(added("b"));
  const auto first = saver_.next(kNow);
  (void)saver_.on_saved("", kNow);
  note(added("b"));
  const auto second = saver_.next(kNow);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->texts[0].text, second->texts[0].text) << "shared";
  EXPECT_NE(first->texts[1].text, second->texts[1].text);
  EXPECT_THAT(first->texts[0].text->get(), testing::HasSubstr("\"id\":\"a\""));
}

TEST_F(ASceneSaver, ForgetsWhatIsGone) {
  note(added("a"));
  note(added("b"));
  note(gone("a"));
  EXPECT_THAT(names(saver_.next(kNow)->texts), ElementsAre("b"));
  (void)saver_.on_saved("", kNow);
  saver_.note_cleared();
  EXPECT_THAT(saver_.next(kNow)->texts, IsEmpty());
}

TEST_F(ASceneSaver, TriesAgainAWhileAfterItFailed) {
  note(added("a"));
  (void)saver_.next(kNow);
  EXPECT_EQ(saver_.on_saved("the disk is full", kNow), 1U);
  EXPECT_EQ(saver_.failure(), "the disk is full");
  EXPECT_FALSE(saver_.next(kNow + 1s));
  ASSERT_TRUE(saver_.next(kNow + SceneSaver::kRetry));
  EXPECT_EQ(saver_.on_saved("", kNow + 6s), 2U);
  EXPECT_EQ(saver_.failure(), "");
  EXPECT_FALSE(saver_.next(kNow + 60s));
}

TEST_F(ASceneSaver, SavesOnceASecondWhenThereIsAlwaysAChange) {
  int saves = 0;
  for (Time now = kNow; now < kNow + 60s; now += 100ms) {
    note(added("a"));
    if (!saver_.next(now)) continue;
    ++saves;
    (void)saver_.on_saved("", now);
  }
  EXPECT_NEAR(saves, 60 + SceneSaver::kSaveBurst, 1);
}

TEST_F(ASceneSaver, TakesAChangeAtOnceAlsoAfterAFailure) {
  note(added("a"));
  (void)saver_.next(kNow);
  (void)saver_.on_saved("the disk is full", kNow);
  note(added("b"));
  EXPECT_THAT(names(saver_.next(kNow)->texts), ElementsAre("a", "b"));
}

TEST_F(ASceneSaver, KnowsWhenSomethingCame) {
  EXPECT_FALSE(saver_.arrived_s(store::kObjectKind, "a"));
  note(added("a"));
  EXPECT_EQ(saver_.arrived_s(store::kObjectKind, "a"), 50);
  EXPECT_FALSE(saver_.arrived_s(store::kConstraintKind, "a")) << "names of kinds do not meet";
}

TEST(ASceneSaverOfWhatWasStored, KeepsOnTheDiskWhatNobodyCanReadUntilItIsGivenUp) {
  SceneSaver saver({.texts = {stored("good"), stored("bad"), stored("worse")}});
  const SceneRestored::Lost lost[] = {{std::string(store::kObjectKind), "bad"},
                                      {std::string(store::kObjectKind), "worse"}};
  saver.set_lost(lost);
  const SceneChange change = added("worse");
  (void)saver.note({&change, 1}, 2);
  EXPECT_THAT(names(saver.next(kNow)->texts), ElementsAre("good", "worse", "bad"));
  (void)saver.on_saved("", kNow);
  EXPECT_THAT(names(saver.give_up_lost().texts), ElementsAre("good", "worse"))
      << "what has the name now is another one";
  saver.on_given_up(false);
  EXPECT_THAT(names(saver.give_up_lost().texts), ElementsAre("good", "worse"));
  saver.on_given_up(true);
  (void)saver.note({&change, 1}, 3);
  EXPECT_THAT(names(saver.next(kNow)->texts), ElementsAre("good", "worse"));
}

/// A save that was made while the loss was on its way to be accepted is without them.
TEST(ASceneSaverOfWhatWasStored, WritesWhatCannotBeReadAgainWhenItsLossWasNotAccepted) {
  SceneSaver saver({.texts = {stored("good"), stored("bad")}});
  const SceneRestored::Lost lost[] = {{std::string(store::kObjectKind), "bad"}};
  saver.set_lost(lost);
  (void)saver.give_up_lost();
  const SceneChange change = added("new");
  (void)saver.note({&change, 1}, 2);
  EXPECT_THAT(names(saver.next(kNow)->texts), ElementsAre("good", "new"));
  saver.on_given_up(false);
  (void)saver.on_saved("", kNow);
  const auto again = saver.next(kNow);
  ASSERT_TRUE(again);
  EXPECT_THAT(names(again->texts), ElementsAre("good", "new", "bad"));
}

TEST(ASceneSaverOfWhatWasStored, SavesAtOnceWhatTheDiskHadNotTaken) {
  SceneSaver saver({.texts = {stored("a"), stored("b")}, .is_unsaved = true});
  const auto save = saver.next(kNow);
  ASSERT_TRUE(save);
  EXPECT_THAT(names(save->texts), ElementsAre("a", "b"));
}

TEST(ASceneSaverOfWhatWasStored, KeepsWhatCannotBeReadWhenAPersonClearsTheScene) {
  SceneSaver saver({.texts = {stored("good"), stored("bad")}});
  const SceneRestored::Lost lost[] = {{std::string(store::kObjectKind), "bad"}};
  saver.set_lost(lost);
  saver.note_cleared();
  EXPECT_THAT(names(saver.next(kNow)->texts), ElementsAre("bad"));
}

}  // namespace
}  // namespace drover::publish
