#include "store/kept_marks.h"

#include <gtest/gtest.h>

#include "tests/unit/store/fault_files.h"

namespace drover::store {
namespace {

TEST(KeptMarks, AreThereForWhatWasWrittenOnce) {
  FaultFiles files;
  EXPECT_FALSE(was_kept(files, "state", "scene.texts"));
  mark_kept(files, "state", "scene.texts");
  EXPECT_TRUE(was_kept(files, "state", "scene.texts"));
  EXPECT_FALSE(was_kept(files, "state", "zones.texts"));
}
TEST(KeptMarks, AreWrittenOnce) {
  FaultFiles files;
  mark_kept(files, "state", "scene.texts");
  const int calls = files.calls();
  mark_kept(files, "state", "scene.texts");
  EXPECT_EQ(files.calls(), calls) << "a card of flash lives long";
}
TEST(KeptMarks, AreMadeLaterWhereTheDiskWasFull) {
  FaultFiles files;
  files.plan(FaultFiles::Fault::fail, 1, ENOSPC);
  mark_kept(files, "state", "scene.texts");
  EXPECT_FALSE(was_kept(files, "state", "scene.texts"));
  mark_kept(files, "state", "scene.texts");
  EXPECT_TRUE(was_kept(files, "state", "scene.texts"));
}
TEST(KeptMarks, LeaveNothingElseWhereverThePowerGoes) {
  for (const auto fault : {FaultFiles::Fault::cut_before, FaultFiles::Fault::cut_after}) {
    for (int call = 1; call <= 6; ++call) {
      for (const bool names : {false, true}) {
        FaultFiles files;
        files.plan(fault, call);
        try {
          mark_kept(files, "state", "scene.texts");
        } catch (const PowerCut&) {
        }
        files.boot_after_cut({names, names});
        mark_kept(files, "state", "scene.texts");
        EXPECT_EQ(files.contents().size(), 1U) << call;
        EXPECT_TRUE(was_kept(files, "state", "scene.texts")) << call;
      }
    }
  }
}
TEST(KeptMarks, ThatCannotBeReadCount) {
  struct Unreadable final : FaultFiles {
    int read(const std::string&, std::size_t, std::string&) override { return EIO; }
  } files;
  EXPECT_TRUE(was_kept(files, "state", "scene.texts"));
}

}  // namespace
}  // namespace drover::store
