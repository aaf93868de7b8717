// Reports of tasks on disk: numbered, few, and no harm when the disk takes none.
#include "store/report_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "store/storage.h"
#include "tests/unit/store/fault_files.h"

namespace drover::store {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kFolder = "/state/reports";

ReportTexts report(int n) {
  return {R"({"way_m":)" + std::to_string(n) + "}", R"({"driven":[[)" + std::to_string(n) + "]]}"};
}

std::vector<std::uint64_t> numbers_of(const ReportStore& store) {
  std::vector<std::uint64_t> numbers;
  for (const auto& one : store.list()) numbers.push_back(one.number);
  return numbers;
}

TEST(Reports, AreNumberedFromOneAndReadBackAsTheyWere) {
  FaultFiles files;
  ReportStore store(files, kFolder);
  ASSERT_FALSE(store.save(report(7)));
  ASSERT_FALSE(store.save(report(8)));
  const auto first = store.read(1);
  ASSERT_TRUE(first.ok()) << first.error().text;
  EXPECT_EQ(first->texts.summary, report(7).summary);
  EXPECT_EQ(first->texts.line, report(7).line);
  const auto newest = store.read(0);
  ASSERT_TRUE(newest.ok());
  EXPECT_EQ(newest->number, 2U);
  EXPECT_EQ(newest->texts.line, report(8).line);
}

TEST(Reports, AreListedTheNewestFirstWithoutTheirLines) {
  FaultFiles files;
  ReportStore store(files, kFolder);
  for (int n = 1; n <= 3; ++n) ASSERT_FALSE(store.save(report(n)));
  const auto list = store.list();
  EXPECT_THAT(numbers_of(store), ElementsAre(3, 2, 1));
  EXPECT_EQ(list.front().texts.summary, report(3).summary);
  EXPECT_EQ(list.front().texts.line, "");
}

TEST(Reports, AreListedByTheirFrontsHoweverLongTheirLinesAre) {
  FaultFiles files;
  ReportStore store(files, kFolder);
  const std::size_t line_bytes = 600'000;
  for (int n = 1; n <= 5; ++n)
    ASSERT_FALSE(store.save({report(n).summary, '"' + std::string(line_bytes, 'x') + '"'}));
  files.read_bytes();
  EXPECT_EQ(store.list().size(), 5U);
  EXPECT_LT(files.read_bytes(), 5 * line_bytes / 8);
}

TEST(Reports, AreListedAlsoWhereASummaryIsLong) {
  FaultFiles files;
  ReportStore store(files, kFolder);
  const std::string summary = R"({"reason":")" + std::string(100'000, 'x') + R"("})";
  ASSERT_FALSE(store.save({summary, "[]"}));
  ASSERT_EQ(store.list().size(), 1U);
  EXPECT_EQ(store.list().front().texts.summary, summary);
}

TEST(Reports, AreNotListedWhenWhatIsInFrontIsNoJson) {
  FaultFiles files;
  ReportStore store(files, kFolder);
  for (int n = 1; n <= 2; ++n) ASSERT_FALSE(store.save(report(n)));
  const std::string path = std::string(kFolder) + "/000001.report";
  auto content = files.contents()[path];
  content[content.find("way_m") - 1] = ' ';
  files.put(path, content);
  EXPECT_THAT(numbers_of(store), ElementsAre(2));
}

TEST(Reports, SurviveARestartAndAPowerCut) {
  FaultFiles files;
  ASSERT_FALSE(ReportStore(files, kFolder).save(report(1)));
  files.boot_after_cut({});
  ReportStore again(files, kFolder);
  EXPECT_THAT(numbers_of(again), ElementsAre(1));
  ASSERT_FALSE(again.save(report(2)));
  EXPECT_THAT(numbers_of(again), ElementsAre(2, 1)) << "no number is given twice";
}

TEST(Reports, DropTheOldestWhenThereAreTooMany) {
  FaultFiles files;
  ReportStore store(files, kFolder);
  constexpr int kOver = 3;
  for (int n = 1; n <= static_cast<int>(kMaxReports) + kOver; ++n)
    ASSERT_FALSE(store.save(report(n)));
  const auto numbers = numbers_of(store);
  EXPECT_EQ(numbers.size(), kMaxReports);
  EXPECT_EQ(numbers.back(), 1U + kOver);
  EXPECT_EQ(files.contents().size(), kMaxReports);
}

TEST(Reports, AreLostOneByOneWhenTheDiskIsFull) {
  FaultFiles files;
  ReportStore store(files, kFolder);
  ASSERT_FALSE(store.save(report(1)));
  files.plan(FaultFiles::Fault::fail, 2, ENOSPC);
  const auto failure = store.save(report(2));
  ASSERT_TRUE(failure);
  EXPECT_THAT(failure->text, HasSubstr("No space left on device"));
  EXPECT_THAT(numbers_of(store), ElementsAre(1)) << "what was there stays";
  EXPECT_FALSE(store.save(report(3)));
}

TEST(Reports, AreNotReadWhenTheyAreDamagedAndHideNoOther) {
  FaultFiles files;
  ReportStore store(files, kFolder);
  for (int n = 1; n <= 2; ++n) ASSERT_FALSE(store.save(report(n)));
  files.put(std::string(kFolder) + "/000002.report", "noise");
  files.put(std::string(kFolder) + "/notes.txt", "somebody's");
  EXPECT_THAT(numbers_of(store), ElementsAre(1));
  const auto damaged = store.read(2);
  ASSERT_FALSE(damaged.ok());
  EXPECT_THAT(damaged.error().text, HasSubstr("000002.report does not begin like a stored file"));
}

TEST(Reports, AreMissedInWords) {
  FaultFiles files;
  const ReportStore store(files, kFolder);
  EXPECT_THAT(store.read(0).error().text, HasSubstr("no task has ended"));
  EXPECT_EQ(store.read(9).error().text, "there is no report 9");
}

TEST(Reports, LeaveNothingOfASaveThatAPowerCutInterrupted) {
  FaultFiles files;
  files.put(std::string(kFolder) + "/000001.report.0.tmp", "half");
  ReportStore store(files, kFolder);
  ASSERT_FALSE(store.save(report(1)));
  EXPECT_EQ(files.contents().size(), 1U);
}

TEST(Reports, AreJobsOfTheStorageThread) {
  FaultFiles files;
  Storage storage(files, "/state");
  const auto saved = storage.run({{}, SaveReport{report(1)}});
  EXPECT_TRUE(saved.ok);
  EXPECT_EQ(saved.whose, StoredFor::reports);
  ASSERT_EQ(storage.run({{}, ListReports{}}).reports.size(), 1U);
  const auto read = storage.run({{}, ReadReport{1}});
  ASSERT_EQ(read.reports.size(), 1U);
  EXPECT_EQ(read.reports[0].texts.line, report(1).line);
  EXPECT_FALSE(storage.run({{}, ReadReport{2}}).ok);
}

}  // namespace
}  // namespace drover::store
