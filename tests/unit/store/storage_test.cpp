#include "store/storage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "store/point_texts.h"
#include "store/track_file.h"
#include "tests/unit/store/fault_files.h"

namespace drover::store {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Track track(const std::string& name, double first_x_m) {
  Track made{name, {}, GeodeticPoint{23.1, 113.0, 5.0}};
  for (int i = 0; i < 20; ++i) {
    made.points.push_back({188.2222333, 23.04934955, 230, first_x_m + i, 45220.0, 3.141592, 0});
  }
  return made;
}

std::map<std::string, double> first_x_of(const std::vector<Track>& tracks) {
  std::map<std::string, double> all;
  for (const Track& one : tracks) all[one.name] = one.points.at(0).x_m;
  return all;
}

/// The script that the fault plans cut: every kind of job, replacing, deleting, and starting again.
std::vector<StorageJob> script() {
  std::vector<StorageJob> jobs;
  const auto add = [&](auto what) {
    jobs.push_back({{RequestId::Source::mqtt, jobs.size()}, std::move(what)});
  };
  add(SaveTrack{track("a", 1)});
  add(SaveTrack{track("园区01", 2)});
  add(SaveOrigin{{23.0, 113.0, 1.0}});
  add(SaveTrack{track("a", 3)});
  add(DeleteTrack{"园区01"});
  add(SaveOrigin{{24.0, 113.0, 1.0}});
  add(SaveTrack{track("b", 4)});
  add(DeleteAllTracks{});
  add(SaveTrack{track("a", 5)});
  return jobs;
}

/// What may be on disk: the value that was acknowledged, and those of attempts that were not.
/// 0 stands for "not there".
class Model {
 public:
  void attempt(const StorageJob& job) {
    each(job, [](std::set<double>& values, double value) { values.insert(value); });
  }
  void acknowledged(const StorageJob& job) {
    each(job, [](std::set<double>& values, double value) { values = {value}; });
  }
  void expect(const StoredState& found, const std::string& where) const {
    EXPECT_THAT(found.report, testing::IsEmpty()) << where;
    auto there = first_x_of(found.tracks);
    if (found.origin) there[kOrigin] = found.origin->latitude_deg;
    for (const auto& [name, values] : values_) {
      EXPECT_TRUE(values.contains(there.contains(name) ? there[name] : 0)) << where << ": " << name;
    }
    for (const auto& [name, value] : there) EXPECT_TRUE(values_.contains(name)) << where << name;
  }

