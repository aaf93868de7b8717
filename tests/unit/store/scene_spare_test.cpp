// What a disk did not take of the scene outlives the program (issue: an object that a read-only
// disk did not take was forgotten by a kill).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "store/scene_store.h"
#include "tests/unit/store/fault_files.h"

namespace drover::store {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kSpare = "run/scene.unsaved";

NamedText box(const std::string& name) {
  return {std::string(kObjectKind), name, 1, "{}"};
}

/// A program that begins anew with each `start`.
struct Programs {
  SceneStore& start() {
    report.clear();
    store.emplace(files, "state", "run");
    texts = store->load(2, {}, report);
    return *store;
  }
  bool has_spare() const { return files.contents().contains(kSpare); }

  FaultFiles files;
  std::optional<SceneStore> store;
  std::vector<NamedText> texts;
  std::vector<std::string> report;
};

TEST(WhatTheDiskDidNotTake, OutlivesTheProgram) {
  Programs it;
  ASSERT_FALSE(it.start().save({box("a")}));
  EXPECT_FALSE(it.has_spare()) << "the disk has it";
  it.files.read_only("state");
  EXPECT_TRUE(it.store->save({box("a"), box("b")})) << "it is not durable, and said so";
  it.start();
  EXPECT_THAT(it.texts, ElementsAre(box("a"), box("b")));
  EXPECT_TRUE(it.store->is_unsaved());
  EXPECT_THAT(it.report, ElementsAre(HasSubstr("the disk had not taken")));
  EXPECT_TRUE(it.store->save({box("b")}));
  it.start();
  EXPECT_THAT(it.texts, ElementsAre(box("b"))) << "the newest that it was given";
}

TEST(WhatTheDiskDidNotTake, IsGoneWhenTheDiskHasIt) {
  Programs it;
  it.files.read_only("state");
  EXPECT_TRUE(it.start().save({box("a")}));
  it.files.read_only("");
  ASSERT_FALSE(it.store->save({box("b")}));
  EXPECT_FALSE(it.has_spare());
  it.start();
  EXPECT_THAT(it.texts, ElementsAre(box("b")));
  EXPECT_FALSE(it.store->is_unsaved());
}

TEST(WhatTheDiskDidNotTake, IsNeverTheDisksOwnFileWhereBothFoldersAreOne) {
  FaultFiles files;
  std::vector<std::string> report;
  SceneStore store(files, "state", "state");
  (void)store.load(0, {}, report);
  ASSERT_FALSE(store.save({box("a")}));
  SceneStore again(files, "state", "state");
  EXPECT_THAT(again.load(0, {}, report), ElementsAre(box("a")));
  EXPECT_FALSE(again.is_unsaved());
  ASSERT_FALSE(again.save({box("b")}));
  EXPECT_THAT(SceneStore(files, "state", "state").load(0, {}, report), ElementsAre(box("b")));
}

TEST(WhatTheDiskDidNotTake, IsForgottenByABoot) {
  Programs it;
  ASSERT_FALSE(it.start().save({box("a")}));
  it.files.read_only("state");
  EXPECT_TRUE(it.store->save({box("b")}));
  ASSERT_EQ(it.files.remove(kSpare), 0) << "memory";
  it.start();
  EXPECT_THAT(it.texts, ElementsAre(box("a")));
}

/// Killed at each call of a save that the disk takes again: the old or the new scene, and never the
/// copy of before once the new one was acknowledged.
TEST(WhatTheDiskDidNotTake, NeverComesBackOverSomethingNewer) {
  for (int at = 1; at < 30; ++at) {
    Programs it;
    it.files.read_only("state");
    EXPECT_TRUE(it.start().save({box("old")}));
    it.files.read_only("");
    bool acknowledged = false;
    it.files.plan(FaultFiles::Fault::cut_before, at);
    try {
      acknowledged = !it.store->save({box("new")});
    } catch (const PowerCut&) {
    }
    it.files.plan(FaultFiles::Fault::none, 0);  // a kill: everything that was written is there
    it.start();
    ASSERT_EQ(it.texts.size(), 1U) << "killed at call " << at;
    if (acknowledged) {
      EXPECT_EQ(it.texts[0].name, "new") << "killed at call " << at;
    }
    const auto second = it.texts;
    it.start();
    EXPECT_EQ(it.texts, second) << "killed at call " << at;
  }
}

/// A run folder that takes nothing any more: the copy of before must not hide what the disk took.
TEST(WhatTheDiskDidNotTake, IsThrownAwayWhenItCannotBeKeptUp) {
  Programs it;
  it.files.read_only("state");
  EXPECT_TRUE(it.start().save({box("old")}));
  it.files.read_only("");
  it.files.plan(FaultFiles::Fault::fail, 1, ENOSPC);
  ASSERT_FALSE(it.store->save({box("new")}));
  EXPECT_FALSE(it.has_spare());
  it.start();
  EXPECT_THAT(it.texts, ElementsAre(box("new")));
}

TEST(WhatTheDiskDidNotTake, IsLostAndToldWhenItCannotBeRead) {
  Programs it;
  ASSERT_FALSE(it.start().save({box("a")}));
  it.files.put(kSpare, "noise");
  it.start();
  EXPECT_THAT(it.store->problem(), HasSubstr("did not take of the scene is lost"));
  EXPECT_THAT(it.texts, ElementsAre(box("a")));
  ASSERT_FALSE(it.store->accept_loss({box("a")}));
  it.start();
  EXPECT_THAT(it.store->problem(), IsEmpty());
}

TEST(WhatTheDiskDidNotTake, IsLostWithTheProgramWithoutARunFolder) {
  FaultFiles files;
  SceneStore store(files, "state");
  std::vector<std::string> report;
  (void)store.load(0, {}, report);
  files.read_only("state");
  EXPECT_TRUE(store.save({box("a")}));
  EXPECT_THAT(files.contents(), IsEmpty());
}

}  // namespace
}  // namespace drover::store
