// A table of poses takes the place of a file when all of it is there, and never before.
#include "cli/pose_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "support/temp_folder.h"

namespace drover::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class PoseFileTest : public testing::Test {
 protected:
  PoseFileTest() { put(out_, "yesterday's"); }
  static void put(const std::string& path, const std::string& text) { std::ofstream(path) << text; }
  static std::string content(const std::string& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }

  test::TempFolder folder_;
  std::string out_ = folder_.path() + "/pose.csv";
  std::string in_ = folder_.path() + "/log.csv";
};

TEST_F(PoseFileTest, StaysAsItWasUntilAllOfTheTableIsThere) {
  PoseFile table(out_, in_);
  ASSERT_EQ(table.problem(), "");
  table.stream() << "today's";
  EXPECT_EQ(content(out_), "yesterday's");
  EXPECT_EQ(table.finish(), "");
  EXPECT_EQ(content(out_), "today's");
  EXPECT_EQ(files(), 1U);
}

TEST_F(PoseFileTest, StaysAsItWasWhenNothingComesOfIt) {
  { PoseFile(out_, in_).stream() << "half of tod"; }
  EXPECT_EQ(content(out_), "yesterday's");
  EXPECT_EQ(files(), 1U);
}

TEST_F(PoseFileTest, IsNeverTheFileThatIsRead) {
  put(in_, "a log");
  fs::create_symlink(in_, folder_.path() + "/link.csv");
  for (const auto& name : {in_, folder_.path() + "/link.csv"})
    EXPECT_THAT(PoseFile(name, in_).problem(), HasSubstr("is what is read"));
  put(out_ + ".part", "a log");
  EXPECT_THAT(PoseFile(out_, out_ + ".part").problem(), HasSubstr("is what is read"));
  EXPECT_EQ(content(in_), "a log");
  EXPECT_EQ(content(out_ + ".part"), "a log");
}

TEST_F(PoseFileTest, IsWrittenThroughALink) {
  const std::string link = folder_.path() + "/link.csv";
  fs::create_symlink(out_, link);
  PoseFile table(link, in_);
  table.stream() << "today's";
  EXPECT_EQ(table.finish(), "");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(content(out_), "today's");
}

TEST_F(PoseFileTest, IsWrittenInPlaceWhereItIsNoFile) {
  PoseFile table("/dev/null", in_);
  table.stream() << "today's";
  EXPECT_EQ(table.finish(), "");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(PoseFileTest, TellsWhatCannotBeWritten) {
  EXPECT_THAT(PoseFile(folder_.path() + "/none/pose.csv", in_).problem(),
              HasSubstr("cannot be written: No such file or directory"));
}

}  // namespace
}  // namespace drover::cli
