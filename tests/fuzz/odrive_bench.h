// The ODrive driver beside a small model of what it may believe, send and say.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>

#include "drivers/odrive/codec.h"
#include "drivers/odrive/driver.h"
#include "drover/registry.h"

namespace drover::fuzz {

inline constexpr AxisId kAxis = 3;
inline constexpr std::uint8_t kNode = 5;
inline constexpr double kLimit_turnps = 7.5;
inline constexpr Duration kStale = std::chrono::milliseconds(100);

inline void require(bool holds) {
  if (!holds) std::abort();
}
inline bool finite_or_absent(double value) {
  return !std::isinf(value);
}
inline bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

inline Options options_of(const DriverEntry& entry, std::uint8_t choice) {
  Options options(entry.options);
  options.set("node", static_cast<double>(kNode));
  options.set("velocity_limit_turnps", kLimit_turnps);
  options.set("stale_s", to_s(kStale));
  options.set("arming_timeout_s", 0.3);
  options.set("reversed", (choice & 1U) != 0);
  options.set("gear_ratio", (choice & 2U) != 0 ? 1000.0 : 0.5);
  options.set("torque_constant_Nm_per_A", (choice & 4U) != 0 ? 100.0 : 0.0);
  options.set("poll_s", (choice & 8U) != 0 ? 0.02 : 0.0);
  if ((choice & 16U) != 0) {
    options.set("firmware", std::string("0.5.6"));
  } else if ((choice & 32U) != 0) {
    options.set("watchdog_timeout_s", 0.1);
    options.set("watchdog_enable_endpoint", 258.0);
    options.set("watchdog_timeout_endpoint", 259.0);
  }
  return options;
}

inline void check_same(const Measurement& a, const Measurement& b) {
  require(a.value.index() == b.value.index());
  if (const auto* motion = std::get_if<AxisMotion>(&a.value)) {
    const auto& other = std::get<AxisMotion>(b.value);
    require(motion->position_rad == other.position_rad);
    require(motion->velocity_radps == other.velocity_radps);
    require(same(motion->effort_Nm, other.effort_Nm));
  } else if (const auto* status = std::get_if<AxisStatus>(&a.value)) {
    const auto& other = std::get<AxisStatus>(b.value);
    require(status->state == other.state && status->error_code == other.error_code);
  }
}

/// One driver that sees a frame as it is, and one for which the room behind its end is not zero:
/// both must say the same.
class Bench {
 public:
  explicit Bench(std::uint8_t choice) : v0_6_((choice & 16U) == 0) {
    const DriverEntry* entry = find_driver("odrive");
    require(entry != nullptr);
    MakeContext context{.kind = SlotKind::drive};
    require(context.axes.push_back(kAxis));
    driver_ = entry->make(options_of(*entry, choice), context);
    twin_ = entry->make(options_of(*entry, choice), context);
    const StopRecipe recipe = driver_.actuator->stop_recipe();
    require(recipe.rounds.size() == 1 && !recipe.rounds[0].frames.empty());
    for (const CanFrame& frame : recipe.rounds[0].frames) {
      require(allowed(frame) && driver_.actuator->effect(frame, now_).kind == FrameEffect::stop);
    }
  }

  void pass(Duration time) { now_ += time; }

  void frame(const CanFrame& frame) {
    note(frame);
    CanFrame dirty = frame;
    for (std::size_t i = frame.len; i < dirty.data.size(); ++i) dirty.data[i] = 0xC7;
    static_cast<void>(driver_.actuator->effect(frame, now_));
    call([&](const Made& driver, const CanFrame& f,
             DriverOut& out) { driver.frames->on_frame(f, now_, out); },
         frame, dirty);
    check_health();
    now_ += std::chrono::microseconds(100);
  }

  void cycle(const Setpoint& command) {
    wanted_ = command;
    if (command.request == AxisRequest::run) ++asked_;
    if (command.request == AxisRequest::idle && heartbeat_ == kNever) held_ = false;
    const CanFrame none;
    call(
        [&](const Made& driver, const CanFrame&, DriverOut& out) {
          driver.actuator->on_setpoints({&command, 1}, now_, out);
        },
        none, none);
    undecided_cycle();
  }

  /// Nobody decided in it, when it is not the end of one where somebody did.
  void undecided_cycle() {
    const CanFrame none;
    call([&](const Made& driver, const CanFrame&,
             DriverOut& out) { driver.device->on_tick(now_, out); },
         none, none);
    check_health();
    now_ += std::chrono::milliseconds(5);
  }

  void link_up() {
    driver_.device->on_link_up(now_);
    twin_.device->on_link_up(now_);
    heartbeat_ = kNever;
    estimates_ = kNever;
    check_health();
  }

 private:
  template <class Call>
  void call(Call what, const CanFrame& clean, const CanFrame& dirty) {
    static DriverOut out;
    static DriverOut other;
    out.clear();
    other.clear();
    what(driver_, clean, out);
    what(twin_, dirty, other);
    require(out.overflows == 0 && out.bytes.empty() && out.packets.empty() && out.reopen_baud == 0);
    require(out.frames.size() == other.frames.size());
    require(out.measurements.size() == other.measurements.size());
    for (std::size_t i = 0; i < out.frames.size(); ++i) {
      require(out.frames[i] == other.frames[i]);
      check_sent(out.frames[i]);
    }
    for (std::size_t i = 0; i < out.measurements.size(); ++i) {
      check(out.measurements[i]);
      check_same(out.measurements[i], other.measurements[i]);
      require(driver_.device->words(out.measurements[i]) ==
              twin_.device->words(other.measurements[i]));
    }
  }

