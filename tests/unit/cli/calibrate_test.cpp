// From a log and from the cycles of a recording to the numbers that were planted, and to a patch of
// drover.json.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cli/calibrate_drive.h"
#include "cli/show_calibration.h"
#include "drover/angle.h"
#include "gateway/recording/replay.h"
#include "unit/calibrate/simulated_drive.h"
#include "unit/cli/parsed.h"
#include "unit/gateway/recorded_run.h"

namespace drover::cli {
namespace {

using calibrate::Calibration;
using calibrate::Planted;
using calibrate::Quantity;
using testing::HasSubstr;
using testing::Not;

constexpr GeodeticPoint kYard{48.1, 11.6, 500};

engine::EngineConfig robot() {
  engine::EngineConfig config;
  config.base.yaw_slip_factor = 1.5;
  for (AxisId id = 0; id < 4; ++id)
    (void)(id % 2 == 0 ? config.base.left : config.base.right).push_back(id);
  config.estimate.antenna_x_m = 0.3;
  config.estimate.heading_baseline_offset_deg = 90;
  return config;
}

Planted planted() {
  Planted p;
  p.left_scale = p.right_scale = 1.03;
  p.yaw_slip_factor = 1.2;
  p.antenna_x_m = 0.4;
  p.antenna_y_m = -0.1;
  p.heading_offset_deg = 92;
  p.position_late_s = 0.1;
  p.heading_late_s = 0.1;
  p.speed_late_s = 0.1;
  return p;
}

calibrate::Drive driven() {
  return calibrate::SimulatedDrive(planted(), configured_of(robot()), 3)
      .drive(calibrate::good_legs());
}

Time at(double time_s) {
  return Time{from_s(time_s)};
}

GnssPosition fix_at(const engine::estimate::LocalFrame& frame, const calibrate::PlaceRow& row) {
  const auto place = frame.geodetic({row.east_m, row.north_m}, kYard.altitude_m);
  GnssPosition position;
  position.latitude_deg = place.latitude_deg;
  position.longitude_deg = place.longitude_deg;
  position.altitude_msl_m = kYard.altitude_m;
  position.undulation_m = 0;
  position.quality = FixQuality::rtk_fixed;
  return position;
}

void expect_planted(const Calibration& result) {
  ASSERT_EQ(result.refused, "");
  EXPECT_FALSE(result.signs.wrong());
  const Planted p = planted();
  for (const auto& [what, truth] : {std::pair{Quantity::wheel_radius_m, 0.165 * 1.03},
                                    std::pair{Quantity::yaw_slip_factor, p.yaw_slip_factor},
                                    std::pair{Quantity::antenna_x_m, p.antenna_x_m},
                                    std::pair{Quantity::antenna_y_m, p.antenna_y_m},
                                    std::pair{Quantity::heading_offset_deg, p.heading_offset_deg},
                                    std::pair{Quantity::position_late_s, p.position_late_s},
                                    std::pair{Quantity::drive_lag_s, p.dead_s + p.lag_s}}) {
    const auto& found = result.of(what);
    EXPECT_EQ(found.refused, "");
    EXPECT_NEAR(found.value, truth, found.interval) << static_cast<int>(what);
  }
  EXPECT_EQ(result.speed_source, calibrate::SpeedSource::own);
}

template <class Take>
Calibration calibrated(const Take& taken) {
  return calibrate::calibrate(taken.drive, configured_of(robot()));
}

TEST(CalibrateFromALog, FindsWhatIsPlanted) {
  engine::estimate::LocalFrame frame;
  frame.set_origin(kYard);
  const auto drive = driven();
  DriveOfLog taken(robot().base);
  const auto row_at = [](double time_s) {
    LogRow row;
    row.time = at(time_s);
    return row;
  };
  for (const auto& rim : drive.rims) {
    LogRow row = row_at(rim.time_s);
    row.motion = LoggedMotion{true, rim.left_mps, rim.right_mps};
    taken.take(row);
  }
  for (const auto& told : drive.commands) {
    LogRow row = row_at(told.time_s);  // as a twist: the same motion
    const double width_m = robot().base.track_m * robot().base.yaw_slip_factor;
    row.command = LoggedMotion{false, (told.left_mps + told.right_mps) / 2,
                               (told.right_mps - told.left_mps) / width_m};
    taken.take(row);
  }
  for (std::size_t i = 0; i < drive.places.size(); ++i) {
    LogRow row = row_at(drive.places[i].time_s);
    row.position = fix_at(frame, drive.places[i]);
    row.heading = GnssHeading{compass_deg_from_yaw_rad(drive.headings_rad[i].value)};
    row.receiver_mps = drive.receiver_mps[i].value;
    taken.take(row);
  }
  expect_planted(calibrated(taken));
}

/// Cycle by cycle what the engine shows: the last that was heard of each.
TEST(CalibrateFromARecording, FindsWhatIsPlanted) {
  engine::estimate::LocalFrame frame;
  frame.set_origin(kYard);
  const auto drive = driven();
  DriveOfRecording taken(robot().base);
  Snapshot shown;
  shown.axes.resize(4);
  std::size_t place = 0;
  for (std::size_t i = 0; i < drive.rims.size(); ++i) {
    const auto& rim = drive.rims[i];
    shown.time = at(rim.time_s);
    for (std::size_t axis = 0; axis < 4; ++axis) {
      const double did = axis % 2 == 0 ? rim.left_mps : rim.right_mps;
      const double told = axis % 2 == 0 ? drive.commands[i].left_mps : drive.commands[i].right_mps;
      shown.axes[axis].motion.velocity_radps = did / 0.165;
      shown.axes[axis].commanded_velocity_radps = told / 0.165;
      shown.axes[axis].last_motion = shown.time;
    }
    for (; place < drive.places.size() && drive.places[place].time_s <= rim.time_s; ++place) {
      shown.gnss.position = fix_at(frame, drive.places[place]);
      shown.gnss.receiver_heading_deg = compass_deg_from_yaw_rad(drive.headings_rad[place].value);
      shown.gnss.velocity.speed_mps = drive.receiver_mps[place].value;
      shown.gnss.position_time = shown.gnss.heading_time = shown.gnss.velocity_time =
          at(drive.places[place].time_s);
    }
    taken.take(shown);
    taken.take(shown);  // a cycle in which nothing new was heard
  }
  EXPECT_EQ(taken.drive.rims.size(), drive.rims.size());
  EXPECT_EQ(taken.drive.places.size(), drive.places.size());
  expect_planted(calibrated(taken));
}

TEST(CalibrateFromARecording, HearsWhatTheDrivesToldAndWereTold) {
  const auto file = gateway::record(gateway::a_run());
  const auto recorded = gateway::recorded_configuration(file);
  ASSERT_EQ(recorded.problem, "");
  const auto& base = recorded.loaded.config.engine.base;
  DriveOfRecording taken(base);
  const auto played =
      gateway::play(file, nullptr, [&](const Snapshot& snapshot) { taken.take(snapshot); });
  EXPECT_EQ(played.note, "");
  EXPECT_GT(taken.drive.rims.size(), 250U);
  ASSERT_GT(taken.drive.commands.size(), 250U);
  EXPECT_GT(taken.drive.commands.back().left_mps, 0.01);  // on its way to what it was told
  EXPECT_NEAR(taken.drive.commands.back().left_mps, taken.drive.commands.back().right_mps, 1e-6);
  EXPECT_NE(gateway::recorded_configuration({}).problem, "");
}

TEST(CalibrateFromARecording, LeavesOutPositionsOnSlopes) {
  engine::estimate::LocalFrame frame;
  frame.set_origin(kYard);
  DriveOfRecording taken(robot().base);
  Snapshot shown;
  shown.gnss.position = fix_at(frame, {});
  shown.gnss.position_time = at(1);
  shown.imu.roll_rad = 0;
  shown.imu.pitch_rad = to_rad(5);
  taken.take(shown);
  EXPECT_TRUE(taken.drive.places.empty());
  shown.gnss.position_time = at(2);
  shown.imu.pitch_rad = to_rad(1);
  taken.take(shown);
  EXPECT_EQ(taken.drive.places.size(), 1U);
}

TEST(CalibrateFromALog, LooksAtThePartThatIsChosen) {
  auto drive = driven();
  const double begin_s = drive.rims.front().time_s;
  cut(drive, 10, 20);
  EXPECT_NEAR(drive.rims.front().time_s, begin_s + 10, 0.03);
  EXPECT_NEAR(drive.places.back().time_s, begin_s + 20, 0.11);
}

/// As of a drive: one value off, one not, one not told.
Calibration found() {
  Calibration it;
  for (std::size_t i = 0; i < calibrate::kQuantities; ++i) {
    it.found.push_back({static_cast<Quantity>(i), 0, 0.01, 0, false, ""});
  }
  const auto set = [&](Quantity what, double value, double configured) {
    auto& one = it.found[static_cast<std::size_t>(what)];
    one.value = value;
    one.configured = configured;
    one.has_configured = true;
  };
  set(Quantity::wheel_radius_m, 0.2, 0.165);
  set(Quantity::yaw_slip_factor, 1.205, 1.2);
  set(Quantity::antenna_x_m, 0.4, 0.3);
  set(Quantity::heading_offset_deg, 92, 90);
  set(Quantity::position_late_s, 0.05, 0);
  it.found[static_cast<std::size_t>(Quantity::position_late_s)].has_configured = false;
  it.found[static_cast<std::size_t>(Quantity::antenna_y_m)].refused = "drive a left circle";
  return it;
}

CalibrationKeys keys() {
  CalibrationKeys keys;
  keys.receiver = "gnss";
  keys.heading_at_receiver = true;
  keys.latency_s = 0.08;
  keys.own_stamps = true;
  return keys;
}

TEST(CalibrationPatch, HasWhatIsOffByMoreThanItsInterval) {
  EXPECT_EQ(
      calibration_patch(found(), keys()),
      R"({"groups":{"base":{"wheel_radius_m":0.2}},"estimate":{"antenna_x_m":0.4},)"
      R"("devices":{"gnss":{"heading_baseline_offset_deg":92,"options":{"latency_s":0.13}}}})");
}

TEST(CalibrationPatch, DoesNotTouchTheLatencyForStampsOfOthers) {
  auto others = keys();
  others.own_stamps = false;
  EXPECT_THAT(calibration_patch(found(), others), Not(HasSubstr("latency_s")));
  EXPECT_THAT(show_calibration(found(), others), HasSubstr("0.050 s older than their stamps"));
}

/// Of a robot with the tape's numbers, and a drive that showed all of them.
CalibrationKeys unknown_keys() {
  auto all = keys();
  all.antenna_sigma_m = 0.06;
  all.heading_mount_sigma_deg = 1.2;
  all.gnss_late_sigma_s = 0.1;
  return all;
}
Calibration all_found() {
  Calibration it = found();
  for (const auto& [what, interval] :
       {std::pair{Quantity::antenna_x_m, 0.0501}, std::pair{Quantity::heading_offset_deg, 0.27},
        std::pair{Quantity::position_late_s, 0.012}})
    it.found[static_cast<std::size_t>(what)].interval = interval;
  auto& left = it.found[static_cast<std::size_t>(Quantity::antenna_y_m)];
  left.refused.clear();
  left.has_configured = true;
  // As late as positions: nothing remains once these are put right.
  it.found[static_cast<std::size_t>(Quantity::heading_late_s)].value = 0.05;
  return it;
}

TEST(CalibrationPatch, SaysHowWellWhatItFoundIsKnown) {
  const auto patch = calibration_patch(all_found(), unknown_keys());
  EXPECT_THAT(patch, HasSubstr(R"("estimate":{"antenna_x_m":0.4,"antenna_sigma_m":0.026,)"
                               R"("heading_mount_sigma_deg":0.14,"gnss_late_sigma_s":0.006})"))
      << "half of the wider interval, rounded up";
}

TEST(CalibrationPatch, CountsWhatItLeavesAsItIsConfigured) {
  auto it = all_found();
  auto& ahead = it.found[static_cast<std::size_t>(Quantity::antenna_x_m)];
  ahead.configured = 0.36;  // 4 cm beside what was found, 5 cm are allowed
  EXPECT_THAT(calibration_patch(it, unknown_keys()), HasSubstr(R"("antenna_sigma_m":0.048)"));
  it.found[static_cast<std::size_t>(Quantity::heading_late_s)].value = 0.08;
  EXPECT_THAT(calibration_patch(it, unknown_keys()), HasSubstr(R"("gnss_late_sigma_s":0.031)"))
      << "headings are later than positions by 0.03 s, and no key says so";
}

TEST(CalibrationPatch, LeavesWhatIsKnownAsWellAlready) {
  auto known = unknown_keys();
  known.antenna_sigma_m = 0.026;
  known.heading_mount_sigma_deg = 0;
  known.gnss_late_sigma_s = 0.005;
  EXPECT_THAT(calibration_patch(all_found(), known), Not(HasSubstr("sigma")));
}

TEST(CalibrationPatch, SaysNothingOfWhatWasNotSeenOrIsTheWrongWayRound) {
  const auto partly = calibration_patch(found(), unknown_keys());
  EXPECT_THAT(partly, Not(HasSubstr("antenna_sigma_m"))) << "only x was found";
  EXPECT_THAT(partly, HasSubstr("heading_mount_sigma_deg"));
  auto opposite = all_found();
  opposite.signs.heading_opposite = true;
  EXPECT_THAT(calibration_patch(opposite, unknown_keys()), Not(HasSubstr("sigma")));
  auto others = unknown_keys();
  others.own_stamps = false;
  EXPECT_THAT(calibration_patch(all_found(), others), Not(HasSubstr("gnss_late_sigma_s")))
      << "of a log that another program stamped";
}

TEST(CalibrationPatch, HasNoRadiusOfABaseThatTellsATwist) {
  auto twist = keys();
  twist.twist_base = true;
  EXPECT_THAT(calibration_patch(found(), twist), Not(HasSubstr("wheel_radius_m")));
  EXPECT_THAT(show_calibration(found(), twist), HasSubstr("way_scale"));
  EXPECT_THAT(show_calibration(found(), twist), Not(HasSubstr("wheel_radius_m")));
}

TEST(ShowCalibration, SaysWhyAValueIsNotTold) {
  const auto text = show_calibration(found(), keys());
  EXPECT_THAT(text, HasSubstr("drive a left circle"));
  EXPECT_THAT(text, HasSubstr("wheel_radius_m"));
}

TEST(ShowCalibration, IsJsonForPrograms) {
  auto it = found();
  it.signs.swapped = true;
  const auto root = parsed(calibration_json(it, keys()));
  EXPECT_TRUE(*root.find("ok")->boolean());
  EXPECT_EQ(root.find("patch")->find("groups")->find("base")->find("wheel_radius_m")->number(),
            0.2);
  const auto* values = root.find("values");
  EXPECT_EQ(values->find("antenna_x_m")->find("configured")->number(), 0.3);
  EXPECT_TRUE(values->find("antenna_y_m")->find("value")->is_null());
  EXPECT_EQ(*values->find("antenna_y_m")->find("reason")->text(), "drive a left circle");
  EXPECT_TRUE(*root.find("signs")->find("swapped")->boolean());
  EXPECT_THAT(*root.find("notes")->list()->front().text(), HasSubstr("groups.base.left"));
}

}  // namespace
}  // namespace drover::cli
