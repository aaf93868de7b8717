#include "drivers/ld06/twin.h"

#include <gtest/gtest.h>

#include "unit/drivers/ld06/rig.h"

namespace drover::ld06 {
namespace {

using namespace std::chrono_literals;

TEST(Ld06Twin, RefusesAStateThatItDoesNotKnow) {
  Ld06Twin twin(false, 1);
  for (const char* name : {"mud", "turn", "turn:", "turn:0", "turn:21", "turn:x"})
    EXPECT_FALSE(twin.set_state(name, Time{1s})) << name;
}

TEST(Ld06Twin, KeepsTheDevicesPace) {
  Ld06Twin twin(false, 1);
  std::array<char, 512> said{};
  std::size_t bytes = 0;
  for (Time now{100s}; now < Time{110s}; now += 2500us)
    bytes += twin.on_tick(now, test::room_m, said);
  EXPECT_NEAR(static_cast<double>(bytes), 375 * 47 * 10, 100);
}

}  // namespace
}  // namespace drover::ld06
