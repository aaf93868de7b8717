// What one of several receivers, inertial sensors or batteries is for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace drover {

/// As many of one kind, and so many kinds.
inline constexpr std::size_t kMaxOfKind = 4;
inline constexpr std::size_t kMaxSensors = 3 * kMaxOfKind;

enum class Role : std::uint8_t {
  steers,  ///< the robot goes by it
  spare,   ///< the robot goes by it while what steers is not well
  told,    ///< heard and shown; nothing goes by it
};

/// What several of may be there.
enum class SensorKind : std::uint8_t { receiver, imu, battery };

}  // namespace drover
