// A scanner on a pseudo-terminal, as its thread hears it.
#include "runtime/scan_loop.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <thread>

#include "config/load.h"
#include "link/unique_fd.h"
#include "runtime/clock.h"
#include "support/temp_folder.h"

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr std::string_view kRobot = R"({
  "links": {"can0": {"can": "can0"}, "lidar": {"serial": "LINE"}},
  "devices": {
    "left": {"driver": "odrive", "link": "can0", "options": {"node": 1},
             "accept": ["no_watchdog"]},
    "right": {"driver": "odrive", "link": "can0", "options": {"node": 2},
              "accept": ["no_watchdog"]},
    "lidar": {"driver": "ld06", "link": "lidar", "options": {"mount_x_m": 0.4,
              "mount_y_m": 0, "mount_z_m": 0.3, "mount_yaw_deg": 0}}
  },
  "groups": {"base": {"kind": "skid_steer", "wheel_radius_m": 0.165, "track_m": 0.6,
                      "left": ["left"], "right": ["right"], "hold": "brake"}},
  "scene": {"footprint": [{"x_m": 0.45, "y_m": 0.35}, {"x_m": -0.45, "y_m": 0.35},
                          {"x_m": -0.45, "y_m": -0.35}, {"x_m": 0.45, "y_m": -0.35}]}
})";

config::Loaded robot_with_scanner_at(const std::string& line) {
  std::string text(kRobot);
  text.replace(text.find("LINE"), 4, line);
  auto loaded = config::load_text(text);
  for (const auto& problem : loaded.problems) ADD_FAILURE() << problem.text("robot");
  return loaded;
}

/// A room of 8 m by 6 m.
double room_m(double bearing_rad) {
  return std::min(4 / std::abs(std::cos(bearing_rad)), 3 / std::abs(std::sin(bearing_rad)));
}
/// And a box of 40 cm in it, 1.1 m ahead of the scanner.
double with_a_box_m(double bearing_rad) {
  return std::abs(std::tan(bearing_rad)) < 0.2 / 1.1 && std::cos(bearing_rad) > 0
             ? 1.1 / std::cos(bearing_rad)
             : room_m(bearing_rad);
}

/// The twin at its end of the line, in real time.
class ScannerOnALine : public testing::Test {
 protected:
  ScannerOnALine()
      : line_(folder_.path() + "/lidar"),
        loaded_(robot_with_scanner_at(line_)),
        twin_(std::get<MakeScannerTwin>(find_driver("ld06")->make_twin)(
            Options(find_driver("ld06")->options), 1)),
        scanners_(scan_links(loaded_.config)) {}
  ~ScannerOnALine() override {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }

  void plug() {
    master_ = link::UniqueFd(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK));
    ASSERT_TRUE(master_);
    ASSERT_EQ(::grantpt(master_.get()), 0);
    ASSERT_EQ(::unlockpt(master_.get()), 0);
    char name[64];
    ASSERT_EQ(::ptsname_r(master_.get(), name, sizeof name), 0);
    ::unlink(line_.c_str());
    ASSERT_EQ(::symlink(name, line_.c_str()), 0);
  }
  void unplug() {
    ::unlink(line_.c_str());
    master_.reset();
  }
  void start() {
    thread_ = std::thread([this] { loop().run(stop_); });
  }
  ScanLoop& loop() { return *scanners_[0]->loop; }
  ScanExchange& exchange() { return scanners_[0]->exchange; }

  /// Until what is seen is so, for at most ten seconds.
  template <class Wanted>
  bool wait_until(Wanted wanted) {
    const Time end = monotonic_now() + 10s;
    for (Time now = monotonic_now(); now < end; now = monotonic_now()) {
      std::array<char, 8192> said{};
      const auto size = twin_->on_tick(now, world_, said);
      if (master_ && size > 0) (void)!::write(master_.get(), said.data(), size);
      if (wanted(exchange().seen.latest(), now)) return true;
      std::this_thread::sleep_for(3ms);
    }
    return false;
  }
  scene::sensor::FieldView view() {
    return scene::sensor::view({&exchange().seen.latest(), 1}, monotonic_now());
  }
  bool wait_for_free() {
    return wait_until([](const scene::sensor::ScanSeen& seen, Time now) {
      const auto all = scene::sensor::view({&seen, 1}, now);
      return !all.field.unknown && !all.field.blocked;
    });
  }
  bool wait_for_unknown() {
    return wait_until([](const scene::sensor::ScanSeen& seen, Time now) {
      return scene::sensor::view({&seen, 1}, now).field.unknown;
    });
  }

  test::TempFolder folder_;
  std::string line_;
  config::Loaded loaded_;
  std::unique_ptr<ScannerTwin> twin_;
  std::vector<std::unique_ptr<ScanLink>> scanners_;
  RangeOf world_ = room_m;
  link::UniqueFd master_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

