#include "store/zone_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/store/fault_files.h"

namespace drover::store {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kPath = "state/zones.texts";

struct Stored {
  ZoneStore booted() {
    ZoneStore store(files, "state");
    store.load();
    return store;
  }
  FaultFiles files;
};

std::vector<std::string> names_of(const ZoneStore& store) {
  std::vector<std::string> names;
  for (const NamedText& zone : store.zones()) names.push_back(zone.name + "=" + zone.text);
  return names;
}

TEST(AZoneStore, KnowsNoFenceBeforeItWasRead) {
  FaultFiles files;
  ZoneStore store(files, "state");
  EXPECT_THAT(store.problem(), HasSubstr("not been read"));
  EXPECT_TRUE(store.save("yard", "1", 0)) << "it would write over what it does not know";
  EXPECT_THAT(files.contents(), IsEmpty());
}
TEST(AZoneStore, HasNothingAtFirstAndThatIsKnown) {
  Stored it;
  const ZoneStore store = it.booted();
  EXPECT_THAT(store.problem(), IsEmpty());
  EXPECT_THAT(store.zones(), IsEmpty());
}
TEST(AZoneStore, KeepsReplacesAndRemovesZonesOverABoot) {
  Stored it;
  ZoneStore store = it.booted();
  ASSERT_FALSE(store.save("yard", "1", 10));
  ASSERT_FALSE(store.save("pond", "2", 20));
  ASSERT_FALSE(store.save("yard", "3", 30));
  EXPECT_THAT(names_of(it.booted()), ElementsAre("pond=2", "yard=3"));
  EXPECT_EQ(it.booted().zones()[1].arrived_s, 30);
  ASSERT_FALSE(store.remove("pond"));
  EXPECT_THAT(names_of(it.booted()), ElementsAre("yard=3"));
  EXPECT_THAT(store.remove("pond")->text, HasSubstr("no zone of this name"));
}
TEST(AZoneStore, DoesNotKnowTheFenceThatIsDamagedUntilAPersonGivesItUp) {
  for (const char* damaged : {"", "{", "rubbish"}) {
    Stored it;
    it.files.put(kPath, damaged);
    for (int boot = 0; boot < 3; ++boot) {
      ZoneStore store = it.booted();
      EXPECT_THAT(store.problem(), HasSubstr("not known")) << boot;
      EXPECT_THAT(store.zones(), IsEmpty());
      EXPECT_TRUE(store.save("yard", "1", 0)) << "others would be lost unseen";
      EXPECT_TRUE(store.remove("yard"));
    }
    EXPECT_EQ(it.files.contents()[kPath], damaged);
    ZoneStore store = it.booted();
    ASSERT_FALSE(store.forget_unreadable());
    EXPECT_THAT(store.problem(), IsEmpty());
    EXPECT_EQ(it.files.contents()[kPath + ".bad"], damaged) << "kept aside";
    ASSERT_FALSE(store.save("yard", "1", 0));
    EXPECT_THAT(it.booted().problem(), IsEmpty());
    EXPECT_THAT(names_of(it.booted()), ElementsAre("yard=1"));
  }
}
TEST(AZoneStore, DoesNotKnowTheFenceThatWasDeletedUntilAPersonGivesItUp) {
  Stored it;
  ASSERT_FALSE(it.booted().save("yard", "1", 0));
  it.files.remove(kPath);
  for (int boot = 0; boot < 2; ++boot) {
    ZoneStore store = it.booted();
    EXPECT_EQ(store.problem(),
              "the stored zones are not known: state/zones.texts was deleted; forget them and "
              "import them again");
    EXPECT_TRUE(store.save("pond", "2", 0)) << "the yard would be lost unseen";
  }
  ZoneStore store = it.booted();
  ASSERT_FALSE(store.forget_unreadable());
  EXPECT_THAT(store.problem(), IsEmpty());
  ASSERT_FALSE(store.save("yard", "1", 0));
  EXPECT_THAT(it.booted().problem(), IsEmpty());
  EXPECT_THAT(names_of(it.booted()), ElementsAre("yard=1"));
}
TEST(AZoneStore, FindsADeletedFileThatWasBroughtBack) {
  Stored it;
  ASSERT_FALSE(it.booted().save("yard", "1", 0));
  const auto backup = it.files.contents()[kPath];
  it.files.remove(kPath);
  EXPECT_THAT(it.booted().problem(), HasSubstr("deleted"));
  it.files.put(kPath, backup);
  EXPECT_THAT(it.booted().problem(), IsEmpty());
  EXPECT_THAT(names_of(it.booted()), ElementsAre("yard=1"));
}
TEST(AZoneStore, ForgetsNothingThatCanBeRead) {
  Stored it;
  ZoneStore store = it.booted();
  ASSERT_FALSE(store.save("yard", "1", 0));
  EXPECT_TRUE(store.forget_unreadable());
  EXPECT_THAT(names_of(it.booted()), ElementsAre("yard=1"));
}
TEST(AZoneStore, DoesNotKnowTheFenceWhereTheDiskCannotBeRead) {
  struct Unreadable final : FaultFiles {
    int read(const std::string&, std::size_t, std::string&) override { return EIO; }
  } files;
  ZoneStore store(files, "state");
  store.load();
  EXPECT_THAT(store.problem(), HasSubstr("mend the disk"));
}
TEST(AZoneStore, LeavesAFenceAloneThatOnlyBelongsToAnotherUser) {
  struct Foreign final : FaultFiles {
    int error = EACCES;
    int read(const std::string& path, std::size_t most, std::string& content) override {
      return error != 0 ? error : FaultFiles::read(path, most, content);
    }
  } files;
  const auto before = [&files] {
    files.error = 0;
    ZoneStore store(files, "state");
    store.load();
    EXPECT_FALSE(store.save("yard", "1", 0));
    return files.contents();
  }();
  for (const int error : {EACCES, EPERM}) {
    files.error = error;
    ZoneStore store(files, "state");
    store.load();
    EXPECT_EQ(store.problem(),
              "the stored zones are not known: state/zones.texts belongs to another user: sudo "
              "chown -R drover: state and sudo systemctl restart droverd");
    const auto refusal = store.forget_unreadable();
    ASSERT_TRUE(refusal);
    EXPECT_EQ(refusal->text, store.problem());
    EXPECT_EQ(files.contents(), before);
  }
  files.error = 0;
  ZoneStore store(files, "state");
  store.load();
  EXPECT_THAT(names_of(store), ElementsAre("yard=1"));
}
TEST(AZoneStore, RefusesAHundredAndFirstZone) {
  Stored it;
  ZoneStore store = it.booted();
  for (int i = 0; i < 100; ++i) ASSERT_FALSE(store.save(std::to_string(i), "", 0));
  EXPECT_THAT(store.save("more", "", 0)->text, HasSubstr("more than 100"));
  EXPECT_EQ(store.zones().size(), 100U);
  EXPECT_FALSE(store.save("7", "again", 0));
}
TEST(AZoneStore, ChangesNothingWhenASaveFails) {
  for (int call = 1; call <= 4; ++call) {  // create, write, sync, close: before the rename
    Stored it;
    ZoneStore store = it.booted();
    ASSERT_FALSE(store.save("yard", "1", 0));
    it.files.plan(FaultFiles::Fault::fail, call, ENOSPC);
    EXPECT_THAT(store.save("pond", "2", 0)->text, HasSubstr("No space left")) << call;
    EXPECT_THAT(names_of(store), ElementsAre("yard=1"));
    EXPECT_THAT(names_of(it.booted()), ElementsAre("yard=1"));
  }
}
TEST(AZoneStore, HasTheZonesBeforeOrAfterASaveWhereverThePowerGoes) {
  int cuts = 0;
  for (int call = 1; call < 12; ++call) {
    for (const auto fault : {FaultFiles::Fault::cut_before, FaultFiles::Fault::cut_after}) {
      for (const bool half : {false, true}) {
        Stored it;
        ZoneStore store = it.booted();
        ASSERT_FALSE(store.save("yard", "1", 0));
        it.files.plan(fault, call);
        bool acknowledged = false;
        try {
          acknowledged = !store.save("pond", "2", 0);
        } catch (const PowerCut&) {
          ++cuts;
        }
        it.files.boot_after_cut({half, half});
        const ZoneStore found = it.booted();
        EXPECT_THAT(found.problem(), IsEmpty()) << call;
        const auto names = names_of(found);
        EXPECT_TRUE(names == std::vector<std::string>({"yard=1", "pond=2"}) ||
                    (!acknowledged && names == std::vector<std::string>({"yard=1"})))
            << call;
      }
    }
  }
  EXPECT_GE(cuts, 20);
}

}  // namespace
}  // namespace drover::store
