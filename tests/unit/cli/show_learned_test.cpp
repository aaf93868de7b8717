// What drives taught the robot, as a person reads it.
#include "cli/show_learned.h"

#include <gtest/gtest.h>

#include "unit/cli/parsed.h"

namespace drover::cli {
namespace {

TEST(WhatWasLearned, IsATableBesideTheConfiguration) {
  EXPECT_EQ(
      show_learned(parsed(
          R"({"ok":true,"learned":{"values":[{"name":"heading_baseline_offset_deg","unit":"deg",)"
          R"("configured":90,"fits":91.82,"interval":0.21,"used":"made up for"},)"
          R"({"name":"positions late","unit":"s","configured":null,"fits":0.084,"interval":0.02,)"
          R"("used":"made up for"},{"name":"yaw_slip_factor","unit":"","configured":1.2,)"
          R"("fits":1.31,"interval":0.06,"used":"made up for"}],"kept_s":1772373900,)"
          R"("problem":""}})")),
      "                             configured   fits         within\n"
      "heading_baseline_offset_deg  90 deg       91.82 deg    +- 0.21 deg  made up for\n"
      "positions late               -            0.084 s      +- 0.02 s    made up for\n"
      "yaw_slip_factor              1.2          1.31         +- 0.06      made up for\n"
      "kept on the disk, of 2026-03-01 14:05 UTC\n");
}

TEST(WhatWasLearned, IsNothingAtFirst) {
  EXPECT_EQ(show_learned(parsed(R"({"ok":true,"learned":{"values":[],"kept_s":null}})")),
            "nothing yet: straights there and back, turns and changes of speed teach it\n");
}

TEST(WhatWasLearned, SaysThatTheDiskDoesNotForget) {
  const auto text = show_learned(parsed(R"({"ok":true,"learned":{"values":[],"kept_s":1772373900,)"
                                        R"("problem":"Read-only file system"}})"));
  EXPECT_NE(text.find("not on the disk: Read-only file system\n"), std::string::npos) << text;
}

TEST(WhatWasLearned, SaysThatTheDiskDoesNotTakeIt) {
  const auto text = show_learned(
      parsed(R"({"ok":true,"learned":{"values":[{"name":"gyro scale","unit":"","configured":null,)"
             R"("fits":1.002,"interval":0.001,"used":"made up for"}],"kept_s":1772373900,)"
             R"("problem":"No space left on device"}})"));
  EXPECT_NE(text.find("not on the disk: No space left on device\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace drover::cli
