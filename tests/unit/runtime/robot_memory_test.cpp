#include "runtime/robot_memory.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "store/durable_file.h"
#include "store/stop_store.h"
#include "support/temp_folder.h"

namespace drover::runtime {
namespace {

constexpr auto kBoot = "0d4e0d2a-0000-4000-8000-000000000001";

Remembered stopped() {
  Remembered kept;
  kept.stop = "emergency stop of an operator";
  kept.holding = true;
  kept.joints_wait = "bumper touched";
  kept.ran_away = true;
  return kept;
}
/// A record of the layout before this one, which did not tell where the base stood, or of the one
/// before that, which did not tell whether a wheel ran away either.
struct RecordBefore {
  std::uint64_t format = 0;
  std::uint64_t sequence = 1;
  std::array<char, 40> boot{};
  std::uint64_t configuration = store::fingerprint("{}");
  struct {
    Reason stop;
    std::array<bool, 6> flags{};  ///< the third: holding
    Reason joints_wait;
    bool at_rest = false;
    unsigned char ran_away = 0;
    std::array<unsigned char, 6> nothing{};
  } kept;
  std::uint64_t checksum = 0;
};

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
  /// What the version before this one left: its stop of an operator, the robot held. `ran_away`:
  /// the byte that says so; of the version before that one it is any.
  void leave_the_layout_before(bool whole, unsigned char ran_away, char layout = '5') const {
    std::array<RecordBefore, 2> records;
    std::memset(static_cast<void*>(records.data()), 0, sizeof records);
    RecordBefore record;
    record.format = 0x64726d656d303000 + static_cast<unsigned char>(layout);
    std::memset(static_cast<void*>(&record.kept), 0, sizeof record.kept);
    std::memcpy(record.boot.data(), kBoot, std::strlen(kBoot));
    record.kept.stop = "emergency stop of an operator";
    record.kept.flags[2] = true;
    record.kept.at_rest = true;
    record.kept.ran_away = ran_away;
    record.kept.nothing.fill(0xff);
    record.checksum = store::fingerprint(
        {reinterpret_cast<const char*>(&record), offsetof(RecordBefore, checksum)});
    if (!whole) ++record.checksum;
    std::memcpy(static_cast<void*>(&records[1]), &record, sizeof record);
    std::ofstream(folder.path() + "/memory", std::ios::binary)
        .write(reinterpret_cast<const char*>(records.data()), sizeof records);
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
TEST_F(ARobotMemory, OfWhichTheNewestIsDamagedCountsAsAStopWithAllThatIsKnownBesides) {
  Remembered older;
  older.released = true;
  Remembered on_disk;
  on_disk.stop = "the robot did not stop";
  on_disk.power_cut = on_disk.ran_away = true;
  {
    auto memory = open();
    memory.keep(older);  // record 1
    memory.keep({});     // record 0
  }
  tear(0);
  const Remembered known = recall(open(), on_disk);
  EXPECT_EQ(known.stop, on_disk.stop);
  EXPECT_TRUE(known.stop_at_robot);
  EXPECT_TRUE(known.power_cut);
  EXPECT_TRUE(known.released);
  EXPECT_TRUE(known.ran_away);
  EXPECT_EQ(recall(open(), {}).stop, store::kUnreadableStop);
}
TEST_F(ARobotMemory, IsWholeAgainAfterItsNextRecord) {
  {
    auto memory = open();
    memory.keep(stopped());
    memory.keep({});
  }
  tear(0);
  { open().keep({}); }
  EXPECT_EQ(recall(open(), stopped()), Remembered{});
}
TEST_F(ARobotMemory, IsBelievedBeforeTheDisk) {
  { open().keep({}); }
  EXPECT_EQ(recall(open(), stopped()), Remembered{});
}
TEST_F(ARobotMemory, LeavesItToTheDiskAfterABoot) {
  { open().keep({}); }
  EXPECT_EQ(recall(open("another"), stopped()), stopped());
}
TEST_F(ARobotMemory, ForgetsWithAnotherConfigurationWhereItStood) {
  Remembered stood = stopped();
  stood.place.known = true;
  { open().keep(stood); }
  EXPECT_EQ(open().found(), stood);
  EXPECT_EQ(open(kBoot, R"({"base": {}})").found(), stopped());
}
TEST_F(ARobotMemory, KeepsWithAnotherConfigurationThatThePlaceWasDoubted) {
  Remembered doubted = stopped();
  doubted.place.known = doubted.place.doubted = true;
  { open().keep(doubted); }
  doubted.place.known = false;
  EXPECT_EQ(open(kBoot, R"({"base": {}})").found(), doubted);
}
TEST_F(ARobotMemory, OfTwoVersionsBeforeTellsAllButThatAWheelRanAway) {
  leave_the_layout_before(true, 0xff, '4');
  Remembered left = stopped();
  left.joints_wait.clear();
  left.ran_away = false;
  left.at_rest = true;
  EXPECT_EQ(open().found(), left);
}
TEST_F(ARobotMemory, OfTheVersionBeforeTellsAllButWhereItStood) {
  leave_the_layout_before(true, 1);
  Remembered left = stopped();
  left.joints_wait.clear();
  left.at_rest = true;
  EXPECT_EQ(open().found(), left);
  EXPECT_EQ(open().found(), left) << "still, when that program died before its first cycle";
  EXPECT_FALSE(open("another").found()) << "after a boot";
  { EXPECT_TRUE(open().keep(stopped())); }
  EXPECT_EQ(open().found(), stopped());
  EXPECT_EQ(report, std::vector<std::string>{});
}
TEST_F(ARobotMemory, OfTheVersionBeforeThatCannotBeReadCountsAsAStop) {
  leave_the_layout_before(false, 0);
  for (int start = 1; start <= 2; ++start) {
    const auto memory = open();
    EXPECT_TRUE(memory.unreadable()) << "start " << start;
    EXPECT_EQ(recall(memory, {}).stop, store::kUnreadableStop);
  }
}
TEST_F(ARobotMemory, ThatHasNoFolderSaysSoAndWorksForItself) {
  RobotMemory memory("/nowhere", kBoot, "{}", report);
  EXPECT_EQ(report.size(), 1U);
  EXPECT_TRUE(memory.keep(stopped()));
}

}  // namespace
}  // namespace drover::runtime
