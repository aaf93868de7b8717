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