 private:
  template <class Change>
  void each(const StorageJob& job, Change change) {
    const auto one = [&](const std::string& name, double value) {
      change(values_.try_emplace(name, std::set<double>{0}).first->second, value);
    };
    if (const auto* save = std::get_if<SaveTrack>(&job.what)) {
      one(save->track.name, save->track.points[0].x_m);
    } else if (const auto* gone = std::get_if<DeleteTrack>(&job.what)) {
      one(gone->name, 0);
    } else if (const auto* origin = std::get_if<SaveOrigin>(&job.what)) {
      one(kOrigin, origin->origin.latitude_deg);
    } else {
      for (auto& [name, values] : values_) {
        if (name != kOrigin) change(values, 0);
      }
    }
  }
  static constexpr const char* kOrigin = "(origin)";
  std::map<std::string, std::set<double>> values_;
};

/// Runs the script until the power cut, if any; returns the number of calls made.
int run_script(FaultFiles& files, Model& model) {
  try {
    Storage storage(files, "/state");
    storage.load();
    for (const StorageJob& job : script()) {
      model.attempt(job);
      if (storage.run(job).ok) model.acknowledged(job);
    }
  } catch (const PowerCut&) {
  }
  return files.calls();
}

TEST(Storage, KeepsWhatItAcknowledgedWhereverThePowerGoes) {
  FaultFiles whole;
  Model unused;
  const int calls = run_script(whole, unused);
  ASSERT_GT(calls, 40);
  for (const auto fault : {FaultFiles::Fault::cut_before, FaultFiles::Fault::cut_after}) {
    for (int at = 1; at <= calls; ++at) {
      for (int remains = 0; remains < 4; ++remains) {
        FaultFiles files;
        files.plan(fault, at);
        Model model;
        run_script(files, model);
        files.boot_after_cut({(remains & 1) != 0, (remains & 2) != 0});
        Storage again(files, "/state");
        model.expect(again.load(),
                     "cut at call " + std::to_string(at) + " remains " + std::to_string(remains));
      }
    }
  }
}

TEST(Storage, KeepsWhatItAcknowledgedWhicheverCallFails) {
  FaultFiles whole;
  Model unused;
  const int calls = run_script(whole, unused);
  for (const int error : {EIO, ENOSPC}) {
    for (int at = 1; at <= calls; ++at) {
      for (int remains = 0; remains < 4; ++remains) {
        FaultFiles files;
        files.plan(FaultFiles::Fault::fail, at, error);
        Model model;
        run_script(files, model);
        files.boot_after_cut({(remains & 1) != 0, (remains & 2) != 0});
        Storage again(files, "/state");
        model.expect(again.load(), "call " + std::to_string(at) + " failed");
      }
    }
  }
}

TEST(Storage, SaysWhichStepFailedAndWhy) {
  FaultFiles files;
  Storage storage(files, "/state");
  files.plan(FaultFiles::Fault::fail, 2, ENOSPC);
  const auto reply = storage.run({{}, SaveTrack{track("test1", 1)}});
  EXPECT_FALSE(reply.ok);
  EXPECT_THAT(reply.reason, HasSubstr("cannot write /state/tracks/t-test1.json.0.tmp"));
  EXPECT_THAT(reply.reason, HasSubstr("No space left on device"));
  EXPECT_TRUE(files.contents().empty());
}

TEST(Storage, WritesTheWholeFileAnewAfterAFailedSync) {
  FaultFiles files;
  Storage storage(files, "/state");
  files.plan(FaultFiles::Fault::fail, 3);
  EXPECT_FALSE(storage.run({{}, SaveTrack{track("a", 1)}}).ok);
  EXPECT_TRUE(storage.run({{}, SaveTrack{track("a", 1)}}).ok);
  files.boot_after_cut({});
  EXPECT_EQ(first_x_of(Storage(files, "/state").load().tracks).at("a"), 1);
}

TEST(Storage, RefusesToDeleteWhatIsNotThere) {
  FaultFiles files;
  Storage storage(files, "/state");
  EXPECT_EQ(storage.run({{}, DeleteTrack{"x"}}).reason, "there is no track of this name");
}

TEST(Storage, DeletingAllWhenThereIsNoneSucceeds) {
  FaultFiles files;
  Storage storage(files, "/state");
  EXPECT_TRUE(storage.run({{}, DeleteAllTracks{}}).ok);
}

TEST(Storage, TellsWhichTracksAreGoneWhenDeletingAllStopsHalfWay) {
  FaultFiles files;
  Storage storage(files, "/state");
  for (const char* name : {"a", "b", "c"}) storage.run({{}, SaveTrack{track(name, 1)}});
  files.plan(FaultFiles::Fault::fail, 2);
  const auto reply = storage.run({{}, DeleteAllTracks{}});
  EXPECT_FALSE(reply.ok);
  EXPECT_THAT(reply.removed, ElementsAre("a"));
  EXPECT_EQ(first_x_of(Storage(files, "/state").load().tracks).size(), 2U);
}

TEST(Storage, PutsDamagedFilesAsideAndLoadsTheirNeighbours) {
  FaultFiles files;
  const std::string good = encode_track(track("good", 7));
  std::string flipped = good;
  flipped[good.find("45220")] = '5';
  std::string newer = good;
  newer.replace(newer.find("\"version\":1"), 11, "\"version\":2");
  files.put("/state/tracks/t-good.json", good);
  files.put("/state/tracks/t-empty.json", "");
  files.put("/state/tracks/t-cut.json", good.substr(0, good.size() / 2));
  files.put("/state/tracks/t-flipped.json", flipped);
  files.put("/state/tracks/t-newer.json", newer);
  files.put("/state/tracks/t-other.json", "{\"some\": \"thing\"}\n");
  files.put("/state/tracks/t-noise.json", "\xFF\xFE\n\n}");
  files.put("/state/tracks/t-twice.json", good);
  files.put("/state/tracks/t-left.json.0.tmp", good);
  files.put("/state/origin.json", "");
  Storage storage(files, "/state");
  const StoredState found = storage.load();
  EXPECT_EQ(first_x_of(found.tracks), (std::map<std::string, double>{{"good", 7}}));
  EXPECT_EQ(found.report.size(), 8U);
  EXPECT_THAT(found.report, testing::Contains(HasSubstr("t-newer.json is of another version")));
  EXPECT_THAT(found.report, testing::Contains(HasSubstr("kept as t-cut.json.bad")));
  const auto left = files.contents();
  EXPECT_EQ(left.at("/state/tracks/t-flipped.json.bad"), flipped);
  EXPECT_FALSE(left.contains("/state/tracks/t-left.json.0.tmp"));
  EXPECT_FALSE(found.origin.has_value());
}

TEST(Storage, TellsOfALostOriginUntilAnotherIsGiven) {
  FaultFiles files;
  files.put("/state/origin.json", "{\"latitude_deg\": 23}");
  Storage storage(files, "/state");
  StoredState found = storage.load();
  EXPECT_FALSE(found.origin.has_value());
  EXPECT_THAT(found.origin_problem, HasSubstr("the stored origin was damaged"));
  found = Storage(files, "/state").load();
  EXPECT_THAT(found.origin_problem, HasSubstr("init_rtk_data")) << "also after the next start";
  EXPECT_THAT(found.report, ElementsAre("/state/origin.json was damaged or deleted"));

  ASSERT_TRUE(storage.run({{}, SaveOrigin{{23.0, 113.0, 1.0}}}).ok);
  found = Storage(files, "/state").load();
  EXPECT_TRUE(found.origin.has_value());
  EXPECT_EQ(found.origin_problem, "");

  files.remove("/state/origin.json");
  found = Storage(files, "/state").load();
  EXPECT_THAT(found.origin_problem, HasSubstr("damaged or deleted")) << "the old one lies aside";
  EXPECT_THAT(found.report, ElementsAre("/state/origin.json was damaged or deleted"));
}

TEST(Storage, TellsOfADeletedOriginUntilAnotherIsGiven) {
  FaultFiles files;
  Storage storage(files, "/state");
  ASSERT_TRUE(storage.run({{}, SaveOrigin{{23.0, 113.0, 1.0}}}).ok);
  files.remove("/state/origin.json");
  StoredState found = Storage(files, "/state").load();
  EXPECT_FALSE(found.origin.has_value());
  EXPECT_EQ(found.origin_problem,
            "the stored origin was deleted: put the robot where it was and give init_rtk_data");
  EXPECT_THAT(found.report, ElementsAre("/state/origin.json was deleted"));
  ASSERT_TRUE(storage.run({{}, SaveOrigin{{23.0, 113.0, 1.0}}}).ok);
  EXPECT_EQ(Storage(files, "/state").load().origin_problem, "");
}

TEST(Storage, TellsOfAnOriginThatCannotBeRead) {
  FaultFiles files;
  files.put("/state/origin.json", std::string(70'000, ' '));
  const StoredState found = Storage(files, "/state").load();
  EXPECT_FALSE(found.origin.has_value());
  EXPECT_THAT(found.origin_problem, HasSubstr("the stored origin cannot be read"));
  EXPECT_THAT(found.report, ElementsAre(HasSubstr("/state/origin.json")));
}

TEST(Storage, AnOriginThatNeverWasIsNoProblem) {
  FaultFiles files;
  EXPECT_EQ(Storage(files, "/state").load().origin_problem, "");
}

TEST(Storage, LoadsNoMoreTracksThanItMayHoldAndSaysSo) {
  FaultFiles files;
  for (std::size_t i = 0; i < kMaxTracks + 5; ++i) {
    const std::string name = "n" + std::to_string(i);
    files.put("/state/tracks/" + track_file_name(name), encode_track({name, {}, {}}));
  }
  Storage storage(files, "/state");
  const StoredState found = storage.load();
  EXPECT_EQ(found.tracks.size(), kMaxTracks);
  EXPECT_THAT(found.report, ElementsAre(HasSubstr("5 files in /state/tracks were not read")));
  EXPECT_THAT(storage.run({{}, SaveTrack{{"one more", {}, {}}}}).reason, HasSubstr("1000 tracks"));
}

TEST(Storage, RefusesATrackWithTooManyPoints) {
  FaultFiles files;
  Storage storage(files, "/state");
  Track large{"large", std::vector<TrackPoint>(kMaxPointsPerTrack + 1), {}};
  EXPECT_THAT(storage.run({{}, SaveTrack{large}}).reason, HasSubstr("at most 40000 points"));
}

/// As long as a save of 2 MiB makes it.
Track large(const std::string& name) {
  Track track{name, std::vector<TrackPoint>(22'000), {}};
  for (std::size_t i = 0; i < track.points.size(); ++i) {
    track.points[i].latitude_deg = 23.1496524965 + 1e-9 * static_cast<double>(i);
    track.points[i].x_m = -1234.5678901234567 / static_cast<double>(i + 1);
  }
  return track;
}

TEST(Storage, ReadsBackALargeTrackToTheBit) {
  FaultFiles files;
  Storage storage(files, "/state");
  const Track track = large("large");
  ASSERT_TRUE(storage.run({{}, SaveTrack{track}}).ok);
  const auto found = Storage(files, "/state").load();
  ASSERT_EQ(found.tracks.size(), 1U);
  for (std::size_t i = 0; i < track.points.size(); i += 997) {
    EXPECT_EQ(found.tracks[0].points[i].latitude_deg, track.points[i].latitude_deg);
    EXPECT_EQ(found.tracks[0].points[i].x_m, track.points[i].x_m);
  }
}

TEST(Storage, RefusesWhatWouldMakeTheListOfAllTracksTooLongAndTellsTheNumbers) {
  FaultFiles files;
  Storage storage(files, "/state");
  const std::size_t each = list_bytes(large("a"));
  ASSERT_GT(3 * each, kMaxListBytes);
  ASSERT_LE(2 * each, kMaxListBytes);
  ASSERT_TRUE(storage.run({{}, SaveTrack{large("a")}}).ok);
  ASSERT_TRUE(storage.run({{}, SaveTrack{large("b")}}).ok);
  const auto refused = storage.run({{}, SaveTrack{large("c")}});
  EXPECT_FALSE(refused.ok);
  for (const std::size_t number : {2 * each + 2, each, kMaxListBytes})
    EXPECT_THAT(refused.reason, HasSubstr(std::to_string(number)));
  EXPECT_TRUE(storage.run({{}, SaveTrack{large("b")}}).ok) << "in place of itself";
  ASSERT_TRUE(storage.run({{}, DeleteTrack{"a"}}).ok);
  EXPECT_TRUE(storage.run({{}, SaveTrack{large("c")}}).ok) << "there is room again";
}

TEST(Storage, LoadsNoMoreThanOneListCarriesAndSaysSo) {
  FaultFiles files;
  for (const char* name : {"a", "b", "c"})
    files.put("/state/tracks/" + track_file_name(name), encode_track(large(name)));
  Storage storage(files, "/state");
  const StoredState found = storage.load();
  EXPECT_EQ(found.tracks.size(), 2U);
  EXPECT_THAT(found.report, ElementsAre(HasSubstr("1 files in /state/tracks were not read")));
  EXPECT_EQ(files.contents().size(), 3U) << "nothing is thrown away";
}

TEST(Storage, GivesBackTheTrackThatItWasGiven) {
  FaultFiles files;
  const auto reply = Storage(files, "/state").run({{}, SaveTrack{track("a", 7)}});
  ASSERT_TRUE(reply.track.has_value());
  EXPECT_EQ(reply.track->points[0].x_m, 7);
}

}  // namespace
}  // namespace drover::store