TEST_F(ScannerOnALine, SeesTheFieldAndWhatComesIntoIt) {
  ASSERT_NO_FATAL_FAILURE(plug());
  start();
  ASSERT_TRUE(wait_for_free()) << view().unknown.view();
  world_ = with_a_box_m;
  ASSERT_TRUE(wait_until([](const auto& seen, Time) { return seen.field.blocked; }));
  const auto all = view();
  // The box is 1.5 m from base_link, and the robot's front edge 0.45 m.
  EXPECT_NEAR(all.field.free_m, 1.05, 0.05);
  EXPECT_EQ(all.scanner, "lidar");
  const scene::sensor::SeenTurn& turn = exchange().turn.latest();
  EXPECT_EQ(turn.device, "lidar");
  EXPECT_EQ(turn.scan.points.size(), 450U);
  EXPECT_GT(turn.scan.end, turn.scan.begin);
  const ScanTold told = exchange().told.latest();
  EXPECT_EQ(told.scanner.health, SourceState::fresh);
  EXPECT_NEAR(told.scanner.turn_Hz, 10, 0.1);
  EXPECT_EQ(told.scanner.points, 450U);
  EXPECT_EQ(told.scanner.returns, 450U);
  EXPECT_GT(told.scanner.source.samples, 1U);
  EXPECT_NEAR(told.scanner.nearest_m, 1.1, 0.06);
  EXPECT_NEAR(told.scanner.nearest_deg, 0, 12);
  EXPECT_TRUE(told.link.up);
  EXPECT_EQ(told.link.name, "lidar");
  EXPECT_GT(told.link.received, 1000U);
}

TEST(AScannersNearest, IsSaidAsTheRobotStandsSoThatItsYawCanBeChecked) {
  Scan turn;
  ASSERT_TRUE(turn.points.push_back({.bearing_rad = 0, .range_m = 2}));
  ASSERT_TRUE(turn.points.push_back({.bearing_rad = -kPi / 2, .range_m = 1}));
  ASSERT_TRUE(turn.points.push_back({.bearing_rad = 1, .range_m = 0}));
  ScannerSnapshot shown;
  show_nearest(turn, 0, shown);
  EXPECT_EQ(shown.nearest_m, 1);
  EXPECT_NEAR(shown.nearest_deg, -90, 1e-9) << "to the right";
  show_nearest(turn, kPi, shown);
  EXPECT_NEAR(shown.nearest_deg, 90, 1e-9) << "mounted the other way round";
  show_nearest({}, 0, shown);
  EXPECT_TRUE(std::isnan(shown.nearest_m) && std::isnan(shown.nearest_deg));
}

TEST_F(ScannerOnALine, IsUnknownWithoutALineAndSaysWhichIsMissing) {
  start();
  ASSERT_TRUE(wait_until([](const auto& seen, Time) { return !seen.reason.empty(); }));
  std::this_thread::sleep_for(50ms);
  EXPECT_TRUE(view().field.unknown);
  EXPECT_THAT(std::string(view().unknown.view()), HasSubstr("lidar: " + line_));
  EXPECT_FALSE(exchange().told.latest().link.up);
}

TEST_F(ScannerOnALine, IsUnknownAtOnceWhenItIsUnpluggedAndComesBack) {
  ASSERT_NO_FATAL_FAILURE(plug());
  start();
  ASSERT_TRUE(wait_for_free());
  const Time unplugged = monotonic_now();
  unplug();
  ASSERT_TRUE(wait_for_unknown());
  EXPECT_LT(monotonic_now() - unplugged, 300ms);
  EXPECT_THAT(std::string(view().unknown.view()), HasSubstr(line_ + ": lost"));
  EXPECT_EQ(exchange().told.latest().scanner.health, SourceState::stale);
  ASSERT_NO_FATAL_FAILURE(plug());
  EXPECT_TRUE(wait_for_free()) << view().unknown.view();
}

TEST_F(ScannerOnALine, IsUnknownWhenItIsCoveredInTheSunOrFrozenAndSaysSo) {
  ASSERT_NO_FATAL_FAILURE(plug());
  start();
  for (const auto& [state, why] : {std::pair{"covered", "lens is covered"},
                                   {"sun", "blind in"},
                                   {"frozen", "same turn over and over"},
                                   {"silent", "the scanner"}}) {
    ASSERT_TRUE(twin_->set_state("", monotonic_now()));
    ASSERT_TRUE(wait_for_free()) << view().unknown.view();
    ASSERT_TRUE(twin_->set_state(state, monotonic_now()));
    ASSERT_TRUE(wait_for_unknown()) << state;
    EXPECT_TRUE(wait_until([&, why = why](const auto& seen, Time) {
      return seen.state == SourceState::stale &&
             seen.reason.view().find(why) != std::string_view::npos;
    })) << state
        << ": " << view().unknown.view();
  }
}

TEST(BytesThatWaited, AreAsOldAsTheyCanBe) {
  constexpr Duration kByte = 43403ns;
  const Time now{100s};
  // Read each 10 ms; 176 bytes take 7.6 ms.
  EXPECT_EQ(came_in({now - 10ms, now}, 176, kByte), now - 10ms);
  // The thread stood still for half a second.
  EXPECT_EQ(came_in({now - 500ms, now}, 4096, kByte), now - 500ms);
  // More than the line carries since: some was there before it was read the last time.
  EXPECT_EQ(came_in({now - 1ms, now}, 1000, kByte), now - 43403us);
}

TEST(ScannersShown, AreStaleWhenTheirThreadStandsStill) {
  ScanTold told;
  told.at = Time{100s};
  told.scanner.health = SourceState::fresh;
  EXPECT_EQ(as_shown(told, Time{100s} + 900ms).health, SourceState::fresh);
  EXPECT_EQ(as_shown(told, Time{102s}).health, SourceState::stale);
  EXPECT_EQ(as_shown(told, Time{102s}).source.reason, "not looked at: its thread stands still");
}

}  // namespace
}  // namespace drover::runtime
