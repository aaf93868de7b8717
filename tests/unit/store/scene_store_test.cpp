#include "store/scene_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/store/fault_files.h"

namespace drover::store {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kPath = "state/scene.texts";

NamedText object(const std::string& name, double arrived_s) {
  return {std::string(kObjectKind), name, arrived_s, "{\"id\":\"" + name + "\"}"};
}
NamedText constraint(const std::string& name, double arrived_s) {
  return {std::string(kConstraintKind), name, arrived_s, "{}"};
}

struct Stored {
  std::vector<NamedText> boot(double wall_s = 0, std::optional<double> max_age_s = {}) {
    report.clear();
    SceneStore store(files, "state");
    auto texts = store.load(wall_s, max_age_s, report);
    problem = store.problem();
    return texts;
  }
  FaultFiles files;
  std::vector<std::string> report;
  std::string problem;
};

TEST(ASceneStore, KeepsObjectsAndConstraintsInTheirOrder) {
  Stored it;
  EXPECT_THAT(it.boot(), IsEmpty());
  SceneStore store(it.files, "state");
  const std::vector<NamedText> all = {object("b", 1), constraint("b", 2), object("a", 3)};
  ASSERT_FALSE(store.save(all));
  EXPECT_EQ(it.boot(), all);
  EXPECT_THAT(it.problem, IsEmpty());
  EXPECT_THAT(it.report, IsEmpty());
}
TEST(ASceneStore, LeavesOutObjectsThatAreTooOldWhenItIsRead) {
  Stored it;
  SceneStore store(it.files, "state");
  ASSERT_FALSE(store.save({object("old", 99), object("just", 100), constraint("c", 0)}));
  EXPECT_THAT(it.boot(200, 100), ElementsAre(object("just", 100), constraint("c", 0)));
  EXPECT_THAT(it.report, ElementsAre(HasSubstr("too old: 1")));
  EXPECT_EQ(it.boot(1e9).size(), 3U) << "without a limit nothing grows old";
}
TEST(ASceneStore, KeepsAnObjectOfTheFutureSinceTheClockIsWrong) {
  Stored it;
  SceneStore store(it.files, "state");
  ASSERT_FALSE(store.save({object("box", 1.7e9)}));
  EXPECT_THAT(it.boot(0, 100), ElementsAre(object("box", 1.7e9)));
}
TEST(ASceneStore, WantsObjectsAndConstraintsOnly) {
  Stored it;
  SceneStore store(it.files, "state");
  EXPECT_TRUE(store.save({{"zone", "yard", 0, ""}}));
  EXPECT_THAT(it.files.contents(), IsEmpty());
}
TEST(ASceneStore, PutsADamagedFileAsideAndTellsItUntilAPersonKnows) {
  Stored it;
  it.files.put(kPath, "{");
  EXPECT_THAT(it.boot(), IsEmpty());
  EXPECT_THAT(it.report, ElementsAre(HasSubstr("kept as scene.texts.bad")));
  EXPECT_THAT(it.problem, HasSubstr("lost"));
  it.boot();
  EXPECT_EQ(it.problem, "the stored scene is lost: state/scene.texts was damaged or deleted")
      << "nobody has saved since";
  EXPECT_THAT(it.report, ElementsAre(it.problem));

  std::vector<std::string> report;
  SceneStore store(it.files, "state");
  store.load(0, {}, report);
  ASSERT_FALSE(store.save({object("box", 1)}));
  EXPECT_THAT(it.boot(), ElementsAre(object("box", 1)));
  EXPECT_THAT(it.problem, HasSubstr("lost")) << "a program that goes on sending has not seen it";

  ASSERT_FALSE(store.accept_loss({object("box", 1)}));
  EXPECT_THAT(store.problem(), IsEmpty());
  EXPECT_THAT(it.boot(), ElementsAre(object("box", 1)));
  EXPECT_THAT(it.problem, IsEmpty());
}
TEST(ASceneStore, TellsOfADeletedFileUntilAPersonKnows) {
  Stored it;
  ASSERT_FALSE(SceneStore(it.files, "state").save({object("box", 1)}));
  it.files.remove(kPath);
  for (int boot = 0; boot < 2; ++boot) {
    EXPECT_THAT(it.boot(), IsEmpty());
    EXPECT_EQ(it.problem, "the stored scene is lost: state/scene.texts was deleted") << boot;
    EXPECT_THAT(it.report, ElementsAre(it.problem)) << boot;
  }
  std::vector<std::string> report;
  SceneStore store(it.files, "state");
  store.load(0, {}, report);
  ASSERT_FALSE(store.save({object("pole", 2)}));
  EXPECT_THAT(it.boot(), ElementsAre(object("pole", 2)));
  EXPECT_THAT(it.problem, HasSubstr("deleted")) << "a program that goes on sending has not seen it";
  ASSERT_FALSE(store.accept_loss({object("pole", 2)}));
  it.boot();
  EXPECT_THAT(it.problem, IsEmpty());
}
TEST(ASceneStore, KnowsADeletedFileThatAnOlderProgramHadWritten) {
  Stored it;
  it.files.put(kPath, *encode_named_texts(kSceneFile, {object("box", 1)}));
  EXPECT_THAT(it.boot(), ElementsAre(object("box", 1)));
  EXPECT_THAT(it.problem, IsEmpty());
  it.files.remove(kPath);
  it.boot();
  EXPECT_THAT(it.problem, HasSubstr("deleted"));
}
TEST(ASceneStore, TellsOfNoDeletionWhereverThePowerGoesInItsFirstSave) {
  for (int call = 1; call < 14; ++call) {
    for (const bool names : {false, true}) {
      Stored it;
      it.files.plan(FaultFiles::Fault::cut_after, call);
      try {
        SceneStore(it.files, "state").save({object("a", 1)});
      } catch (const PowerCut&) {
      }
      it.files.boot_after_cut({names, names});
      it.boot();
      EXPECT_THAT(it.problem, IsEmpty()) << call;
    }
  }
}
TEST(ASceneStore, HasItsProblemStillWhenALossCannotBeAccepted) {
  Stored it;
  it.files.put(kPath, "{");
  std::vector<std::string> report;
  SceneStore store(it.files, "state");
  store.load(0, {}, report);
  it.files.plan(FaultFiles::Fault::fail, 1);
  EXPECT_TRUE(store.accept_loss({}));
  EXPECT_THAT(store.problem(), HasSubstr("lost"));
}
TEST(ASceneStore, LeavesASceneAloneThatOnlyBelongsToAnotherUser) {
  struct Foreign final : FaultFiles {
    bool is_foreign = false;
    int read(const std::string& path, std::size_t most, std::string& content) override {
      return is_foreign ? EACCES : FaultFiles::read(path, most, content);
    }
  } files;
  std::vector<std::string> report;
  SceneStore(files, "state").save({{std::string(kObjectKind), "box", 0, "1"}});
  const auto before = files.contents();
  files.is_foreign = true;
  SceneStore store(files, "state");
  EXPECT_TRUE(store.load(0, std::nullopt, report).empty());
  EXPECT_THAT(store.problem(), testing::HasSubstr("scene.texts belongs to another user: sudo chown "
                                                  "-R drover: state"));
  EXPECT_TRUE(store.save({}));
  EXPECT_TRUE(store.accept_loss({}));
  EXPECT_EQ(files.contents(), before) << "neither put aside nor written over";
}

TEST(ASceneStore, RefusesMoreThanItsFileHolds) {
  Stored it;
  SceneStore store(it.files, "state");
  NamedText huge = object("huge", 0);
  huge.text.assign(std::size_t{16} << 20, 'x');
  EXPECT_THAT(store.save({huge})->text, HasSubstr("more than"));
  std::vector<NamedText> many;
  for (int i = 0; i < 2001; ++i) many.push_back(object(std::to_string(i), 0));
  EXPECT_THAT(store.save(many)->text, HasSubstr("more than 2000"));
  many.pop_back();
  EXPECT_FALSE(store.save(many));
}
TEST(ASceneStore, HasTheSceneBeforeOrAfterASaveWhereverThePowerGoes) {
  for (int call = 1; call < 12; ++call) {
    for (const bool half : {false, true}) {
      Stored it;
      SceneStore store(it.files, "state");
      ASSERT_FALSE(store.save({object("a", 1)}));
      it.files.plan(FaultFiles::Fault::cut_after, call);
      bool acknowledged = false;
      try {
        acknowledged = !store.save({object("b", 2)});
      } catch (const PowerCut&) {
      }
      it.files.boot_after_cut({half, half});
      const auto found = it.boot();
      ASSERT_EQ(found.size(), 1U) << call;
      EXPECT_TRUE(found[0].name == "b" || (!acknowledged && found[0].name == "a")) << call;
      EXPECT_THAT(it.problem, IsEmpty()) << call;
    }
  }
}

}  // namespace
}  // namespace drover::store
