// What everything on CAN that moves makes of its wire, however it is told: which frames it hears,
// and that none of them harms it.
#include <gtest/gtest.h>

#include "support/describe.h"
#include "unit/drivers/conformance/can_movers.h"

namespace drover::test {
namespace {

class CanWire : public ::testing::TestWithParam<Subject> {};

constexpr auto kRun = AxisRequest::run;
constexpr auto kRest = AxisRequest::rest;

TEST_P(CanWire, NamesTheChannelsThatItsEntryNames) {
  CanBench bench(GetParam());
  const auto made = bench.actuator->channels();
  const auto named = GetParam().entry->channels;
  ASSERT_EQ(made.size(), named.size());
  ASSERT_FALSE(made.empty());
  for (std::size_t i = 0; i < made.size(); ++i) {
    EXPECT_EQ(made[i].name, named[i].name);
    EXPECT_EQ(made[i].mode, named[i].mode);
  }
}

TEST_P(CanWire, IgnoresItsFramesUnderAForeignFlag) {
  CanBench bench(GetParam());
  for (CanFrame frame : golden_frames(*GetParam().entry)) {
    for (int i = 0; i < 3; ++i) {
      CanFrame foreign = frame;
      if (i == 0) foreign.extended = !foreign.extended;
      if (i == 1) foreign.fd = true;
      if (i == 2) foreign.error = true;
      if (foreign == frame) continue;
      const bool was_not_its_own = i == 0 && frame.extended;
      if (was_not_its_own) continue;
      bench.inject(foreign);
      EXPECT_TRUE(bench.out.measurements.empty()) << describe(foreign);
    }
  }
  EXPECT_EQ(bench.device->health(bench.now).good, 0U);
  EXPECT_EQ(bench.device->health(bench.now).bad, 0U);
}

bool listens_to(const FrameFace& frames, const CanFrame& frame) {
  const auto filters = frames.listens();
  return std::any_of(filters.begin(), filters.end(),
                     [&](const FrameFilter& filter) { return filter.matches(frame); });
}

/// Else nobody would notice who else commands it.
TEST_P(CanWire, ListensToTheFramesThatItIsCommandedBy) {
  CanBench bench(GetParam());
  for (const FrameRule& rule : bench.actuator->rules()) {
    CanFrame frame;
    frame.id = rule.id;
    frame.extended = rule.extended;
    EXPECT_TRUE(listens_to(*bench.frames, frame)) << describe(frame);
  }
}

TEST_P(CanWire, LosesNothingByHearingOnlyWhatItListensTo) {
  const auto like = golden_frames(*GetParam().entry);
  std::mt19937 random(11);
  CanBench bench(GetParam());
  bench.run(milliseconds(500), kRest);
  const SourceHealth before = bench.device->health(bench.now);
  for (int i = 0; i < 20000; ++i) {
    const CanFrame frame = random_frame(random, like);
    if (listens_to(*bench.frames, frame)) continue;
    bench.inject(frame);
    ASSERT_TRUE(bench.out.measurements.empty()) << describe(frame);
    ASSERT_TRUE(bench.out.frames.empty()) << describe(frame);
  }
  const SourceHealth after = bench.device->health(bench.now);
  EXPECT_EQ(after.good, before.good);
  EXPECT_EQ(after.bad, before.bad);
}

TEST_P(CanWire, SurvivesEveryTruncation) {
  CanBench bench(GetParam());
  for (CanFrame frame : golden_frames(*GetParam().entry)) {
    for (std::uint8_t len = 0; len <= frame.len; ++len) {
      CanFrame cut = frame;
      cut.len = len;
      bench.inject(cut);
      bench.step({kRest, 0});
    }
  }
  expect_decent(bench);
}

TEST_P(CanWire, SurvivesAHundredThousandRandomFrames) {
  const auto like = golden_frames(*GetParam().entry);
  std::mt19937 random(20250101);
  CanBench bench(GetParam());
  for (int i = 0; i < 100000; ++i) {
    bench.inject(random_frame(random, like));
    if (i % 16 == 0) {
      bench.now += milliseconds(5);
      bench.out.clear();
      bench.actuator->on_setpoints(bench.to_all({i % 4096 < 2048 ? kRest : kRun, 1.0}), bench.now,
                                   bench.out);
      bench.device->on_tick(bench.now, bench.out);
      for (const CanFrame& frame : bench.out.frames) {
        ASSERT_TRUE(on_list(bench.actuator->rules(), frame)) << describe(frame);
        ASSERT_NE(bench.effect_of(frame), FrameEffect::forbidden) << describe(frame);
        if (i % 4096 < 2048) {
          ASSERT_NE(bench.effect_of(frame), FrameEffect::motion) << describe(frame);
        }
      }
    }
  }
  expect_decent(bench);
}

INSTANTIATE_TEST_SUITE_P(Registry, CanWire, ::testing::ValuesIn(movers()), label_of);

}  // namespace
}  // namespace drover::test
