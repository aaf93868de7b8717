// A task that the whole engine drives in a field with planted errors, looked at cycle by cycle as
// from its recording: the errors are found.
#include <gtest/gtest.h>

#include "bench/field_world.h"
#include "cli/calibrate_drive.h"
#include "support/seeds.h"

namespace drover::cli {
namespace {

using calibrate::Quantity;

/// There, a left and a right circle, back, and a left and a right circle again.
Path circles() {
  test::Pen pen;
  for (const double side : {1.0, -1.0}) {
    pen.line(6);
    pen.arc(1.5, 2 * kPi * side);
  }
  pen.line(6);
  pen.arc(1.5, kPi);
  pen.line(8);
  Path path = test::record(pen.points());
  path.name = "circles";
  return path;
}

TEST(CalibrateInAField, FindsWhatIsPlanted) {
  bench::FieldPlan plan;
  plan.tyres = 1.02;
  plan.lever_x_m = 0.15;
  plan.lever_y_m = -0.1;
  plan.late_s = 0.1;
  plan.heading_off_deg = 2;
  auto config = bench::field_config();
  config.base.yaw_slip_factor = 1.3;
  for (std::uint64_t seed = 1; seed <= test::seeds(3); ++seed) {
    SCOPED_TRACE(seed);
    bench::FieldWorld world(config, plan, seed);
    DriveOfRecording taken(config.base);
    const auto path = circles();
    world.drive(path, 200, [&](const Snapshot& seen, const Pose&, double) { taken.take(seen); });
    const auto result = calibrate::calibrate(taken.drive, configured_of(config));
    ASSERT_EQ(result.refused, "");
    EXPECT_FALSE(result.signs.wrong());
    for (const auto& [what, truth] :
         {std::pair{Quantity::wheel_radius_m, 0.165 * 1.02},
          std::pair{Quantity::yaw_slip_factor, 1.2}, std::pair{Quantity::antenna_x_m, 0.25},
          std::pair{Quantity::antenna_y_m, -0.1}, std::pair{Quantity::heading_offset_deg, 2.0},
          std::pair{Quantity::position_late_s, 0.1}, std::pair{Quantity::heading_late_s, 0.1},
          std::pair{Quantity::gyro_scale, 1 / 1.002},
          std::pair{Quantity::gyro_bias_radps, 0.005}}) {
      const auto& found = result.of(what);
      EXPECT_EQ(found.refused, "") << static_cast<int>(what);
      EXPECT_NEAR(found.value, truth, found.interval) << static_cast<int>(what);
    }
  }
}

}  // namespace
}  // namespace drover::cli
