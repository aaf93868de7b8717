// What was learned goes to the disk when it is worth it, and to whoever asks.
#include "publish/learned_outlet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drover::publish {
namespace {

using testing::HasSubstr;
using testing::Not;

LearnedBeside beside() {
  LearnedBeside beside;
  beside.subject = 42;
  beside.antenna_x_m = 0.1;
  beside.heading_baseline_offset_deg = 90;
  beside.wheel_radius_m = 0.165;
  beside.yaw_slip_factor = 1.2;
  return beside;
}

class LearnedOutletTest : public ::testing::Test {
 protected:
  LearnedOutletTest() { seen_.time = now_; }
  void look(Duration later = std::chrono::seconds(1)) {
    seen_.time = now_ += later;
    outlet_.on_snapshot(seen_, {now_, std::chrono::hours(400'000)}, actions_);
  }
  /// What goes to the disk since the last call.
  std::vector<store::KeptLearned> saved() {
    std::vector<store::KeptLearned> all;
    for (const Action& action : actions_) {
      const auto* job = std::get_if<store::StorageJob>(&action);
      const auto* save = job == nullptr ? nullptr : std::get_if<store::SaveLearned>(&job->what);
      if (save == nullptr) continue;
      all.push_back(save->kept);
      last_ = job->id;
    }
    actions_.clear();
    return all;
  }
  void disk_says(bool ok, const std::string& reason = {}) {
    store::StorageReply reply;
    reply.id = last_;
    reply.ok = ok;
    reply.reason = reason;
    outlet_.on_stored(reply, actions_);
  }
  std::string answer() {
    actions_.clear();
    EXPECT_TRUE(outlet_.on_line(7, R"({"cmd":"learned"})", now_, actions_));
    const auto* reply = std::get_if<Reply>(&actions_.back());
    std::string line = reply == nullptr ? "" : reply->line;
    actions_.clear();
    return line;
  }
  LearnedValues& values() { return seen_.learned; }

  Time now_{std::chrono::seconds(100)};
  Snapshot seen_;
  LearnedOutlet outlet_{beside(), std::nullopt};
  Actions actions_;
  RequestId last_;
};

TEST_F(LearnedOutletTest, WritesNothingAsLongAsNothingIsKnown) {
  for (int i = 0; i < 100; ++i) look();
  EXPECT_TRUE(saved().empty());
  EXPECT_THAT(answer(), HasSubstr(R"("values":[],"kept_s":null)"));
}

TEST_F(LearnedOutletTest, WritesWhatIsNewOnce) {
  values().mounting_rad = {0.03, 0.002};
  look();
  const auto jobs = saved();
  ASSERT_EQ(jobs.size(), 1U);
  EXPECT_EQ(jobs[0].subject, 42U);
  EXPECT_EQ(jobs[0].values.mounting_rad.value, 0.03);
  EXPECT_GT(jobs[0].wall_s, 1e9);
  disk_says(true);
  for (int i = 0; i < 300; ++i) {
    values().mounting_rad.value += 1e-6;
    look();
  }
  EXPECT_TRUE(saved().empty());
  EXPECT_THAT(answer(), HasSubstr(R"("kept_s":1440000101)"));
}

TEST_F(LearnedOutletTest, WritesOnceAMinuteWhileItDrives) {
  seen_.nav.status = NavStatus::run;
  int writes = 0;
  for (int i = 0; i < 180; ++i) {
    values().mounting_rad = {0.03 + 0.002 * i, 0.002};
    look();
    writes += static_cast<int>(saved().size());
    disk_says(true);
  }
  EXPECT_EQ(writes, 3);
  seen_.nav.status = NavStatus::success;
  look(std::chrono::seconds(5));
  EXPECT_EQ(saved().size(), 1U);
}

TEST_F(LearnedOutletTest, KeepsWhatIsNotKnownJustNow) {
  values().late_s = {0.1, 0.01};
  values().turn_gain = {0.8, 0.01};
  look();
  (void)saved();
  disk_says(true);
  values() = {};
  values().mounting_rad = {0.03, 0.002};
  look(std::chrono::minutes(2));
  const auto jobs = saved();
  ASSERT_EQ(jobs.size(), 1U);
  EXPECT_EQ(jobs[0].values.mounting_rad.value, 0.03);
  EXPECT_EQ(jobs[0].values.late_s.value, 0.1);
  EXPECT_EQ(jobs[0].values.turn_gain.value, 0.8);
}

/// Where antennas are is known no more when it was refuted: the next start must not begin with it.
TEST_F(LearnedOutletTest, DropsAMountingAndAnArmThatWereRefuted) {
  values().mounting_rad = {0.03, 0.002};
  values().antenna_ahead_m = values().antenna_left_m = {0.2, 0.01};
  look();
  (void)saved();
  disk_says(true);
  values() = {};
  look(std::chrono::minutes(2));
  const auto jobs = saved();
  ASSERT_EQ(jobs.size(), 1U);
  EXPECT_FALSE(knows_any(jobs[0].values));
}

TEST_F(LearnedOutletTest, WritesNoScaleOfAGyroThatStepsIn) {
  values().gyro_scale = {1.01, 0.001};
  look();
  (void)saved();
  disk_says(true);
  values().imu = 1;
  values().gyro_scale = {0.98, 0.001};
  look(std::chrono::minutes(2));
  EXPECT_TRUE(saved().empty());
  EXPECT_THAT(answer(),
              HasSubstr(R"("name":"gyro scale","unit":"","configured":null,"fits":1.01)"));
}

TEST_F(LearnedOutletTest, SaysThatWhatIsForgottenComesBackWhenTheDiskDoesNotTakeIt) {
  values().mounting_rad = {0.03, 0.002};
  look();
  (void)saved();
  disk_says(true);
  values() = {};
  values().forgotten = 1;
  look();
  ASSERT_EQ(saved().size(), 1U);
  disk_says(false, "Read-only file system");
  ASSERT_EQ(actions_.size(), 1U);
  EXPECT_THAT(std::get<LogLine>(actions_[0]).text, HasSubstr("comes back with the next start"));
  EXPECT_THAT(answer(), HasSubstr(R"("problem":"Read-only file system")"));
}

TEST(ALearnedOutlet, OfABaseWithoutWheelsHasNoRadius) {
  LearnedBeside twist = beside();
  twist.wheel_radius_m = kAbsent;
  LearnedOutlet outlet(twist, std::nullopt);
  Snapshot seen;
  seen.time = Time{std::chrono::seconds(100)};
  seen.learned.wheel_scale = {0.97, 0.004};
  Actions actions;
  outlet.on_snapshot(seen, {seen.time, {}}, actions);
  actions.clear();
  ASSERT_TRUE(outlet.on_line(1, R"({"cmd":"learned"})", seen.time, actions));
  const std::string line = std::get<Reply>(actions[0]).line;
  EXPECT_THAT(line, HasSubstr(R"("name":"speed scale","unit":"","configured":null,"fits":0.97)"));
  EXPECT_THAT(line, Not(HasSubstr("wheel_radius_m")));
}

TEST_F(LearnedOutletTest, WritesNothingOfAReceiverThatStepsIn) {
  values().receiver = 1;
  values().mounting_rad = {0.03, 0.002};
  look();
  EXPECT_TRUE(saved().empty());
}

TEST_F(LearnedOutletTest, ForgetsAtOnceAtAPersonsWord) {
  values().mounting_rad = {0.03, 0.002};
  look();
  (void)saved();
  values() = {};
  values().forgotten = 1;
  look();
  const auto jobs = saved();
  ASSERT_EQ(jobs.size(), 1U);
  EXPECT_FALSE(knows_any(jobs[0].values));
  EXPECT_THAT(answer(), HasSubstr(R"("values":[])"));
}

TEST_F(LearnedOutletTest, TriesAgainAndTellsOnce) {
  values().mounting_rad = {0.03, 0.002};
  look();
  ASSERT_EQ(saved().size(), 1U);
  disk_says(false, "No space left on device");
  ASSERT_EQ(actions_.size(), 1U);
  EXPECT_THAT(std::get<LogLine>(actions_[0]).text, HasSubstr("No space left on device"));
  EXPECT_THAT(answer(), HasSubstr(R"("problem":"No space left on device")"));
  look(std::chrono::seconds(6));
  ASSERT_EQ(saved().size(), 1U);
  disk_says(false, "No space left on device");
  EXPECT_TRUE(actions_.empty());
  look(std::chrono::seconds(6));
  ASSERT_EQ(saved().size(), 1U);
  disk_says(true);
  EXPECT_THAT(answer(), HasSubstr(R"("problem":"")"));
  look(std::chrono::seconds(6));
  EXPECT_TRUE(saved().empty());
}

TEST_F(LearnedOutletTest, ShowsWhatTheConfigurationShouldSay) {
  values().mounting_rad = {-0.0349066, 0.00174533};
  values().antenna_ahead_m = {0.2, 0.01};
  values().antenna_left_m = {-0.05, 0.01};
  values().late_s = {0.2, 0.01};
  values().wheel_scale = {0.97, 0.004};
  values().turn_gain = {0.8, 0.01};
  look();
  const std::string line = answer();
  EXPECT_THAT(line, HasSubstr(R"({"name":"heading_baseline_offset_deg","unit":"deg",)"
                              R"("configured":90,"fits":92,"interval":0.2,"used":"made up for"})"));
  EXPECT_THAT(line, HasSubstr(R"({"name":"antenna_x_m","unit":"m","configured":0.1,"fits":0.3,)"
                              R"("interval":0.02,"used":"only in the error bound)"));
  EXPECT_THAT(line, HasSubstr(R"("name":"antenna_y_m","unit":"m","configured":0,"fits":-0.05)"));
  EXPECT_THAT(line,
              HasSubstr(R"("name":"positions late","unit":"s","configured":null,"fits":0.2)"));
  EXPECT_THAT(line, HasSubstr(R"("name":"wheel_radius_m","unit":"m","configured":0.165,)"
                              R"("fits":0.16)"));
  EXPECT_THAT(line,
              HasSubstr(R"("name":"yaw_slip_factor","unit":"","configured":1.2,"fits":1.25)"));
  EXPECT_THAT(line, Not(HasSubstr("gyro scale")));
}

/// A slip factor that is configured well is known before the first metre.
TEST_F(LearnedOutletTest, MakesNothingUpForWhatIsAsConfigured) {
  values().turn_gain = {1 / 1.2, 0.02};
  values().wheel_scale = {1.00005, 0.004};
  look();
  EXPECT_THAT(answer(),
              HasSubstr(R"("name":"yaw_slip_factor","unit":"","configured":1.2,"fits":1.2,)"
                        R"("interval":0.058,"used":"as configured"})"));
  EXPECT_THAT(answer(), HasSubstr(R"("fits":0.165,"interval":0.0013,"used":"as configured"})"));
  values().turn_gain = {1 / 1.21, 0.02};
  look();
  EXPECT_THAT(answer(), HasSubstr(R"("fits":1.21,"interval":0.059,"used":"made up for"})"));
}

TEST_F(LearnedOutletTest, HearsNoOtherLine) {
  EXPECT_FALSE(outlet_.on_line(7, R"({"cmd":"status"})", now_, actions_));
  EXPECT_FALSE(outlet_.on_line(7, "nonsense", now_, actions_));
}

TEST(ALearnedOutlet, BeginsWithWhatTheDiskHas) {
  store::KeptLearned stored;
  stored.subject = 42;
  stored.wall_s = 1e9;
  stored.values.mounting_rad = {0.03, 0.002};
  LearnedOutlet outlet(beside(), stored);
  Snapshot seen;
  seen.time = Time{std::chrono::seconds(100)};
  seen.learned = stored.values;
  Actions actions;
  outlet.on_snapshot(seen, {seen.time, {}}, actions);
  EXPECT_TRUE(actions.empty());
  ASSERT_TRUE(outlet.on_line(1, R"({"cmd":"learned"})", seen.time, actions));
  EXPECT_THAT(std::get<Reply>(actions[0]).line, HasSubstr(R"("kept_s":1000000000)"));
}

}  // namespace
}  // namespace drover::publish
