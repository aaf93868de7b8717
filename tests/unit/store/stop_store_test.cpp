#include "store/stop_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/store/fault_files.h"

namespace drover::store {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Remembered stopped() {
  Remembered kept;
  kept.stop = "wheel rear_left runs away: 22.1 rad/s";
  kept.stop_at_robot = true;
  kept.power_cut = true;
  kept.joints_wait = "bumper touched";
  kept.ran_away = true;
  return kept;
}

/// Somebody fills every block that is let go of, but those of one file wait for it.
struct FullDisk final : FaultFiles {
  int write(int descriptor, std::string_view content) override {
    const bool room = !full || removed == "state/stop.room";
    return room ? FaultFiles::write(descriptor, content) : ENOSPC;
  }
  int remove(const std::string& path) override {
    const int error = FaultFiles::remove(path);
    if (error == 0 && !path.ends_with(kTemporaryEnding)) removed = path;
    return error;
  }
  bool full = false;
  std::string removed;
};

struct Stored {
  Remembered load() {
    report.clear();
    return StopStore(files, "state").load(report);
  }
  bool save(const Remembered& what) { return !StopStore(files, "state").save(what); }
  FaultFiles files;
  std::vector<std::string> report;
};

TEST(AStopStore, HasNothingAtFirst) {
  Stored it;
  EXPECT_EQ(it.load(), Remembered{});
  EXPECT_TRUE(it.report.empty());
}
TEST(AStopStore, KeepsAStopAndItsEnd) {
  Stored it;
  ASSERT_TRUE(it.save(stopped()));
  EXPECT_EQ(it.load(), stopped());
  ASSERT_TRUE(it.save({}));
  EXPECT_EQ(it.load(), Remembered{});
}
TEST(AStopStore, KeepsOnlyWhatOutlivesABoot) {
  Remembered all = stopped();
  all.holding = all.released = all.task = true;
  EXPECT_EQ(lasting(all), stopped());
}
TEST(AStopStore, KeepsWhatJointCommandsWaitForWithoutAStop) {
  Stored it;
  Remembered waiting;
  waiting.joints_wait = "e-stop pressed";
  ASSERT_TRUE(it.save(waiting));
  EXPECT_EQ(it.load(), waiting);
}
TEST(AStopStore, ReadsAFileOfTheFirstVersionInWhichJointCommandsWaitForNothing) {
  Stored it;
  const std::string body = R"({"stop": "off", "at_robot": false, "power_cut": true})";
  it.files.put("state/stop.json", seal("drover-stop", 1, body));
  Remembered left;
  left.stop = "off";
  left.power_cut = true;
  EXPECT_EQ(it.load(), left);
  EXPECT_TRUE(it.report.empty());
}
TEST(AStopStore, ReadsAFileOfTheSecondVersionInWhichNoWheelRanAway) {
  Stored it;
  const std::string body =
      R"({"stop": "off", "at_robot": true, "power_cut": false, "joints_wait": "bumper touched"})";
  it.files.put("state/stop.json", seal("drover-stop", 2, body));
  Remembered left;
  left.stop = "off";
  left.stop_at_robot = true;
  left.joints_wait = "bumper touched";
  EXPECT_EQ(it.load(), left);
  EXPECT_TRUE(it.report.empty());
}
TEST(AStopStore, CountsAFileThatLacksWhatItsVersionTellsAsAStop) {
  const std::string first = R"({"stop": "", "at_robot": false, "power_cut": false)";
  for (const auto& [version, body] :
       {std::pair{2, first + "}"}, std::pair{3, first + R"(, "joints_wait": ""})"}}) {
    Stored it;
    it.files.put("state/stop.json", seal("drover-stop", version, body));
    EXPECT_EQ(it.load(), unreadable_stop()) << version;
    EXPECT_THAT(it.report, ElementsAre(HasSubstr("does not tell all")));
  }
}
TEST(AStopStore, CountsADamagedFileAsAStopUntilTheNextSave) {
  Stored it;
  ASSERT_TRUE(it.save({}));
  for (const char* damaged : {"", "{", "rubbish"}) {
    it.files.put("state/stop.json", damaged);
    EXPECT_EQ(it.load().stop, kUnreadableStop);
    EXPECT_TRUE(it.load().stop_at_robot) << "it may have been one";
    EXPECT_EQ(it.load().stop, kUnreadableStop) << "still, when it is read once more";
    EXPECT_THAT(it.report, ElementsAre(HasSubstr("state/stop.json")));
  }
  ASSERT_TRUE(it.save({}));
  EXPECT_EQ(it.load(), Remembered{});
}
TEST(AStopStore, CountsADeletedFileAsAStopUntilTheNextSave) {
  Stored it;
  ASSERT_TRUE(it.save({}));
  it.files.remove("state/stop.json");
  for (int boot = 0; boot < 2; ++boot) {
    EXPECT_EQ(it.load(), unreadable_stop());
    EXPECT_THAT(it.report, ElementsAre("state/stop.json was deleted"));
  }
  ASSERT_TRUE(it.save({}));
  EXPECT_EQ(it.load(), Remembered{});
}
TEST(AStopStore, HasRoomForAStopOnADiskThatOthersFilled) {
  FullDisk disk;
  StopStore store(disk, "state");
  store.keep_room();
  disk.full = true;
  EXPECT_FALSE(store.save(stopped()).has_value());
  std::vector<std::string> report;
  EXPECT_EQ(store.load(report), stopped());
  EXPECT_THAT(report, testing::IsEmpty());
}
TEST(AStopStore, TellsThatAStopIsNotKeptWhereThereIsNoRoom) {
  FullDisk disk;
  disk.full = true;
  StopStore store(disk, "state");
  store.keep_room();
  const auto failure = store.save(stopped());
  ASSERT_TRUE(failure.has_value());
  EXPECT_THAT(failure->text, HasSubstr("No space left"));
}
TEST(AStopStore, TakesItsRoomAgainWhenThereIsSome) {
  FullDisk disk;
  StopStore store(disk, "state");
  store.keep_room();
  disk.full = true;
  ASSERT_FALSE(store.save(stopped()).has_value());
  disk.full = false;
  ASSERT_FALSE(store.save({}).has_value());
  disk.full = true;
  disk.removed.clear();
  EXPECT_FALSE(store.save(stopped()).has_value()) << "it has none left";
}
TEST(AStopStore, KeepsWhatItAcknowledgedWhereverThePowerGoes) {
  for (int call = 1; call < 12; ++call) {
    for (const bool half : {false, true}) {
      Stored it;
      ASSERT_TRUE(it.save({}));
      it.files.plan(FaultFiles::Fault::cut_after, call);
      bool acknowledged = false;
      try {
        acknowledged = it.save(stopped());
      } catch (const PowerCut&) {
      }
      it.files.boot_after_cut({half, half});
      const Remembered found = it.load();
      EXPECT_TRUE(found == stopped() || (!acknowledged && found == Remembered{})) << call;
    }
  }
}

}  // namespace
}  // namespace drover::store
