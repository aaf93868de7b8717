#include "store/track_file.h"

#include <gtest/gtest.h>

#include <set>

#include "store/storage.h"
#include "tests/unit/store/fault_files.h"

namespace drover::store {
namespace {

/// Names that a file system, a shell or a person would take for something else.
std::vector<std::string> odd_names() {
  return {"",
          ".",
          "..",
          "../../etc/passwd",
          "/etc/passwd",
          "CON",
          "con",
          "-rf",
          "a/b",
          "a\\b",
          "%2e%2e",
          "%252e",
          "a b",
          "园区01",
          "caf\xC3\xA9",
          "cafe\xCC\x81",
          "\xE2\x80\xAEtxt.exe",
          "test1",
          "Test1",
          "test1.json",
          "~",
          "a~1",
          "line\nbreak",
          std::string("a\0/../x", 7),
          "__proto__",
          std::string(300, 'x'),
          std::string(300, 'x') + "y",
          std::string(300, '/'),
          std::string(97, 'x'),
          std::string(98, 'x'),
          std::string(99, 'x')};
}

TEST(TrackFile, NamesNeverLeaveTheFolderAndNeverMeet) {
  std::set<std::string> files;
  for (const std::string& name : odd_names()) {
    const std::string file = track_file_name(name);
    EXPECT_TRUE(files.insert(file).second) << file;
    EXPECT_LE(file.size(), 140U);
    EXPECT_TRUE(file.starts_with("t-"));
    EXPECT_EQ(file.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-%~."),
              std::string::npos)
        << file;
    EXPECT_EQ(file.find(".."), std::string::npos) << file;
  }
}

TEST(TrackFile, ASecondAttemptGivesAnotherName) {
  EXPECT_NE(track_file_name("a", 1), track_file_name("a"));
  EXPECT_NE(track_file_name(std::string(300, 'x'), 1), track_file_name(std::string(300, 'x')));
}

TEST(TrackFile, EveryNameComesBackByteForByte) {
  FaultFiles files;
  Storage storage(files, "/state");
  for (const std::string& name : odd_names()) {
    ASSERT_TRUE(storage.run({{}, SaveTrack{{name, {}, {}}}}).ok) << name;
  }
  std::set<std::string> found;
  for (const Track& track : Storage(files, "/state").load().tracks) found.insert(track.name);
  const auto names = odd_names();
  EXPECT_EQ(found, std::set<std::string>(names.begin(), names.end()));
  for (const auto& [path, content] : files.contents()) {
    EXPECT_EQ(path.rfind('/'), std::string("/state/tracks").size()) << path;
  }
}

TEST(TrackFile, KeepsTheDigitsOfANumberThatNoIntegerHolds) {
  const Track track{"t",
                    {{1, 2, 3, 4, 5, 6, 123456789012345678901.0}},
                    std::nullopt,
                    "1,2,3,4,5,6,123456789012345678901,"};
  const auto read = decode_track(encode_track(track));
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->numbers, track.numbers);
  EXPECT_EQ(read->points.at(0).z_m, track.points[0].z_m);
}

TEST(TrackFile, RefusesContentThatIsSealedButNoTrack) {
  for (const std::string body :
       {"{}", "[]", "{\"name\":1,\"origin\":null,\"points\":[]}",
        "{\"name\":\"a\",\"origin\":7,\"points\":[]}",
        "{\"name\":\"a\",\"origin\":null,\"points\":[[1,2,3]]}",
        "{\"name\":\"a\",\"origin\":null,\"points\":[[1,2,3,4,5,6,\"7\"]]}"}) {
    EXPECT_FALSE(decode_track(seal("drover-track", 1, body)).ok()) << body;
  }
}

TEST(TrackFile, AnyFlippedByteIsNoticed) {
  const Track track{"test", {{188.2222333, 23.04934955, 230, 322100, 45220, 3.14, 0}}, {}};
  const std::string good = encode_track(track);
  ASSERT_TRUE(decode_track(good).ok());
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 1);
    EXPECT_FALSE(decode_track(bad).ok()) << i;
  }
}

}  // namespace
}  // namespace drover::store
