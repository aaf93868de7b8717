// Frames of a ZLAC8015D, by its maker's examples, and what each does.
#include "drivers/zlac8015d/codec.h"

#include <gtest/gtest.h>

#include "unit/drivers/zlac8015d/bench.h"

namespace drover::zlac8015d {
namespace {

using test::describe;
using test::parse_frame;

FrameEffect effect_of(const std::string& frame, const Pair& target = {}) {
  return effect(parse_frame(frame), settings(), steps_of(settings()), target).kind;
}

TEST(Zlac8015dCodec, ReadsTheMakersExamples) {
  EXPECT_EQ(decode_pair(parse_frame("281#1AFCFFFFEA030000"), Cob::velocities, 1),
            (Pair{-998, 1002}));
  EXPECT_EQ(describe(encode_targets(1, {100, -100})), "301#640000009CFFFFFF");
  EXPECT_EQ(describe(encode_controlword(1, 0x0F)), "201#0F00");
}

TEST(Zlac8015dCodec, TakesTheWorseOfBothWheels) {
  const auto state = [](const std::string& frame) {
    return drive_state(*decode_status(parse_frame(frame), 1));
  };
  using canopen::DriveState;
  EXPECT_EQ(state("181#2700270000000000"), DriveState::operation_enabled);
  EXPECT_EQ(state("181#2700230000000000"), DriveState::switched_on);
  EXPECT_EQ(state("181#2000270000000000"), DriveState::switch_on_disabled);
  EXPECT_EQ(state("181#2700280004000000"), DriveState::fault);
  EXPECT_EQ(state("181#0700270000000000"), DriveState::quick_stop_active);
  EXPECT_EQ(error_text(*decode_status(parse_frame("181#2700280001000400"), 1)), "over-current");
  EXPECT_EQ(error_text(*decode_status(parse_frame("181#2700280000000400"), 1)),
            "over-current, of the left or the right motor");
  EXPECT_EQ(error_text(*decode_status(parse_frame("181#2800270000100000"), 1)),
            "error 0x1000, of the left or the right motor");
  EXPECT_TRUE(error_text(*decode_status(parse_frame("181#2700270000000000"), 1)).empty());
}

TEST(Zlac8015dRules, ForbidWhatWritesFlashOrMeansAnotherNode) {
  for (const char* const frame :
       {"601#2B10200001000000", "601#2B09200001000000", "601#2B05200003000000",
        "601#2B0A200002000000", "601#2310100173617665", "601#23FF600164000000", "000#0100",
        "000#8101", "000#8001", "000#0102", "201#1F00", "601#2B40600000000000"})
    EXPECT_EQ(effect_of(frame), FrameEffect::forbidden) << frame;
}

TEST(Zlac8015dRules, NameTheWheelThatMoves) {
  EXPECT_EQ(effect_of("301#0000000000000000"), FrameEffect::stop);
  const auto moves = [](const char* frame) {
    return effect(parse_frame(frame), settings(), steps_of(settings()), {}).moves;
  };
  EXPECT_EQ(moves("301#6400000000000000"), channel_bit(kLeft));
  EXPECT_EQ(moves("301#0000000064000000"), channel_bit(kRight));
  EXPECT_EQ(moves("301#6400000064000000"), channel_bit(kLeft) | channel_bit(kRight));
}

TEST(Zlac8015dRules, EnablingMovesWhatATargetLeftInTheDrive) {
  EXPECT_EQ(effect_of("201#0F00"), FrameEffect::harmless);
  EXPECT_EQ(effect_of("201#0F00", {100, 0}), FrameEffect::motion);
}

}  // namespace
}  // namespace drover::zlac8015d
