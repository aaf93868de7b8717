#include "drivers/hipnuc_can/codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "drover/angle.h"
#include "drover/bytes.h"

namespace drover::hipnuc_can {
namespace {

constexpr double kMostCounts = std::numeric_limits<std::int16_t>::max();
constexpr double kQuaternionUnit = 1e-4;
constexpr double kTemperatureUnit_degC = 0.01;

/// A parameter group's number stands in bits 8 to 23, the sender in the last byte; bits 26 to 28
/// are the priority, which a tool may have changed.
constexpr std::uint32_t kAllButPriority = 0x03FFFFFF;
constexpr std::uint32_t kHeartbeat = 0x700;
constexpr std::uint32_t kPriority3 = 0x0C000000;

struct Layout {
  Content content;
  std::uint32_t canopen_base;  ///< 0: that dialect has none
  std::uint32_t pgn;
};

constexpr std::array kLayouts{
    Layout{Content::acceleration, 0x180, 0xFF34},
    Layout{Content::rates, 0x280, 0xFF37},
    Layout{Content::quaternion, 0x480, 0xFF46},
    Layout{Content::temperature, 0, 0xFF43},
};

double acceleration_unit_mps2(Dialect dialect) {
  return (dialect == Dialect::canopen ? 0.001 : 0.00048828) * kGravity_mps2;
}

double rate_unit_radps(Dialect dialect) {
  return to_rad(dialect == Dialect::canopen ? 0.1 : 0.061035);
}

std::optional<Triple> read_triple(const CanFrame& frame, double unit, double range) {
  if (frame.len < 6) return {};
  // A channel that clips need not reach the very last count.
  constexpr double kNearly = 0.998;
  const double end = kNearly * std::min(range / unit, kMostCounts);
  const auto at_the_end = [end](std::int16_t raw) { return std::abs(raw) >= end; };
  const auto x = load_le<std::int16_t>(frame.payload(), 0);
  const auto y = load_le<std::int16_t>(frame.payload(), 2);
  const auto z = load_le<std::int16_t>(frame.payload(), 4);
  return Triple{{x * unit, y * unit, z * unit}, at_the_end(x) || at_the_end(y) || at_the_end(z)};
}

std::int16_t in_units(double value, double unit) {
  constexpr double kLeast = std::numeric_limits<std::int16_t>::min();
  return static_cast<std::int16_t>(std::clamp(std::round(value / unit), kLeast, kMostCounts));
}

CanFrame frame_of(const Address& address, Content content, std::uint8_t len) {
  CanFrame frame;
  frame.id = id_of(address, content);
  frame.extended = address.dialect == Dialect::j1939;
  frame.len = len;
  return frame;
}

CanFrame triple_frame(const Address& address, Content content, const Vector3& value, double unit) {
  CanFrame frame = frame_of(address, content, address.dialect == Dialect::canopen ? 6 : 8);
  store_le(frame.data, 0, in_units(value.x, unit));
  store_le(frame.data, 2, in_units(value.y, unit));
  store_le(frame.data, 4, in_units(value.z, unit));
  return frame;
}

}  // namespace

std::uint32_t id_of(const Address& address, Content content) {
  for (const Layout& layout : kLayouts) {
    if (layout.content != content) continue;
    if (address.dialect == Dialect::canopen) return layout.canopen_base + address.node;
    return kPriority3 | layout.pgn << 8U | address.node;
  }
  return 0;
}

FixedVector<FrameFilter, 5> filters_of(const Address& address) {
  FixedVector<FrameFilter, 5> filters;
  const bool extended = address.dialect == Dialect::j1939;
  for (const Layout& layout : kLayouts) {
    if (!extended && layout.canopen_base == 0) continue;
    (void)filters.push_back({.id = id_of(address, layout.content),
                             .mask = extended ? kAllButPriority : 0x7FFU,
                             .extended = extended});
  }
  // Its heartbeat says nothing that is needed, but the id is its own: nobody else may say it.
  if (!extended) (void)filters.push_back({.id = kHeartbeat + address.node});
  return filters;
}

std::optional<Content> content_of(const Address& address, const CanFrame& frame) {
  if (frame.remote || frame.fd || frame.error) return {};
  for (const FrameFilter& filter : filters_of(address)) {
    if (!filter.matches(frame)) continue;
    for (const Layout& layout : kLayouts)
      if ((id_of(address, layout.content) & filter.mask) == (filter.id & filter.mask))
        return layout.content;
  }
  return {};
}

std::optional<Triple> read_acceleration(Dialect dialect, const CanFrame& frame, double range_mps2) {
  return read_triple(frame, acceleration_unit_mps2(dialect), range_mps2);
}

std::optional<Triple> read_rates(Dialect dialect, const CanFrame& frame, double range_radps) {
  return read_triple(frame, rate_unit_radps(dialect), range_radps);
}

std::optional<Quaternion> read_quaternion(const CanFrame& frame) {
  if (frame.len < 8) return {};
  const auto part = [&](std::size_t at) {
    return load_le<std::int16_t>(frame.payload(), at) * kQuaternionUnit;
  };
  Quaternion q{part(0), part(2), part(4), part(6)};
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  if (length < 0.99 || length > 1.01) return {};
  return Quaternion{q.w / length, q.x / length, q.y / length, q.z / length};
}

std::optional<double> read_temperature_degC(const CanFrame& frame) {
  if (frame.len < 8) return {};
  return load_le<std::int16_t>(frame.payload()) * kTemperatureUnit_degC;
}

CanFrame acceleration_frame(const Address& address, const Vector3& acceleration_mps2) {
  return triple_frame(address, Content::acceleration, acceleration_mps2,
                      acceleration_unit_mps2(address.dialect));
}

CanFrame rates_frame(const Address& address, const Vector3& rates_radps) {
  return triple_frame(address, Content::rates, rates_radps, rate_unit_radps(address.dialect));
}

CanFrame quaternion_frame(const Address& address, const Quaternion& orientation) {
  CanFrame frame = frame_of(address, Content::quaternion, 8);
  store_le(frame.data, 0, in_units(orientation.w, kQuaternionUnit));
  store_le(frame.data, 2, in_units(orientation.x, kQuaternionUnit));
  store_le(frame.data, 4, in_units(orientation.y, kQuaternionUnit));
  store_le(frame.data, 6, in_units(orientation.z, kQuaternionUnit));
  return frame;
}

}  // namespace drover::hipnuc_can
