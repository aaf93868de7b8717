// A report is collected, stored and read back; whatever the disk does, the task does not hear of
// it.
#include "publish/report_outlet.h"

#include <gmock/gmock.h>

#include "tests/unit/publish/command_service_fixture.h"

namespace drover::publish {
namespace {

using testing::HasSubstr;

class ReportOutletTest : public CommandServiceTest {
 protected:
  /// As the publish thread tells it.
  template <class Body>
  void tell(Body body) {
    const Event event{now_, std::move(body)};
    outlet_.on_event(event, actions_);
    service_->on_event(event, actions_);
  }
  RequestId begun() {
    start();
    const RequestId id = only<Command>().id;
    actions_.clear();
    tell(CommandAccepted{id, {}});
    return id;
  }
  void drive(double seconds) {
    Snapshot seen;
    seen.nav.status = NavStatus::run;
    seen.pose.vx_mps = 0.5;
    for (int i = 0; i < static_cast<int>(10 * seconds); ++i) {
      seen.time = now_ += std::chrono::milliseconds(100);
      outlet_.on_snapshot(seen, {now_, std::chrono::hours(400'000)}, actions_);
    }
  }
  /// Of the report that is to be stored.
  std::string summary() {
    const auto jobs = all<store::StorageJob>();
    const auto* save = jobs.empty() ? nullptr : std::get_if<store::SaveReport>(&jobs.back().what);
    return save == nullptr ? "" : save->texts.summary;
  }
  std::string reply_to(const std::string& line) {
    actions_.clear();
    EXPECT_TRUE(outlet_.on_line(7, line, now_, actions_));
    const auto replies = all<Reply>();
    return replies.empty() ? "" : replies.front().line;
  }

  ReportOutlet outlet_{*service_};
};

TEST_F(ReportOutletTest, GivesTheDiskAReportWhenATaskEnds) {
  const RequestId id = begun();
  drive(10);
  tell(TaskEnded{id, TaskEnded::How::success, "0.02 m from point 2"});
  EXPECT_THAT(summary(), HasSubstr(R"("track":"13","target_id":2,"asked_mps":0.2)"));
  EXPECT_THAT(summary(), HasSubstr(R"("result":"success","reason":"0.02 m from point 2")"));
  EXPECT_THAT(summary(), HasSubstr(R"("way_m":4.95)"));
}

TEST_F(ReportOutletTest, ReportsATaskThatCouldNotBeginToMove) {
  const RequestId id = begun();
  tell(NavigationNotStarted{id, "the drives do not run"});
  EXPECT_THAT(summary(), HasSubstr(R"("result":"not started","reason":"the drives do not run")"));
}

TEST_F(ReportOutletTest, ReportsNoCommandThatIsNoTask) {
  control(R"({"cmd_type":"task_control","cmd":"cancel_task"})");
  const RequestId id = only<Command>().id;
  actions_.clear();
  tell(CommandAccepted{id, {}});
  tell(TaskEnded{id, TaskEnded::How::cancelled, {}});
  EXPECT_EQ(summary(), "");
}

TEST_F(ReportOutletTest, ReportsATaskOnce) {
  const RequestId id = begun();
  tell(TaskEnded{id, TaskEnded::How::cancelled, "cancelled"});
  EXPECT_NE(summary(), "");
  actions_.clear();
  tell(TaskEnded{id, TaskEnded::How::cancelled, "cancelled"});
  EXPECT_EQ(summary(), "");
}

TEST_F(ReportOutletTest, TellsOfAReportThatTheDiskDoesNotTakeAndOfNothingElse) {
  const RequestId id = begun();
  tell(TaskEnded{id, TaskEnded::How::success, {}});
  const auto job = all<store::StorageJob>().back();
  actions_.clear();
  outlet_.on_stored({job.id, false, "No space left on device"}, actions_);
  ASSERT_EQ(actions_.size(), 1U);
  EXPECT_EQ(only<LogLine>().text, "the last task's report is lost: No space left on device");
}

TEST_F(ReportOutletTest, DoesNotPassAnOlderOneOffForTheOneThatIsLost) {
  const auto end_a_task = [this](bool stored) {
    const RequestId id = begun();
    tell(TaskEnded{id, TaskEnded::How::success, {}});
    const auto job = all<store::StorageJob>().back();
    outlet_.on_stored({job.id, stored, stored ? "" : "No space left on device"}, actions_);
  };
  const auto ask = [this](const std::string& line) {
    EXPECT_EQ(reply_to(line), "");
    const auto job = only<store::StorageJob>();
    actions_.clear();
    store::StorageReply reply{job.id, true};
    reply.reports = {{3, {"{}", "{}"}}};
    outlet_.on_stored(reply, actions_);
    return only<Reply>().line;
  };
  end_a_task(false);
  EXPECT_EQ(ask(R"({"cmd":"report"})"),
            R"({"ok":false,"reason":"the last task's report is lost: No space left on device; )"
            R"(those before it: drover report --list"})");
  EXPECT_THAT(ask(R"({"cmd":"report","number":3})"), HasSubstr(R"("ok":true,"number":3)"));
  EXPECT_THAT(ask(R"({"cmd":"report_list"})"), HasSubstr(R"("problem":"the last task's report)"));
  end_a_task(true);
  EXPECT_THAT(ask(R"({"cmd":"report"})"), HasSubstr(R"("ok":true,"number":3)"));
}

TEST_F(ReportOutletTest, AnswersFromTheDisk) {
  EXPECT_EQ(reply_to(R"({"cmd":"report","number":3})"), "") << "the disk has not answered";
  const auto job = only<store::StorageJob>();
  EXPECT_EQ(std::get<store::ReadReport>(job.what).number, 3U);
  actions_.clear();
  store::StorageReply reply{job.id, true};
  reply.reports = {{3, {R"({"way_m":5})", R"({"driven":[]})"}}};
  outlet_.on_stored(reply, actions_);
  EXPECT_EQ(only<Reply>().client, 7U);
  EXPECT_EQ(only<Reply>().line,
            R"({"ok":true,"number":3,"report":{"way_m":5},"line":{"driven":[]}})");
}

TEST_F(ReportOutletTest, ListsWhatThereIs) {
  EXPECT_EQ(reply_to(R"({"cmd":"report_list"})"), "");
  const auto job = only<store::StorageJob>();
  actions_.clear();
  store::StorageReply reply{job.id, true};
  reply.reports = {{4, {"{}", ""}}, {3, {"{}", ""}}};
  outlet_.on_stored(reply, actions_);
  EXPECT_EQ(
      only<Reply>().line,
      R"({"ok":true,"reports":[{"number":4,"report":{}},{"number":3,"report":{}}],"problem":""})");
}

TEST_F(ReportOutletTest, PassesARefusalOn) {
  EXPECT_EQ(reply_to(R"({"cmd":"report"})"), "");
  const auto job = only<store::StorageJob>();
  EXPECT_EQ(std::get<store::ReadReport>(job.what).number, 0U) << "the newest";
  actions_.clear();
  outlet_.on_stored({job.id, false, "there is no report yet"}, actions_);
  EXPECT_EQ(only<Reply>().line, R"({"ok":false,"reason":"there is no report yet"})");
}

TEST_F(ReportOutletTest, RefusesWhatIsNoNumberAndTooMuchAtOnce) {
  EXPECT_THAT(reply_to(R"({"cmd":"report","number":"last"})"), HasSubstr("no whole number"));
  EXPECT_THAT(reply_to(R"({"cmd":"report","number":1.5})"), HasSubstr("no whole number"));
  EXPECT_THAT(reply_to(R"({"cmd":"report","number":-1})"), HasSubstr("below zero"));
  std::string last;
  for (int i = 0; i < 20; ++i) last = reply_to(R"({"cmd":"report"})");
  EXPECT_THAT(last, HasSubstr("try again"));
}

TEST_F(ReportOutletTest, AsksTheDiskForOneListAtATime) {
  EXPECT_EQ(reply_to(R"({"cmd":"report_list"})"), "");
  const auto job = only<store::StorageJob>();
  EXPECT_THAT(reply_to(R"({"cmd":"report_list"})"), HasSubstr("the disk is behind, try again"));
  EXPECT_TRUE(all<store::StorageJob>().empty());
  EXPECT_EQ(reply_to(R"({"cmd":"report"})"), "") << "one report is little";
  outlet_.on_stored({job.id, true}, actions_);
  EXPECT_EQ(reply_to(R"({"cmd":"report_list"})"), "");
}

TEST_F(ReportOutletTest, LeavesOtherLinesToOthers) {
  EXPECT_FALSE(outlet_.on_line(7, R"({"cmd":"status"})", now_, actions_));
  EXPECT_FALSE(outlet_.on_line(7, "{", now_, actions_));
  EXPECT_TRUE(actions_.empty());
}

}  // namespace
}  // namespace drover::publish