  /// What the test itself takes from the frame: when what says that an axis is there came last.
  void note(const CanFrame& frame) {
    if (frame.extended || frame.fd || frame.error || frame.remote || frame.id >> 5U != kNode)
      return;
    ++own_;
    const std::uint8_t command = frame.id & 0x1FU;
    if (frame.len != 8) return;
    if (command == odrive::cmd::kHeartbeat) {
      heartbeat_ = now_;
      bool failed = odrive::read_u32(frame, 0) != 0;
      if (!v0_6_) failed = failed || ((frame.data[5] | frame.data[6] | frame.data[7]) & 1U) != 0;
      held_ = frame.data[4] == odrive::kStateClosedLoop;
      closed_loop_ = held_ && !failed;
    } else if (command == odrive::cmd::kEstimates && std::isfinite(odrive::read_float(frame, 0)) &&
               std::isfinite(odrive::read_float(frame, 4))) {
      estimates_ = now_;
    }
  }

  bool heard() const {
    constexpr auto kSilence = std::chrono::milliseconds(300);
    return heartbeat_ != kNever && now_ - heartbeat_ <= kSilence;
  }

  bool allowed(const CanFrame& frame) const {
    for (const FrameRule& rule : driver_.actuator->rules())
      if (rule.id == frame.id && rule.extended == frame.extended && rule.remote == frame.remote &&
          frame.len >= rule.min_len && frame.len <= rule.max_len)
        return !frame.fd && !frame.error;
    return false;
  }

  static bool is_zero(const CanFrame& frame) {
    return (frame.id & 0x1FU) == odrive::cmd::kSetInputVel && !frame.remote &&
           odrive::read_float(frame, 0) == 0.0F && odrive::read_float(frame, 4) == 0.0F;
  }

  void check_sent(const CanFrame& frame) const {
    // What was in closed loop before a new link is told to stand, and nothing else.
    require(allowed(frame) && (heartbeat_ != kNever || (held_ && is_zero(frame))));
    const FrameEffect effect = driver_.actuator->effect(frame, now_).kind;
    require(effect != FrameEffect::forbidden);
    if (frame.remote) return;
    const std::uint8_t command = frame.id & 0x1FU;
    const bool runs = wanted_.request == AxisRequest::run && heard();
    if (command == odrive::cmd::kSetInputVel) {
      const double turnps = static_cast<double>(odrive::read_float(frame, 0));
      require(std::isfinite(turnps) && std::abs(turnps) <= kLimit_turnps);
      require(odrive::read_float(frame, 4) == 0.0F);
      require((effect == FrameEffect::motion) == (turnps != 0));
      require(turnps == 0 || (runs && closed_loop_ && std::isfinite(wanted_.velocity_radps)));
    } else {
      require(effect != FrameEffect::motion);
    }
    if (command == odrive::cmd::kSetAxisState)
      require(odrive::read_u32(frame, 0) == odrive::kStateClosedLoop
                  ? runs
                  : wanted_.request == AxisRequest::idle);
    if (command == odrive::cmd::kClearErrors) require(runs);
  }

  void check(const Measurement& m) const {
    require(m.time == now_ && m.received == now_);
    if (const auto* motion = std::get_if<AxisMotion>(&m.value)) {
      require(motion->axis == kAxis && estimates_ == now_);
      require(std::isfinite(motion->position_rad) && std::isfinite(motion->velocity_radps));
      require(finite_or_absent(motion->effort_Nm));
    } else if (const auto* heat = std::get_if<AxisTemperature>(&m.value)) {
      require(heat->axis == kAxis);
      require(finite_or_absent(heat->inverter_degC) && finite_or_absent(heat->motor_degC));
    } else if (const auto* supply = std::get_if<AxisSupply>(&m.value)) {
      require(supply->axis == kAxis);
      require(finite_or_absent(supply->bus_V) && finite_or_absent(supply->bus_A));
    } else {
      const auto* status = std::get_if<AxisStatus>(&m.value);
      require(status != nullptr && status->axis == kAxis);
      require(heard() ||
              (status->state == AxisState::unknown && !driver_.device->words(m).empty()));
      require(status->state != AxisState::running || closed_loop_);
      require(status->state != AxisState::arming || wanted_.request == AxisRequest::run);
      require(status->state != AxisState::fault || !driver_.device->words(m).empty());
    }
  }

  void check_health() const {
    const SourceHealth health = driver_.device->health(now_);
    const SourceHealth other = twin_.device->health(now_);
    require(health.state == other.state && health.good == other.good && health.bad == other.bad);
    require(health.good + health.bad <= own_ + asked_ && health.last_good <= now_);
    require((health.state == SourceState::never_heard) == (health.good == 0));
    const bool fresh = heard() && estimates_ != kNever && now_ - estimates_ <= kStale;
    require((health.state == SourceState::fresh) == fresh);
    require(fresh || !health.reason.empty());
  }

  bool v0_6_;
  Made driver_;
  Made twin_;
  Setpoint wanted_;
  Time now_{std::chrono::seconds(100)};
  Time heartbeat_ = kNever;  ///< since the link came up
  Time estimates_ = kNever;
  bool closed_loop_ = false;  ///< by the last heartbeat, and without an error
  bool held_ = false;  ///< by its last heartbeat, also before a new link; nobody let go of it since
  std::uint64_t own_ = 0;    ///< data frames of the node
  std::uint64_t asked_ = 0;  ///< set points, each of which may be no number or too large
};

}  // namespace drover::fuzz
