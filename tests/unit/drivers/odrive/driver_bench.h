// A driver of one axis with hands on both sides of it: frames in, frames and measurements out.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "drivers/odrive/driver.h"
#include "drivers/odrive/entry.h"
#include "support/describe.h"

namespace drover::odrive {

using std::chrono::milliseconds;
using test::describe;
using test::parse_frame;

constexpr auto kIdleBeat = "061#0000000001000000";
constexpr auto kRunningBeat = "061#0000000008000000";

inline Options options() {
  return Options(option_table()).set("node", 3.0).set("poll_s", 0.0);
}

/// The driver alone, with heartbeats given by hand.
class Bench {
 public:
  explicit Bench(const Options& values = options()) : driver(read_settings(values), 0) {
    driver.on_link_up(now);
  }
  /// One frame from the drive.
  void hear(const std::string& frame) {
    out.clear();
    driver.on_frame(parse_frame(frame), now, out);
    note();
  }
  /// Cycles of 5 ms; a heartbeat each 100 ms if there is one.
  void run(int cycles, AxisRequest request, double velocity_radps = 0,
           const std::string& heartbeat = "") {
    for (int i = 0; i < cycles; ++i) {
      now += milliseconds(5);
      if (!heartbeat.empty() && ++since_beat % 20 == 0) hear(heartbeat);
      out.clear();
      const Setpoint wanted[] = {{request, velocity_radps, {}, {}, held}};
      driver.on_setpoints(wanted, now, out);
      driver.on_tick(now, out);
      note();
    }
  }
  /// In closed loop, following.
  void arm() {
    hear(kIdleBeat);
    run(2, AxisRequest::rest);
    run(10, AxisRequest::run);
    hear(kRunningBeat);
    ASSERT_EQ(status.state, AxisState::running);
    sent.clear();
  }
  int count(const std::string& frame) const {
    int n = 0;
    for (const auto& each : sent) n += each == frame ? 1 : 0;
    return n;
  }
  int motions() const {
    int n = 0;
    for (const auto& each : sent)
      n += driver.effect(parse_frame(each), now).kind == FrameEffect::motion ? 1 : 0;
    return n;
  }

  Time now{std::chrono::seconds(5)};
  OdriveDriver driver;
  DriverOut out;
  std::vector<std::string> sent;
  StatusInWords status;
  int statuses = 0;
  int since_beat = 0;
  bool held = false;  ///< before the driver began

 private:
  void note() {
    for (const CanFrame& frame : out.frames) sent.push_back(describe(frame));
    for (const Measurement& m : out.measurements) {
      if (const auto* value = std::get_if<AxisStatus>(&m.value)) {
        status = {*value, driver.words(m)};
        ++statuses;
      }
    }
  }
};

constexpr auto kZero = "06D#0000000000000000";
constexpr auto kMode = "06B#0200000001000000";
constexpr auto kClosedLoop = "067#08000000";
constexpr auto kIdle = "067#01000000";
constexpr auto kClear = "078#00";

}  // namespace drover::odrive
