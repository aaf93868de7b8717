// A task's report as a person reads it.
#include "cli/show_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/cli/parsed.h"
#include "unit/cli/report_answer.h"

namespace drover::cli {
namespace {

using testing::HasSubstr;

TEST(TaskReport, FitsOneScreen) {
  EXPECT_EQ(show_report(parsed(kReportAnswer)),
            "report    12  2026-03-01 14:05 UTC\n"
            "track     \"row <7> & \"co\"\" to point 57, asked 0.50 m/s\n"
            "result    failed: an obstacle blocked the way for 120 s\n"
            "way       40.2 m in 3 min 23 s, 12.50 m left\n"
            "beside    rms 1.3 cm  95 % 2.5 cm  max 4.1 cm  (from 0.4 m on)\n"
            "speed     mean 0.48 m/s  max 0.51 m/s\n"
            "gnss      rtk fixed 97.5 %  rtk float 2.5 %\n"
            "bound     5.2 cm at most while it moved, 31.0 cm in all\n"
            "pauses    2, 2 min 03 s in all\n"
            "             3.0 s  at 9.5 m  x 5.00 y 1.00 m  person <script> is in the way\n"
            "           120.0 s  at 40.2 m  x 20.00 y 1.00 m  an obstacle\n");
}

TEST(TaskReport, HasADashForWhatNobodyKnows) {
  const auto text = show_report(
      parsed(R"({"ok":true,"number":1,"report":{"track":"a","result":"not started","pauses":[],)"
             R"("cross_track":{"rms_m":null},"quality":[]}})"));
  EXPECT_THAT(text, HasSubstr("report    1  -\n"));
  EXPECT_THAT(text, HasSubstr("beside    rms -  95 % -  max -\n"));
  EXPECT_THAT(text, HasSubstr("gnss      -\n"));
  EXPECT_THAT(text, HasSubstr("pauses    none\n"));
}

TEST(TaskReport, CutsAListOfManyPausesShortAndSaysSo) {
  std::string answer = R"({"number":12,"report":{"pauses_left_out":4,"pauses":[{"lasted_s":1})";
  for (int i = 1; i < 20; ++i) answer += R"(,{"lasted_s":1})";
  const auto text = show_report(parsed(answer + "]}}"));
  EXPECT_THAT(text, HasSubstr("pauses    24, "));
  EXPECT_THAT(text, HasSubstr("          and 12 more: drover report 12 --json\n"
                              "          and 4 that were not kept\n"));
}

TEST(TaskReports, HaveALineEach) {
  EXPECT_EQ(
      show_reports(
          parsed(R"({"ok":true,"reports":[{"number":12,"report":{"track":"row 7","way_m":40.21,)"
                 R"("began_unix_s":1772373900,"cross_track":{"rms_m":0.0131},"result":"success"}},)"
                 R"({"number":11,"report":{"track":"row 6","way_m":0,"began_unix_s":1772370000,)"
                 R"("cross_track":{"rms_m":null},"result":"not started"}}]})")),
      "   12  2026-03-01 14:05 UTC  row 7                       40.2 m  rms 1.3 cm   success\n"
      "   11  2026-03-01 13:00 UTC  row 6                        0.0 m  rms -        "
      "not started\n");
}

TEST(TaskReports, BeginWithTheOneThatIsLost) {
  EXPECT_EQ(show_reports(parsed(
                R"({"ok":true,"reports":[],"problem":"the last task's report is lost: full"})")),
            "the last task's report is lost: full\n");
}

TEST(TaskReports, AreMissed) {
  EXPECT_EQ(show_reports(parsed(R"({"ok":true,"reports":[]})")),
            "no report: no task has ended yet\n");
}

}  // namespace
}  // namespace drover::cli
