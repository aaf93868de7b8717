#include "runtime/robot_memory.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "store/stop_store.h"
#include "support/temp_folder.h"

namespace drover::runtime {
namespace {

constexpr auto kBoot = "0d4e0d2a-0000-4000-8000-000000000001";

Remembered stopped() {
  Remembered kept;
  kept.stop = "emergency stop of an operator";
  kept.holding = true;
  return kept;
}

class ARobotMemory : public ::testing::Test {
 protected:
  RobotMemory open(const std::string& boot = kBoot, const std::string& configuration = "{}") {
    return RobotMemory(folder.path(), boot, configuration, report);
  }
  /// Damages one byte in the middle of a record, as if it was being written.
  void tear(int record) {
    const auto path = folder.path() + "/memory";
    const auto size = std::filesystem::file_size(path) / 2;
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(record * size + size / 2));
    file.put('\x7f');
  }
  test::TempFolder folder;
  std::vector<std::string> report;
};

TEST_F(ARobotMemory, HoldsNothingAtFirst) {
  const auto memory = open();
  EXPECT_FALSE(memory.found());
  EXPECT_FALSE(memory.unreadable());
  EXPECT_EQ(report, std::vector<std::string>{});
}
TEST_F(ARobotMemory, TellsTheNextProgramWhatThisOneKept) {
  { EXPECT_TRUE(open().keep(stopped())); }
  EXPECT_EQ(open().found(), stopped());
}
TEST_F(ARobotMemory, WritesOnlyWhatChanged) {
  auto memory = open();
  EXPECT_TRUE(memory.keep({}));
  EXPECT_FALSE(memory.keep({}));
  EXPECT_TRUE(memory.keep(stopped()));
}
TEST_F(ARobotMemory, IsNotBelievedAfterABoot) {
  { open().keep(stopped()); }
  const auto memory = open("another");
  EXPECT_FALSE(memory.found());
  EXPECT_FALSE(memory.unreadable());
}
TEST_F(ARobotMemory, ForgetsWithAnotherConfigurationOnlyWhatWasProvedWithThisOne) {
  Remembered proved = stopped();
  proved.mechanics_proved = true;
  { open().keep(proved); }
  EXPECT_EQ(open().found(), proved);
  EXPECT_EQ(open(kBoot, R"({"base": {}})").found(), stopped());
}
TEST_F(ARobotMemory, HasTheRecordBeforeWhenOneIsTorn) {
  {
    auto memory = open();
    memory.keep(stopped());  // record 1
    memory.keep({});         // record 0
  }
  tear(0);
  EXPECT_EQ(open().found(), stopped());
}
TEST_F(ARobotMemory, ThatCannotBeReadCountsAsAStop) {
  { open().keep({}); }
  tear(1);
  const auto memory = open();
  EXPECT_TRUE(memory.unreadable());
  EXPECT_EQ(recall(memory, {}).stop, store::kUnreadableStop);
  EXPECT_TRUE(recall(memory, {}).stop_at_robot);
}
TEST_F(ARobotMemory, IsBelievedBeforeTheDisk) {
  { open().keep({}); }
  EXPECT_EQ(recall(open(), stopped()), Remembered{});
}
TEST_F(ARobotMemory, LeavesItToTheDiskAfterABoot) {
  { open().keep({}); }
  EXPECT_EQ(recall(open("another"), stopped()), stopped());
}
TEST_F(ARobotMemory, ThatHasNoFolderSaysSoAndWorksForItself) {
  RobotMemory memory("/nowhere", kBoot, "{}", report);
  EXPECT_EQ(report.size(), 1U);
  EXPECT_TRUE(memory.keep(stopped()));
}

}  // namespace
}  // namespace drover::runtime
