#include <gtest/gtest.h>

#include "one_of_each_input.h"
#include "recorded_run.h"
#include "support/allocation_counter.h"

namespace drover::gateway {
namespace {

TEST(Gateway, AllocatesNothingWhateverReachesIt) {
  Gateway gateway(load_robot().config);
  OneOfEachInput all;
  std::vector<bool> seen(kInputKinds, false);
  for (const auto& input : all.inputs) seen[kind_of(input)] = true;
  EXPECT_EQ(std::count(seen.begin(), seen.end(), false), 0) << "a kind of input is not tried";
  test::AllocationCounter counter;
  for (int round = 0; round < 20; ++round)
    for (Input input : all.inputs) {
      input.time += round * std::chrono::milliseconds(100);
      gateway.apply(input);
    }
  EXPECT_EQ(counter.count(), 0U);
}

TEST(Gateway, AllocatesNothingWithTwoOfEach) {
  const auto loaded =
      config::load_file(DROVER_SOURCE_DIR "/sim/robots/field_two_of_each.drover.json");
  ASSERT_TRUE(loaded.problems.empty());
  Gateway gateway(loaded.config);
  RecordEncoder encoder;
  ASSERT_EQ(gateway.snapshot().sensors.size(), 6U);
  test::AllocationCounter counter;
  Time now{std::chrono::seconds(100)};
  std::size_t bytes = 0;
  for (int i = 0; i < 4000; ++i, now += std::chrono::milliseconds(5)) {
    for (LinkId link = 0; link < gateway.wiring().links.size(); ++link)
      if (i % 400 == 0) gateway.apply({now, LinkUp{link}});
    gateway.apply({now, Tick{true, false, false}});
    bytes += encoder.output(gateway).size();
  }
  EXPECT_EQ(counter.count(), 0U);
  EXPECT_GT(bytes, 0U);
}

TEST(RecordEncoder, AllocatesNothing) {
  Gateway gateway(load_robot().config);
  RecordEncoder encoder;
  OneOfEachInput all;
  RobotRun run = a_run();
  test::AllocationCounter counter;
  std::size_t bytes = 0;
  for (const auto* inputs : {&all.inputs, &run.inputs})
    for (const auto& input : *inputs) {
      bytes += encoder.input(input).size();
      gateway.apply(input);
      if (std::holds_alternative<Tick>(input.body)) bytes += encoder.output(gateway).size();
    }
  EXPECT_EQ(counter.count(), 0U);
  EXPECT_GT(bytes, 0U);
}

}  // namespace
}  // namespace drover::gateway
