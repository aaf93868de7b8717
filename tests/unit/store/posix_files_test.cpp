#include "store/posix_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

#include "store/storage.h"

namespace drover::store {
namespace {

namespace fs = std::filesystem;

class PosixFilesTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "drover-store-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }

  PosixFiles files_;
  std::string folder_;
};

TEST_F(PosixFilesTest, TellsWhatTheSystemTells) {
  int descriptor = -1;
  std::string content;
  std::vector<std::string> names;
  EXPECT_EQ(files_.create(folder_ + "/none/x", descriptor), ENOENT);
  EXPECT_EQ(files_.read(folder_ + "/none", 10, content), ENOENT);
  EXPECT_EQ(files_.remove(folder_ + "/none"), ENOENT);
  EXPECT_EQ(files_.rename(folder_ + "/none", folder_ + "/x"), ENOENT);
  EXPECT_EQ(files_.list(folder_ + "/none", names), ENOENT);
  EXPECT_EQ(files_.sync_folder(folder_ + "/none"), ENOENT);
  EXPECT_EQ(files_.write(-1, "x"), EBADF);
  EXPECT_EQ(files_.sync(-1), EBADF);
}

TEST_F(PosixFilesTest, FollowsNoLinkAndOpensNoPipe) {
  std::string content;
  fs::create_symlink("/etc/hostname", folder_ + "/link");
  EXPECT_EQ(files_.read(folder_ + "/link", 100, content), ELOOP);
  ASSERT_EQ(mkfifo((folder_ + "/pipe").c_str(), 0600), 0);
  EXPECT_EQ(files_.read(folder_ + "/pipe", 100, content), EINVAL);
  int descriptor = -1;
  EXPECT_EQ(files_.create(folder_ + "/link", descriptor), EEXIST);
}

TEST_F(PosixFilesTest, RefusesAFileThatIsTooLarge) {
  std::ofstream(folder_ + "/f") << "12345";
  std::string content;
  EXPECT_EQ(files_.read(folder_ + "/f", 4, content), EFBIG);
  EXPECT_EQ(files_.read(folder_ + "/f", 5, content), 0);
  EXPECT_EQ(content, "12345");
}

TEST_F(PosixFilesTest, ReadsTheFrontOfAFile) {
  std::ofstream(folder_ + "/f") << "12345";
  std::string content;
  EXPECT_EQ(files_.read_front(folder_ + "/f", 4, content), 0);
  EXPECT_EQ(content, "1234");
  EXPECT_EQ(files_.read_front(folder_ + "/f", 9, content), 0);
  EXPECT_EQ(content, "12345");
  EXPECT_EQ(files_.read_front(folder_ + "/none", 9, content), ENOENT);
  EXPECT_EQ(files_.read_front(folder_, 9, content), EINVAL);
}

TEST_F(PosixFilesTest, ASavedTrackIsThereForTheNextStart) {
  const Track track{"../../etc/passwd", {{188.2222333, 23.04934955, 230, 1, 2, 3, 0}}, {}};
  {
    Storage storage(files_, folder_ + "/state");
    ASSERT_TRUE(storage.load().report.empty());
    ASSERT_TRUE(storage.run({{}, SaveTrack{track}}).ok);
    ASSERT_TRUE(storage.run({{}, SaveTrack{track}}).ok);
    ASSERT_TRUE(storage.run({{}, SaveOrigin{{23.5, 113.5, 7}}}).ok);
  }
  Storage storage(files_, folder_ + "/state");
  const StoredState found = storage.load();
  ASSERT_EQ(found.tracks.size(), 1U);
  EXPECT_EQ(found.tracks[0].name, track.name);
  EXPECT_EQ(found.tracks[0].points[0].longitude_deg, 188.2222333);
  ASSERT_TRUE(found.origin.has_value());
  EXPECT_EQ(found.origin->longitude_deg, 113.5);
  EXPECT_TRUE(storage.run({{}, DeleteAllTracks{}}).ok);
  EXPECT_TRUE(fs::is_empty(folder_ + "/state/tracks"));
}

TEST_F(PosixFilesTest, AStateFolderThatIsAFileIsNamedAtStart) {
  std::ofstream(folder_ + "/state") << "x";
  try {
    Storage storage(files_, folder_ + "/state");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/state: Not a directory"), std::string::npos);
  }
}

}  // namespace
}  // namespace drover::store
