#include "store/learned_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/store/fault_files.h"

namespace drover::store {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

KeptLearned of_a_drive() {
  KeptLearned kept;
  kept.subject = 0xFEDCBA9876543210U;
  kept.wall_s = 1795780800.25;
  kept.values.receiver = 1;
  kept.values.imu = 2;
  kept.values.mounting_rad = {-0.0314159265358979, 0.0021};
  kept.values.late_s = {0.084, 0.012};
  return kept;
}

struct LearnedOnDisk {
  std::optional<KeptLearned> load() {
    report.clear();
    return LearnedStore(files, "state").load(report);
  }
  bool save(const KeptLearned& what) { return !LearnedStore(files, "state").save(what); }
  void put(const std::string& content) {
    ASSERT_FALSE(write_durably(files, "state", "learned.json", content));
  }
  FaultFiles files;
  std::vector<std::string> report;
};

TEST(ALearnedStore, HasNothingAtFirst) {
  LearnedOnDisk it;
  EXPECT_FALSE(it.load());
  EXPECT_TRUE(it.report.empty());
}

TEST(ALearnedStore, KeepsValuesToTheBit) {
  LearnedOnDisk it;
  ASSERT_TRUE(it.save(of_a_drive()));
  const auto found = it.load();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->subject, of_a_drive().subject);
  EXPECT_EQ(found->wall_s, of_a_drive().wall_s);
  EXPECT_EQ(found->values.receiver, 1);
  EXPECT_EQ(found->values.imu, 2);
  EXPECT_EQ(found->values.mounting_rad.value, of_a_drive().values.mounting_rad.value);
  EXPECT_EQ(found->values.mounting_rad.sigma, 0.0021);
  EXPECT_EQ(found->values.late_s.value, 0.084);
  EXPECT_FALSE(found->values.wheel_scale.known());
  EXPECT_TRUE(it.report.empty());
}

TEST(ALearnedStore, PutsADamagedFileAsideAndSaysSo) {
  LearnedOnDisk it;
  ASSERT_TRUE(it.save(of_a_drive()));
  std::string content;
  ASSERT_EQ(it.files.read("state/learned.json", 65536, content), 0);
  content[content.find("mounting_rad") + 30] ^= 1;
  it.put(content);
  EXPECT_FALSE(it.load());
  EXPECT_THAT(it.report, ElementsAre(HasSubstr("learned.json.bad")));
  EXPECT_THAT(it.report.front(), HasSubstr("the robot learns anew"));
  EXPECT_FALSE(it.load());
  EXPECT_TRUE(it.report.empty());
}

TEST(ALearnedStore, ReadsNothingThatIsNoneOfItsValues) {
  for (const char* body :
       {"{}", "[]", "7", R"({"subject":"12","wall_s":1,"receiver":0,"imu":0,"values":{}})",
        R"({"subject":"000000000000000g","wall_s":1,"receiver":0,"imu":0,"values":{}})",
        R"({"subject":"0000000000000001","wall_s":1,"receiver":-1,"imu":0,"values":{}})",
        R"({"subject":"0000000000000001","wall_s":1,"receiver":0,"imu":4,"values":{}})",
        R"({"subject":"0000000000000001","wall_s":"1","receiver":0,"imu":0,"values":{}})",
        R"({"subject":"0000000000000001","wall_s":1,"receiver":0,"imu":0})"}) {
    LearnedOnDisk it;
    it.put(seal("drover-learned", 1, body));
    EXPECT_FALSE(it.load()) << body;
    EXPECT_THAT(it.report, ElementsAre(HasSubstr("does not tell what was learned"))) << body;
  }
}

TEST(ALearnedStore, TellsOfADiskThatDoesNotTakeThem) {
  LearnedOnDisk it;
  it.files.plan(FaultFiles::Fault::fail, 1, ENOSPC);
  EXPECT_FALSE(it.save(of_a_drive()));
}

}  // namespace
}  // namespace drover::store
