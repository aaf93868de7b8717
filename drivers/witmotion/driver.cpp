// Assembly of samples from frames, and from the sensor's axes to those of base_link.
#include "drivers/witmotion/driver.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "drover/angle.h"
#include "drover/rotation.h"

namespace drover::witmotion {
namespace {

constexpr Duration kTorn = std::chrono::milliseconds(100);
constexpr double kUnitTolerance = 0.05;
constexpr std::uint16_t kNeeded = kAcceleration | kAngularRate;

Duration stale_after(const Options& options) {
  const double period_s = 1 / options.number("rate_Hz");
  const double stale_s = options.number("stale_s");
  if (stale_s <= 0) return from_s(std::max(0.05, 5 * period_s));
  if (stale_s < 1.5 * period_s)
    throw std::runtime_error("stale_s is shorter than one and a half periods of rate_Hz");
  return from_s(stale_s);
}

}  // namespace

WitmotionDriver::WitmotionDriver(const Options& options)
    : format_(options.text("protocol") == "combined" ? Format::combined : Format::standard),
      rate_Hz_(options.number("rate_Hz")),
      stale_(stale_after(options)),
      magnetic_yaw_(options.flag("use_magnetic_yaw")),
      to_base_(from_angles(to_rad(options.number("mount_roll_deg")),
                           to_rad(options.number("mount_pitch_deg")),
                           to_rad(options.number("mount_yaw_deg")))),
      yaw_offset_(about_z(magnetic_yaw_ ? to_rad(options.number("magnetic_yaw_offset_deg")) : 0)),
      framer_(format_),
      setup_(wanted_settings(options), static_cast<std::uint32_t>(options.number("baud")),
             options.flag("configure") && format_ == Format::standard),
      frozen_(static_cast<int>(options.number("frozen_samples"))),
      expected_kinds_(wanted_settings(options).content) {
  if (options.text("orientation") == "none" && magnetic_yaw_)
    throw std::runtime_error("use_magnetic_yaw needs an orientation");
}

void WitmotionDriver::on_bytes(std::span<const std::uint8_t> bytes, Time first_byte,
                               DriverOut& out) {
  if (bytes.empty()) return;
  if (noise_since_ == kNever) noise_since_ = first_byte;
  last_byte_ = first_byte;
  const Duration byte_time = from_s(kBitsPerByte / setup_.line_baud());
  const std::size_t size = format_ == Format::standard ? kFrameSize : kCombinedFrameSize;
  // A chunk may hold several frames: the line's pace says when each byte came.
  Time at = first_byte;
  for (const std::uint8_t byte : bytes) {
    switch (framer_.push(byte)) {
      case Framer::Event::frame:
        noise_since_ = kNever;
        last_frame_ = at;
        on_frame(at - byte_time * static_cast<int>(size - 1), first_byte, out);
        break;
      case Framer::Event::dropped: ++bad_; break;
      case Framer::Event::none: break;
    }
    at += byte_time;
  }
}

void WitmotionDriver::on_tick(Time now, DriverOut& out) {
  setup_.on_tick(now, {last_byte_, last_frame_, previous_kinds_, pace_.pace_Hz()}, out);
}

void WitmotionDriver::on_link_up(Time now) {
  framer_.reset();
  cycle_ = Cycle{};
  pace_.reset();
  gravity_.reset();
  noise_since_ = kNever;
  setup_.on_link_up(now);
}

void WitmotionDriver::on_frame(Time first_byte, Time received, DriverOut& out) {
  const auto report = decode(framer_.frame());
  if (!report) return;
  ++good_;
  setup_.on_frame();
  if (const auto* registers = std::get_if<Registers>(&*report))
    return setup_.on_registers(*registers, received);
  const std::uint8_t type = framer_.frame()[1];
  // Frames come in the order of their types: one that goes back begins the next cycle.
  if (type <= cycle_.last_type || first_byte - cycle_.first_byte > kTorn) {
    end_cycle(received, out);
    cycle_.first_byte = first_byte;
  }
  cycle_.last_type = type;
  add(*report);
  if ((cycle_.kinds & expected_kinds_) == expected_kinds_) tell(received, out);
}

void WitmotionDriver::end_cycle(Time received, DriverOut& out) {
  tell(received, out);
  // What came twice running is what to wait for; a frame that was damaged once changes nothing.
  if (cycle_.kinds != 0 && cycle_.kinds == previous_kinds_) expected_kinds_ = cycle_.kinds;
  previous_kinds_ = cycle_.kinds;
  cycle_.kinds = 0;
  cycle_.told = false;
}

void WitmotionDriver::add(const Report& report) {
  const auto keep = [&](const auto& value, auto& into, Content kind) {
    into = value;
    cycle_.kinds = static_cast<std::uint16_t>(cycle_.kinds | kind);
  };
  if (const auto* acceleration = std::get_if<Acceleration>(&report)) {
    keep(*acceleration, cycle_.acceleration, kAcceleration);
  } else if (const auto* rate = std::get_if<AngularRate>(&report)) {
    keep(*rate, cycle_.rate, kAngularRate);
  } else if (const auto* angles = std::get_if<Angles>(&report)) {
    keep(*angles, cycle_.angles, kAngles);
  } else if (const auto* attitude = std::get_if<Attitude>(&report)) {
    keep(*attitude, cycle_.attitude, kQuaternion);
  } else if (const auto* field = std::get_if<MagneticField>(&report)) {
    keep(*field, cycle_.field, kMagneticField);
  } else if (const auto* all = std::get_if<Combined>(&report)) {
    keep(all->acceleration, cycle_.acceleration, kAcceleration);
    keep(all->rate, cycle_.rate, kAngularRate);
    keep(all->angles, cycle_.angles, kAngles);
  }
}

Fingerprint WitmotionDriver::fingerprint() const {
  Fingerprint words{};
  const auto put = [&words](std::size_t at, const auto& raw) {
    std::copy(raw.begin(), raw.end(), words.begin() + static_cast<long>(at));
  };
  put(0, cycle_.acceleration.raw);
  put(3, cycle_.rate.raw);
  if ((cycle_.kinds & kQuaternion) != 0) {
    put(6, cycle_.attitude.raw);
  } else if ((cycle_.kinds & kAngles) != 0) {
    put(6, cycle_.angles.raw);
  }
  return words;
}

bool WitmotionDriver::orient(ImuSample& sample) {
  Quaternion in_world;
  if ((cycle_.kinds & kQuaternion) != 0) {
    const double n = length(cycle_.attitude.orientation);
    if (std::abs(n - 1) > kUnitTolerance) return false;
    in_world = normalised(cycle_.attitude.orientation);
  } else if ((cycle_.kinds & kAngles) != 0) {
    in_world = from_angles(cycle_.angles.roll_rad, cycle_.angles.pitch_rad, cycle_.angles.yaw_rad);
  } else {
    return true;
  }
  sample.has_orientation = true;
  sample.orientation = yaw_offset_ * in_world * conjugate(to_base_);
  return true;
}

void WitmotionDriver::tell(Time received, DriverOut& out) {
  if (cycle_.told || (cycle_.kinds & kNeeded) != kNeeded) return;
  cycle_.told = true;
  const Time at = std::max(cycle_.first_byte, last_cycle_);
  last_cycle_ = at;
  pace_.add(at);
  ImuSample sample;
  sample.acceleration_mps2 = rotate(to_base_, cycle_.acceleration.mps2);
  sample.angular_velocity_radps = rotate(to_base_, cycle_.rate.radps);
  sample.temperature_degC = cycle_.acceleration.temperature_degC;
  sample.saturated = is_saturated(cycle_.acceleration.raw) || is_saturated(cycle_.rate.raw);
  if (!orient(sample)) {
    ++bad_;
    last_bad_quaternion_ = at;
  }
  if ((cycle_.kinds & kMagneticField) != 0) {
    const Words& raw = cycle_.field.raw;
    sample.has_magnetic_field = true;
    sample.magnetic_field = rotate(
        to_base_,
        {static_cast<double>(raw[0]), static_cast<double>(raw[1]), static_cast<double>(raw[2])});
  }
  gravity_.add(at, sample.acceleration_mps2, sample.angular_velocity_radps);
  // A reading that cannot be the truth must not look like one.
  if (frozen_.add(fingerprint()) || gravity_.wrong_axis()) return;
  if (sample.saturated) {
    last_saturated_ = at;
  } else {
    last_good_ = received;
  }
  out.report({at, received, sample});
}

}  // namespace drover::witmotion
